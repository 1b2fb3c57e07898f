#include "samples/creature.h"

namespace spherematch::samples {
namespace {

constexpr Vec3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

// name, parent, pivot, softness, edge. About centimetres; x left, y up, z forward.
const std::vector<BoneRow> bones{
    {"pelvis", "", {0, 58, -22}, 0, 2.7},        {"loin", "pelvis", {0, 60, -8}, 20, 2.7},     {"chest", "loin", {0, 58, 8}, 20, 2.7},
    {"neck", "chest", {0, 64, 24}, 16, 2.3},     {"head", "neck", {0, 82, 36}, 10, 1.65},      {"ear", "head", {5.5, 93, 34}, 5, 1.5},
    {"tail1", "pelvis", {0, 62, -34}, 12, 1.7},  {"tail2", "tail1", {0, 64, -47}, 9, 1.6},     {"tail3", "tail2", {0, 71, -59}, 8, 1.4},
    {"shoulder", "chest", {7, 53, 18}, 16, 2.2}, {"elbow", "shoulder", {8.5, 36, 13}, 8, 1.6}, {"wrist", "elbow", {8.5, 16, 17}, 6, 1.45},
    {"paw", "wrist", {8.5, 4.5, 18}, 8, 1.3},    {"hip", "pelvis", {7, 53, -24}, 16, 2.3},     {"knee", "hip", {9, 36, -14}, 9, 1.75},
    {"hock", "knee", {8.5, 20, -33}, 6, 1.45},   {"foot", "hock", {8.5, 4.5, -27}, 8, 1.3},
};

const std::vector<Part> trunk{
    {"pelvis", 1, {{0, 57, -29}, 9.5, {0, 58, -16}, 9.5, x_axis, 0.9}},
    {"loin", 8, {{0, 60, -12}, 8.2, {0, 58, 2}, 9.5, x_axis, 0.95}},
    {"chest", 8, {{0, 55.5, 6}, 12, {0, 53, 17}, 13.5, x_axis, 0.76}},
    {"chest", 5, {{0, 51, 26}, 6, {0, 45, 22}, 5}},
    {"neck", 7, {{0, 61, 22}, 9, {0, 81, 34}, 7}},
    {"head", 4, {{0, 87, 38}, 9.5, {0, 86, 42}, 8}},
    {"head", 3, {{0, 84, 46}, 6, {0, 82.5, 60}, 4.2}},
    {"head", 0.8, {{0, 85.2, 63}, 3, {0, 85, 62.5}, 3}},
    {"head", 0.9, {{0, 79.2, 44}, 4, {0, 77.4, 56}, 2.9}},
    {"tail1", 5, {{0, 61, -34}, 5, {0, 64, -47}, 4.2}},
    {"tail2", 3, {{0, 64, -47}, 4.2, {0, 71, -59}, 4.6}},
    {"tail3", 3, {{0, 71, -59}, 4.6, {0, 84, -63}, 2.2}},
};

const std::vector<Part> eye{
    {"head", 1, {{4.8, 91, 43.8}, 3, {4.8, 91, 43.8}, 3}},
};

const Vec3 ear_front = normalized({0.45, 0.1, 1});
const std::vector<Part> ear{
    {"ear", 1, {{5.8, 93, 35}, 5.4, {11.5, 112, 31}, 2.6, ear_front, 0.6}},
    {"ear", 1.2, {{7.4, 96.5, 39.6}, 3.6, {10.8, 107, 36.8}, 2.2}, true},
};

const std::vector<Part> foreleg{
    {"shoulder", 1, {{6, 55, 18}, 8.5, {8.5, 37, 13}, 5.4, x_axis, 0.8}},
    {"elbow", 3, {{8.5, 37, 12.5}, 5, {8.5, 16, 17}, 3.6}},
    {"wrist", 2, {{8.5, 16, 17.2}, 3.9, {8.5, 5, 18}, 3.5}},
    {"paw", 2, {{8.5, 4, 18}, 4.1, {8.5, 3.6, 24}, 3.9, y_axis, 0.92}},
    {"paw", 2, {{5.9, 3.0, 23}, 2.7, {5.4, 2.8, 25.5}, 2.6}},
    {"paw", 2, {{8.6, 3.2, 25}, 2.8, {8.7, 2.9, 28}, 2.7}},
    {"paw", 2, {{11.4, 3.0, 23}, 2.7, {11.9, 2.8, 25.5}, 2.6}},
    {"wrist", 1, {{8.5, 10, 14.8}, 1.7, {8.5, 8, 13.2}, 1.4}},
};

const std::vector<Part> hind_leg{
    {"hip", 1, {{6.5, 53, -25}, 10, {9, 37, -15}, 6.6, x_axis, 0.78}},
    {"knee", 4, {{9, 36.5, -15}, 6, {8.5, 20, -31.5}, 4}},
    {"hock", 2, {{8.5, 21.5, -33}, 3.7, {8.5, 5.5, -27.5}, 3.9}},
    {"foot", 2, {{8.5, 4, -27}, 4, {8.5, 3.6, -21.5}, 3.9, y_axis, 0.92}},
    {"foot", 2, {{6.2, 3.0, -21.5}, 2.6, {5.8, 2.8, -18}, 2.5}},
    {"foot", 2, {{8.6, 3.1, -20}, 2.7, {8.6, 2.9, -15.5}, 2.6}},
    {"foot", 2, {{11.0, 3.0, -21.5}, 2.6, {11.5, 2.8, -18}, 2.5}},
};

const std::vector<Turn> stand{
    {"neck", x_axis, -6}, {"head", y_axis, 12},  {"tail2", x_axis, -10},
    {"hip.l", x_axis, 8}, {"knee.l", x_axis, 4}, {"hock.l", x_axis, -10},
};

const std::vector<Turn> stride{
    {"loin", y_axis, 6},      {"chest", y_axis, -9},   {"neck", x_axis, 14},   {"head", x_axis, 4},        {"tail1", x_axis, 18},
    {"tail2", x_axis, -15},   {"tail3", x_axis, -20},  {"ear.l", x_axis, -30}, {"ear.r", x_axis, -26},     {"shoulder.l", x_axis, -36},
    {"elbow.l", x_axis, -14}, {"wrist.l", x_axis, 20}, {"paw.l", x_axis, 8},   {"shoulder.r", x_axis, 10}, {"elbow.r", x_axis, -16},
    {"wrist.r", x_axis, 52},  {"paw.r", x_axis, 22},   {"hip.l", x_axis, 28},  {"knee.l", x_axis, -12},    {"hock.l", x_axis, 18},
    {"foot.l", x_axis, 24},   {"hip.r", x_axis, -12},  {"knee.r", x_axis, 10}, {"hock.r", x_axis, -10},    {"foot.r", x_axis, 8},
};

const std::vector<Turn> look{
    {"pelvis", y_axis, -13},   {"loin", y_axis, 18},        {"chest", y_axis, 18},    {"neck", y_axis, 23},    {"head", y_axis, 23},
    {"head", z_axis, -13},     {"neck", x_axis, 9},         {"tail1", y_axis, 22},    {"tail2", y_axis, 27},   {"tail3", y_axis, 27},
    {"ear.l", z_axis, -22},    {"shoulder.r", x_axis, -36}, {"elbow.r", x_axis, -13}, {"wrist.r", x_axis, 59}, {"paw.r", x_axis, 18},
    {"shoulder.l", z_axis, 5}, {"hip.l", z_axis, 6},        {"hip.r", x_axis, 11},    {"knee.r", x_axis, 5},   {"hock.r", x_axis, -11},
};

const std::vector<Turn> bow{
    {"pelvis", x_axis, 18},      {"loin", x_axis, 6},      {"chest", x_axis, -4},  {"neck", x_axis, -22},  {"head", x_axis, -4},
    {"head", z_axis, 14},        {"tail1", x_axis, 23},    {"tail2", x_axis, 16},  {"tail3", y_axis, 27},  {"ear.r", z_axis, 18},
    {"shoulder.l", x_axis, -41}, {"elbow.l", x_axis, -36}, {"wrist.l", x_axis, 5}, {"paw.l", x_axis, 18},  {"shoulder.r", x_axis, -34},
    {"elbow.r", x_axis, -41},    {"wrist.r", x_axis, 7},   {"paw.r", x_axis, 18},  {"hip.l", x_axis, -16}, {"knee.l", x_axis, -4},
    {"hock.l", x_axis, 4},       {"foot.l", x_axis, -7},   {"hip.r", x_axis, -23}, {"knee.r", x_axis, 9},  {"hock.r", x_axis, -7},
};

const std::vector<Turn> sit{
    {"pelvis", x_axis, -39},    {"loin", x_axis, 6},    {"chest", x_axis, 6},   {"neck", x_axis, 17},      {"head", x_axis, 11},
    {"head", y_axis, -24},      {"tail1", x_axis, -11}, {"tail2", x_axis, -22}, {"tail2", y_axis, 37},     {"tail3", y_axis, 37},
    {"shoulder.l", x_axis, 15}, {"elbow.l", x_axis, 6}, {"wrist.l", x_axis, 7}, {"shoulder.r", x_axis, 9}, {"elbow.r", x_axis, 7},
    {"wrist.r", x_axis, 9},     {"hip.l", x_axis, -9},  {"hip.l", y_axis, 22},  {"knee.l", x_axis, 31},    {"hock.l", x_axis, -33},
    {"foot.l", x_axis, 20},     {"hip.r", x_axis, -13}, {"hip.r", y_axis, -22}, {"knee.r", x_axis, 33},    {"hock.r", x_axis, -35},
    {"foot.r", x_axis, 22},
};

const std::vector<Turn> leap{
    {"pelvis", x_axis, -4},      {"loin", x_axis, -8},     {"chest", x_axis, -10},  {"neck", x_axis, 20},    {"head", x_axis, 10},
    {"tail1", x_axis, -12},      {"tail2", x_axis, -24},   {"tail3", x_axis, 10},   {"ear.l", x_axis, -35},  {"ear.r", x_axis, -35},
    {"shoulder.l", x_axis, -58}, {"elbow.l", x_axis, -10}, {"wrist.l", x_axis, 22}, {"paw.l", x_axis, 20},   {"shoulder.r", x_axis, -44},
    {"elbow.r", x_axis, -26},    {"wrist.r", x_axis, 44},  {"paw.r", x_axis, 20},   {"hip.l", x_axis, 48},   {"knee.l", x_axis, -26},
    {"hock.l", x_axis, 34},      {"foot.l", x_axis, 20},   {"hip.r", x_axis, 36},   {"knee.r", x_axis, -12}, {"hock.r", x_axis, 30},
    {"foot.r", x_axis, 20},
};

}  // namespace

Creature hound() {
  return {.name = "hound",
          .flesh = Flesh(Skeleton(bones), {{1, false, trunk}, {1, true, eye}, {2, true, ear}, {4, true, foreleg}, {4, true, hind_leg}}),
          .holes = {{{11, 55, 8}, 4.5}, {{0, 48, -8}, 4}, {{-8.5, 0, 21}, 3}},  // flank, belly, sole of the right forepaw
          .shared_scale = 1.05,
          .independent_scale = 0.95,
          .poses = {
              {"stand", MeshKind::shared, stand, {turn(y_axis, 25), {12, 0, -40}}},
              {"stride", MeshKind::shared, stride, {turn(x_axis, -90) * turn(z_axis, 20), {-30, 55, 8}}},
              {"look", MeshKind::shared, look, {turn(y_axis, -110) * turn(x_axis, 15), {0, -20, 75}}},
              {"bow", MeshKind::independent, bow, {turn({1, 2, 3}, 70), {100, 20, 0}}},
              {"sit", MeshKind::holed, sit, {turn(z_axis, 85) * turn(y_axis, 30), {60, 10, 35}}},
              {"leap", MeshKind::glb, leap, {turn(y_axis, 60) * turn(x_axis, -20), {-15, 30, 5}}},
          }};
}

}  // namespace spherematch::samples
