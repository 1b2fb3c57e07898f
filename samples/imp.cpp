#include "samples/creature.h"

namespace spherematch::samples {
namespace {

constexpr Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};
constexpr Vec3 bend_left{-0.67, -0.74, 0}, bend_right{-0.67, 0.74, 0};  // of the elbows: across the arms, forward

// name, parent, pivot, softness, edge. About centimetres; x left, y up, z forward.
const std::vector<BoneRow> bones{
    {"pelvis", "", {0, 45, 0}, 0, 2.5},           {"spine", "pelvis", {0, 53, -2}, 16, 2.5}, {"chest", "spine", {0, 62, -3}, 16, 2.4},
    {"neck", "chest", {0, 71, -2}, 8, 2.1},       {"head", "neck", {0, 76, -1}, 8, 2.4},     {"face", "head", {0, 84, 11}, 6, 1.7},
    {"ear", "head", {11, 86, -2}, 7, 1.7},        {"horn", "head", {5, 98, 2}, 4, 1.5},      {"tail1", "pelvis", {0, 42, -9}, 9, 1.6},
    {"tail2", "tail1", {0, 34, -20}, 8, 1.4},     {"tail3", "tail2", {0, 38, -33}, 7, 1.35}, {"shoulder", "chest", {9.5, 68, -3}, 9, 1.9},
    {"elbow", "shoulder", {22, 57, -4}, 11, 1.6}, {"wrist", "elbow", {34, 46, -1}, 6, 1.5},  {"fingers", "wrist", {40, 40.6, 0.4}, 4, 1.15},
    {"thumb", "wrist", {36, 43, 3}, 3, 1.15},     {"hip", "pelvis", {7, 42, 0}, 13, 2.2},    {"knee", "hip", {9.2, 24, 2}, 9, 1.8},
    {"ankle", "knee", {9.6, 6, -1.5}, 6, 1.6},    {"toes", "ankle", {10.6, 3, 8}, 7, 1.4},
};

const std::vector<Part> trunk{
    {"pelvis", 1, {{0, 44, -1}, 10.5, {0, 47, 0}, 10.5}},
    {"spine", 5, {{0, 51, 3}, 12, {0, 55, 2.5}, 11}},
    {"chest", 6, {{0, 62, -1}, 10, {0, 66, -2}, 9.5, z_axis, 0.85}},
    {"neck", 4, {{0, 69, -2}, 6, {0, 78, -1}, 6}},
    {"head", 3, {{0, 87, -1}, 13, {0, 86, 1}, 12.5}},
    {"face", 3, {{0, 79, 6}, 7.5, {0, 77, 9}, 5.5}},
    {"face", 2.5, {{0, 84.5, 12}, 3.8, {0, 82.5, 20}, 2.9}},
    {"face", 1.2, {{0, 81.6, 23.4}, 3.8, {0, 81.8, 23}, 3.8}},
    {"face", 1.2, {{0, 77, 19}, 7, {0, 77, 19}, 7, y_axis, 0.25}, true},
    {"tail1", 4, {{0, 42, -8}, 4.8, {0, 34, -20}, 4}},
    {"tail2", 2, {{0, 34, -20}, 4, {0, 38, -33}, 3.5}},
    {"tail3", 2, {{0, 38, -33}, 3.5, {0, 45, -39}, 3.2}},
    {"tail3", 1.5, {{0, 46, -40}, 5.2, {0, 54, -45}, 2.2, normalized({0, 0.6, 1}), 0.7}},
};

const std::vector<Part> eye{
    {"face", 0.8, {{5.4, 90, 9.4}, 4.0, {5.4, 90, 9.4}, 4.0}},
};

const std::vector<Part> horn{
    {"horn", 1, {{5, 97, 2}, 3.4, {7.5, 107, 5}, 1.8}},
};

const Vec3 ear_front = normalized({0.15, 0.1, 1});
const std::vector<Part> ear{
    {"ear", 1, {{12, 87, -2}, 7, {33, 99, -7}, 2.8, ear_front, 0.55}},
    {"ear", 1.2, {{16, 89, 3.6}, 4.4, {27, 95.4, 0.2}, 2.6}, true},
};

const Vec3 palm = normalized({0.66, 0.72, -0.25});
const std::vector<Part> arm{
    {"shoulder", 1, {{8.5, 67, -3}, 6, {22, 57, -4}, 4.2}},
    {"elbow", 2, {{22, 57, -4}, 4.4, {34, 46, -1}, 3.9}},
    {"wrist", 2, {{35.5, 44.6, 0}, 4.9, {39.2, 41.2, 0.6}, 5.4, palm, 0.66}},
    {"fingers", 1.5, {{40, 41, -3.4}, 2.7, {44.4, 37.2, -7}, 2.4}},
    {"fingers", 1.5, {{41.2, 39.8, 0.6}, 2.8, {46.2, 35.2, 0.6}, 2.5}},
    {"fingers", 1.5, {{40, 40.8, 4.6}, 2.7, {44.4, 36.6, 8.2}, 2.4}},
    {"thumb", 1.5, {{36, 43.2, 3.6}, 2.8, {36.4, 39.8, 9}, 2.5}},
};

const std::vector<Part> leg{
    {"hip", 1, {{7.2, 42, -0.5}, 7, {9.2, 25, 2}, 5.3}},        {"knee", 3, {{9.2, 24.5, 2}, 5.2, {9.6, 7, -1.5}, 4.1}},
    {"knee", 3, {{9.4, 19, -1}, 4.4, {9.5, 15, -1.2}, 3.8}},    {"ankle", 2, {{9.6, 4, -4}, 4.0, {10.6, 3.6, 6.5}, 4.3}},
    {"toes", 2.5, {{8.2, 3.2, 10}, 3.2, {7.7, 3.0, 14}, 2.9}},  {"toes", 2.5, {{12.2, 3.0, 9.5}, 2.9, {12.7, 2.7, 13}, 2.6}},
    {"toes", 2.5, {{14.9, 2.8, 7}, 2.6, {16.0, 2.5, 10}, 2.4}},
};

const std::vector<Turn> stand{
    {"shoulder.l", z_axis, -18}, {"shoulder.r", z_axis, 18}, {"elbow.l", y_axis, -14},
    {"elbow.r", y_axis, 14},     {"head", y_axis, 10},       {"tail2", y_axis, 15},
};

const std::vector<Turn> run{
    {"pelvis", x_axis, 8},       {"pelvis", y_axis, 5},       {"spine", y_axis, -6},      {"chest", y_axis, -8},
    {"head", x_axis, -6},        {"head", y_axis, 6},         {"tail1", x_axis, 11},      {"tail2", x_axis, -12},
    {"shoulder.l", z_axis, -11}, {"shoulder.l", x_axis, -29}, {"elbow.l", bend_left, 42}, {"shoulder.r", z_axis, 11},
    {"shoulder.r", x_axis, 25},  {"elbow.r", bend_right, 40}, {"hip.l", x_axis, 23},      {"knee.l", x_axis, 32},
    {"ankle.l", x_axis, 12},     {"hip.r", x_axis, -34},      {"knee.r", x_axis, 36},     {"ankle.r", x_axis, -6},
    {"toes.l", x_axis, -9},      {"ear.l", y_axis, 16},       {"ear.r", y_axis, -16},
};

const std::vector<Turn> wave{
    {"spine", y_axis, -12},      {"chest", y_axis, -13},      {"chest", z_axis, 6},    {"neck", z_axis, 6},     {"head", y_axis, 29},
    {"head", z_axis, 6},         {"shoulder.l", z_axis, 51},  {"elbow.l", z_axis, 33}, {"wrist.l", z_axis, 10}, {"shoulder.r", z_axis, 12},
    {"shoulder.r", x_axis, -15}, {"elbow.r", bend_right, 51}, {"hip.l", z_axis, 8},    {"hip.r", z_axis, -6},   {"knee.r", x_axis, 13},
    {"hip.r", x_axis, -12},      {"tail1", y_axis, 18},       {"tail2", y_axis, 27},   {"ear.l", z_axis, -8},
};

const std::vector<Turn> crouch{
    {"pelvis", x_axis, 18},      {"spine", x_axis, 8},        {"chest", x_axis, 8},        {"neck", x_axis, -14},
    {"head", x_axis, -16},       {"hip.l", x_axis, -59},      {"hip.l", y_axis, 16},       {"knee.l", x_axis, 63},
    {"ankle.l", x_axis, -21},    {"hip.r", x_axis, -54},      {"hip.r", y_axis, -18},      {"knee.r", x_axis, 60},
    {"ankle.r", x_axis, -23},    {"shoulder.l", x_axis, -31}, {"shoulder.l", y_axis, -16}, {"elbow.l", y_axis, -30},
    {"shoulder.r", x_axis, -35}, {"shoulder.r", y_axis, 14},  {"elbow.r", y_axis, 35},     {"tail1", x_axis, 21},
    {"tail2", x_axis, 16},
};

const std::vector<Turn> dance{
    {"pelvis", y_axis, 8},     {"spine", z_axis, -6},      {"chest", y_axis, 12},   {"chest", z_axis, -6},       {"head", z_axis, -10},
    {"head", x_axis, -6},      {"shoulder.l", z_axis, 27}, {"elbow.l", z_axis, 51}, {"shoulder.r", z_axis, -36}, {"elbow.r", z_axis, -18},
    {"fingers.r", x_axis, 12}, {"hip.l", z_axis, 18},      {"hip.l", x_axis, -30},  {"knee.l", x_axis, 52},      {"ankle.l", x_axis, 12},
    {"knee.r", x_axis, 13},    {"hip.r", x_axis, -8},      {"ankle.r", x_axis, -6}, {"tail1", y_axis, -25},      {"tail2", x_axis, -22},
};

const std::vector<Turn> sneak{
    {"pelvis", x_axis, 23},      {"spine", x_axis, 10},       {"chest", x_axis, 8},       {"neck", x_axis, -18},
    {"head", x_axis, -18},       {"head", y_axis, -23},       {"hip.l", x_axis, -51},     {"knee.l", x_axis, 48},
    {"ankle.l", x_axis, -8},     {"hip.r", x_axis, -7},       {"knee.r", x_axis, 29},     {"ankle.r", x_axis, 10},
    {"toes.r", x_axis, -13},     {"shoulder.l", x_axis, -44}, {"elbow.l", bend_left, 32}, {"wrist.l", x_axis, 29},
    {"shoulder.r", x_axis, -26}, {"elbow.r", bend_right, 50}, {"wrist.r", x_axis, 32},    {"tail1", x_axis, 14},
    {"tail2", y_axis, 29},       {"tail3", y_axis, 23},
};

}  // namespace

