// Solids of unit cubes at random: edges of four faces, vertices of several fans, handles, cavities and several components.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "engine/mesh/repair.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using Cell = std::array<int, 3>;
using Cells = std::set<Cell>;

Cells random_cells(std::mt19937_64& random, int side, std::uint64_t percent) {
  Cells cells;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        if (random() % 100 < percent) cells.insert({x, y, z});
  return cells;
}

/// The squares between a cell and no cell, facing outward. With `soup` every square has four vertices of its own.
PolygonMesh surface_of(const Cells& cells, bool soup) {
  std::map<Cell, std::int32_t> number;
  std::vector<Cell> vertices;
  std::vector<std::vector<std::int32_t>> faces;
  for (const Cell& cell : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Cell beside = cell;
        beside[axis] += side == 1 ? 1 : -1;
        if (cells.contains(beside)) continue;
        std::vector<std::int32_t> face;
        for (const auto& [u, v] : std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Cell corner = cell;
          corner[axis] += side;
          corner[(axis + 1) % 3] += u;
          corner[(axis + 2) % 3] += v;
          const auto [entry, fresh] = number.try_emplace(corner, static_cast<std::int32_t>(vertices.size()));
          if (fresh || soup) vertices.push_back(corner);
          face.push_back(soup ? static_cast<std::int32_t>(vertices.size() - 1) : entry->second);
        }
        if (side == 0) std::swap(face[1], face[3]);
        faces.push_back(face);
      }
  Points points(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    points.row(static_cast<Eigen::Index>(v)) << vertices[v][0], vertices[v][1], vertices[v][2];
  return test::polygons(points, faces);
}

struct Outcome {
  bool sphere = false;
  Surface surface;
};

/// A surface, which then keeps its promises, or a refusal for its genus; anything else fails the test.
Outcome outcome_of(const PolygonMesh& mesh) {
  try {
    Outcome outcome{true, repair(mesh, RepairMode::fill)};
    test::expect_invariants(outcome.surface, mesh);
    return outcome;
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::wrong_genus) << error.what();
    return {};
  }
}

class Voxels : public testing::TestWithParam<int> {};

TEST_P(Voxels, ComeApartWhereTheyTouch) {
  const auto percent = static_cast<std::uint64_t>(GetParam());
  std::mt19937_64 random(20240600 + percent);
  int spheres = 0;
  constexpr int rounds = 200;
  for (int round = 0; round < rounds && !HasFailure(); ++round) {
    const Cells cells = random_cells(random, 4, percent);
    if (cells.empty()) continue;
    const Outcome indexed = outcome_of(surface_of(cells, false));
    const Outcome soup = outcome_of(surface_of(cells, true));
    EXPECT_EQ(indexed.sphere, soup.sphere) << "shared vertices and welded ones must lead to the same surface";
    if (!indexed.sphere) continue;
    ++spheres;
    EXPECT_EQ(indexed.surface.report.filled_loops, 0) << "the surface of a solid has no boundary";
    EXPECT_EQ(soup.surface.report.filled_loops, 0);
    EXPECT_EQ(indexed.surface.report.welded_vertices, 0);
    const double volume = test::signed_volume(indexed.surface.mesh);
    EXPECT_NEAR(volume, std::round(volume), 1e-9) << "the surface must enclose whole cubes";
    EXPECT_GE(volume, 0.9);
    EXPECT_NEAR(volume, test::signed_volume(soup.surface.mesh), 1e-9);
  }
  EXPECT_GT(spheres, rounds / 4);
}

INSTANTIATE_TEST_SUITE_P(Densities, Voxels, testing::Values(5, 15, 25, 40, 60, 85, 97));

}  // namespace
}  // namespace spherematch
