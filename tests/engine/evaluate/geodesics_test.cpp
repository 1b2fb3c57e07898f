#include "engine/evaluate/geodesics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/meshes.h"

namespace spherematch {
namespace {

TEST(GeodesicGraph, UnfoldsTwoFacesAboutTheirEdge) {
  // A unit square, folded at a right angle along its diagonal from vertex 0 to vertex 2.
  TriMesh folded;
  folded.vertices.resize(4, 3);
  const double half = std::sqrt(0.5);
  folded.vertices << 0, 0, 0, half, half, 0, 2 * half, 0, 0, half, 0, half;
  folded.faces.resize(2, 3);
  folded.faces << 0, 2, 1, 0, 3, 2;
  const std::vector<std::int32_t> targets{1, 2, 3};
  const std::vector<double> from_tip = GeodesicGraph(folded).distances(1, targets);
  EXPECT_DOUBLE_EQ(from_tip[0], 0);
  EXPECT_NEAR(from_tip[1], 1, 1e-15);
  EXPECT_NEAR(from_tip[2], std::numbers::sqrt2, 1e-15) << "straight across the fold, not along two sides";
}

TEST(GeodesicGraph, TakesNoStraightWayThatLeavesTheFaces) {
  // Two thin triangles on a short edge: the line between their tips passes beside it.
  TriMesh flat;
  flat.vertices.resize(4, 3);
  flat.vertices << 0, 0, 0, 1, 0, 0, 3, 1, 0, 3, -1, 0;
  flat.faces.resize(2, 3);
  flat.faces << 0, 1, 2, 1, 0, 3;
  const std::vector<std::int32_t> tip{3};
  EXPECT_NEAR(GeodesicGraph(flat).distances(2, tip)[0], 2 * std::sqrt(5.0), 1e-15);
}

TEST(GeodesicGraph, IsAFewPercentAboveArcsOnTheSphere) {
  const TriMesh sphere = test::icosphere(4);
  const GeodesicGraph graph(sphere);
  std::vector<std::int32_t> all;
  for (std::int32_t v = 0; v < sphere.vertex_count(); ++v) all.push_back(v);
  const std::vector<double> lengths = graph.distances(0, all);
  double sum = 0, arcs = 0;
  for (const std::int32_t v : all) {
    const double arc = std::acos(std::clamp(sphere.vertices.row(0).dot(sphere.vertices.row(v)), -1.0, 1.0));
    const double length = lengths[static_cast<std::size_t>(v)];
    EXPECT_GE(length, arc * 0.998) << "chords are shorter than arcs by 0.1 percent here";
    EXPECT_LE(length, arc * 1.06 + 1e-12);
    sum += length;
    arcs += arc;
  }
  // Measured: 1.026.
  EXPECT_LT(sum / arcs, 1.035);
}

TEST(GeodesicSearch, StartsAnywhereAndForgetsWhatItFoundBefore) {
  const TriMesh sphere = test::icosphere(3);
  const GeodesicGraph graph(sphere);
  GeodesicSearch search(graph);
  std::vector<std::int32_t> targets{5, 100, 400, 5};
  for (int repetition = 0; repetition < 2; ++repetition) {
    const std::vector<GeodesicSearch::Start> starts{{7, 0.25}, {300, 0}};
    const std::vector<double> found = search.distances(starts, targets);
    const std::vector<double> from_seven = graph.distances(7, targets), from_other = graph.distances(300, targets);
    for (std::size_t i = 0; i < targets.size(); ++i) EXPECT_NEAR(found[i], std::min(from_seven[i] + 0.25, from_other[i]), 1e-12);
    (void)search.distances(std::vector<GeodesicSearch::Start>{{5, 0}}, std::vector<std::int32_t>{6});
  }
}

TEST(GeodesicGraph, SaysInfinityWhereThereIsNoPath) {
  const TriMesh two = test::joined(test::tetrahedron(), test::tetrahedron());
  const std::vector<std::int32_t> targets{1, 5};
  const std::vector<double> lengths = GeodesicGraph(two).distances(0, targets);
  EXPECT_LT(lengths[0], 10);
  EXPECT_EQ(lengths[1], std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace spherematch