Creature imp() {
  return {.name = "imp",
          .flesh = Flesh(Skeleton(bones),
                         {{1, false, trunk}, {0.8, true, eye}, {1.5, true, horn}, {2, true, ear}, {3, true, arm}, {3, true, leg}}),
          .holes = {{{0, 63, -11}, 4.5}, {{0, 100, -3}, 4}, {{10, 0, 1}, 3}},  // back, top of the head, sole of the left foot
          .shared_scale = 1.0,
          .independent_scale = 0.92,
          .poses = {
              {"stand", MeshKind::shared, stand, {turn(y_axis, -35), {-25, 0, 10}}},
              {"run", MeshKind::shared, run, {turn(z_axis, -90) * turn(y_axis, 15), {0, 40, 20}}},
              {"wave", MeshKind::shared, wave, {turn(x_axis, 80), {35, 5, -60}}},
              {"crouch", MeshKind::independent, crouch, {turn({2, 1, -2}, 55), {-80, 15, 0}}},
              {"dance", MeshKind::holed, dance, {turn(y_axis, 115) * turn(z_axis, 10), {0, -45, 30}}},
              {"sneak", MeshKind::glb, sneak, {turn(y_axis, -70) * turn(x_axis, 10), {20, 0, 0}}},
          }};
}

}  // namespace spherematch::samples
