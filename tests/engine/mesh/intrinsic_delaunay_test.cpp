#include "engine/mesh/intrinsic_delaunay.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "engine/mesh/laplacian.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

double cotangent(const IntrinsicMesh& mesh, Eigen::Index f, int k) {
  const double l = mesh.lengths(f, k), m = mesh.lengths(f, (k + 1) % 3), n = mesh.lengths(f, (k + 2) % 3);
  const double s = (l + m + n) / 2;
  return (m * m + n * n - l * l) / (4 * std::sqrt(s * (s - l) * (s - m) * (s - n)));
}

/// The sum of the two cotangents opposite each edge. Both sides of an edge have the same bits for its length, which tells apart
/// several edges between two vertices.
std::vector<double> cotangent_sums(const IntrinsicMesh& mesh) {
  std::map<std::tuple<std::int32_t, std::int32_t, double>, std::vector<double>> sides;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({mesh.faces(f, (k + 1) % 3), mesh.faces(f, (k + 2) % 3)});
      sides[{low, high, mesh.lengths(f, k)}].push_back(cotangent(mesh, f, k));
    }
  std::vector<double> sums;
  for (const auto& [edge, cotangents] : sides) {
    EXPECT_EQ(cotangents.size(), 2U) << "edge " << std::get<0>(edge) << " " << std::get<1>(edge) << " has not two sides";
    sums.push_back(cotangents.front() + cotangents.back());
  }
  return sums;
}

void expect_triangles(const IntrinsicMesh& mesh) {
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const double longest = mesh.lengths.row(f).maxCoeff();
    ASSERT_GT(mesh.lengths.row(f).minCoeff(), 0) << "face " << f;
    ASSERT_LT(longest, mesh.lengths.row(f).sum() - longest) << "face " << f;
  }
  EXPECT_GT(face_areas(mesh).minCoeff(), 0);
}

/// A closed surface of bad triangles: an ellipsoid of random vertices pulled out.
TriMesh rough(int level, double noise) {
  TriMesh mesh = test::ellipsoid(level, {1, 0.4, 3});
  std::mt19937_64 random(1);
  for (double& x : mesh.vertices.reshaped()) x *= 1 + noise * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
  return mesh;
}

TEST(MakeDelaunay, LeavesNoNegativeWeight) {
  for (const TriMesh& mesh : {rough(3, 0.05), rough(3, 0.3), test::creature(4), test::torus(30, 5)}) {
    IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
    const std::vector<double> before = cotangent_sums(intrinsic);
    ASSERT_LT(*std::min_element(before.begin(), before.end()), -0.01) << "nothing to do";
    const double area = face_areas(intrinsic).sum();
    make_delaunay(intrinsic);
    expect_triangles(intrinsic);
    const std::vector<double> after = cotangent_sums(intrinsic);
    EXPECT_GE(*std::min_element(after.begin(), after.end()), -1e-8);
    // Measured: 3e-15.
    EXPECT_NEAR(face_areas(intrinsic).sum(), area, 1e-12 * area);
    EXPECT_NEAR(area, test::total_area(mesh), 1e-12 * area) << "mollified without need";
    EXPECT_EQ(intrinsic.faces.rows(), mesh.face_count());
  }
}

TEST(MakeDelaunay, KeepsTheAngleSumOfEveryVertex) {
  const TriMesh mesh = rough(3, 0.2);
  const auto angle_sums = [&](const IntrinsicMesh& intrinsic) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (Eigen::Index f = 0; f < intrinsic.faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) sums[intrinsic.faces(f, k)] += std::atan2(1.0, cotangent(intrinsic, f, k));
    return sums;
  };
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  const Eigen::VectorXd before = angle_sums(intrinsic);
  make_delaunay(intrinsic);
  // The metric has not changed, so neither has the curvature.
  EXPECT_LT((angle_sums(intrinsic) - before).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(MakeDelaunay, LowersTheDirichletEnergyOfEveryFunction) {
  // Rippa 1990; among all triangulations of the metric the Delaunay one has the least energy.
  const TriMesh mesh = rough(3, 0.2);
  IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  const SparseMatrix before = cotangent_laplacian(intrinsic, mesh.vertex_count()).stiffness;
  make_delaunay(intrinsic);
  const SparseMatrix after = cotangent_laplacian(intrinsic, mesh.vertex_count()).stiffness;
  std::mt19937_64 random(2);
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd u(mesh.vertex_count());
    for (double& value : u) value = static_cast<double>(random() >> 11) * 0x1p-53;
    EXPECT_LT(u.dot(after.selfadjointView<Eigen::Lower>() * u), u.dot(before.selfadjointView<Eigen::Lower>() * u));
  }
}

/// Two copies of a flat jittered grid, sheared so that its triangles are far from Delaunay, sewn along their border: a flat bag.
struct Bag {
  TriMesh mesh;
  int side;
  [[nodiscard]] bool inside(std::int32_t v) const {
    if (v >= side * side) return true;
    const int i = v % side, j = v / side;
    return i > 0 && j > 0 && i + 1 < side && j + 1 < side;
  }
};

Bag flat_bag(int side) {
  std::mt19937_64 random(3);
  Bag bag{{}, side};
  const int inner = side - 2;
  bag.mesh.vertices = Points::Zero(side * side + inner * inner, 3);
  const auto upper = [&](int i, int j) { return j * side + i; };
  const auto lower = [&](int i, int j) {
    return i > 0 && j > 0 && i < side - 1 && j < side - 1 ? side * side + (j - 1) * inner + i - 1 : upper(i, j);
  };
  const auto jitter = [&] { return 0.3 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5); };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const bool border = lower(i, j) == upper(i, j);
      for (const int v : {upper(i, j), lower(i, j)}) {
        const double x = i + (border ? 0 : jitter()), y = j + (border ? 0 : jitter());
        bag.mesh.vertices.row(v) << x + 2.5 * y, y, 0;
      }
    }
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      faces.push_back({upper(i, j), upper(i + 1, j), upper(i + 1, j + 1)});
      faces.push_back({upper(i, j), upper(i + 1, j + 1), upper(i, j + 1)});
      faces.push_back({lower(i, j), lower(i + 1, j + 1), lower(i + 1, j)});
      faces.push_back({lower(i, j), lower(i, j + 1), lower(i + 1, j + 1)});
    }
  bag.mesh.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) bag.mesh.faces(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = faces[f][k];
  return bag;
}

TEST(MakeDelaunay, KeepsAFlatPatchFlat) {
  const Bag bag = flat_bag(14);
  const auto middle = [&](std::int32_t v) {  // so deep inside a sheet that no edge to it comes from the other
    const double y = bag.mesh.vertices(v, 1), x = bag.mesh.vertices(v, 0) - 2.5 * y;
    return bag.inside(v) && x > 4 && x < 9 && y > 4 && y < 9;
  };
  IntrinsicMesh intrinsic = intrinsic_mesh(bag.mesh);
  make_delaunay(intrinsic);
  int edges = 0, changed = 0;
  for (Eigen::Index f = 0; f < intrinsic.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = intrinsic.faces(f, (k + 1) % 3), b = intrinsic.faces(f, (k + 2) % 3);
      if (!middle(a) || !middle(b)) continue;
      // An edge of the flat sheet is as long as its ends are apart.
      ASSERT_NEAR(intrinsic.lengths(f, k), (bag.mesh.vertices.row(a) - bag.mesh.vertices.row(b)).norm(), 1e-12);
      ++edges;
      changed += intrinsic.faces(f, k) != bag.mesh.faces(f, k) ? 1 : 0;
    }
  EXPECT_GT(edges, 100);
  EXPECT_GT(changed, 30);
  // Linear functions are harmonic wherever the surface is flat.
  const SparseMatrix stiffness = cotangent_laplacian(intrinsic, bag.mesh.vertex_count()).stiffness;
  const Points residual = stiffness.selfadjointView<Eigen::Lower>() * bag.mesh.vertices;
  for (std::int32_t v = 0; v < bag.mesh.vertex_count(); ++v)
    if (middle(v)) { EXPECT_LT(residual.row(v).norm(), 1e-11) << "vertex " << v; }
}

/// Shares by which one basis differs from another are compared by sums over clusters.
TEST(MakeDelaunay, KeepsTheSpectrumUpToDiscretisation) {
  const auto lowest = [](const IntrinsicMesh& mesh, Eigen::Index vertices) {
    const Laplacian laplacian = cotangent_laplacian(mesh, vertices);
    const Eigen::MatrixXd stiffness = Eigen::MatrixXd(laplacian.stiffness).selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd mass = Eigen::MatrixXd(laplacian.mass).selfadjointView<Eigen::Lower>();
    return Eigen::VectorXd(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, mass, Eigen::EigenvaluesOnly).eigenvalues().head(12));
  };
  const Bag bag = flat_bag(14);
  IntrinsicMesh intrinsic = intrinsic_mesh(bag.mesh);
  const Eigen::VectorXd before = lowest(intrinsic, bag.mesh.vertex_count());
  make_delaunay(intrinsic);
  const Eigen::VectorXd after = lowest(intrinsic, bag.mesh.vertex_count());
  std::printf("sums %g %g\n", before.sum(), after.sum());
  EXPECT_NEAR(after[0], 0, 1e-10);
  EXPECT_NEAR(after.sum(), before.sum(), 0.05 * before.sum());
  EXPECT_LT(after.sum(), before.sum());  // as the energies are
}

TEST(IntrinsicMesh, MollifiesDegenerateTriangles) {
  // A vertex moved onto its neighbour, another onto the middle of the opposite edge, and a third onto its edge's line.
  TriMesh mesh = test::icosphere(2);
  mesh.vertices.row(mesh.faces(10, 1)) = mesh.vertices.row(mesh.faces(10, 0));
  mesh.vertices.row(mesh.faces(200, 0)) = 0.5 * (mesh.vertices.row(mesh.faces(200, 1)) + mesh.vertices.row(mesh.faces(200, 2)));
  for (const double scale : {1.0, 1e-6, 1e6}) {
    TriMesh scaled = mesh;
    scaled.vertices *= scale;
    ASSERT_LT(face_areas(scaled.vertices, scaled.faces).minCoeff(), 1e-12 * scale * scale);
    IntrinsicMesh intrinsic = intrinsic_mesh(scaled);
    expect_triangles(intrinsic);
    const double mean = intrinsic.lengths.mean();
    for (Eigen::Index f = 0; f < intrinsic.faces.rows(); ++f)
      EXPECT_GT(intrinsic.lengths.row(f).sum() - 2 * intrinsic.lengths.row(f).maxCoeff(), 0.99e-5 * mean);
    make_delaunay(intrinsic);
    expect_triangles(intrinsic);
    const Laplacian laplacian = cotangent_laplacian(intrinsic, scaled.vertex_count());
    const Eigen::MatrixXd stiffness = Eigen::MatrixXd(laplacian.stiffness).selfadjointView<Eigen::Lower>();
    ASSERT_TRUE(stiffness.allFinite());
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(eigenvalues[0], -1e-12 * eigenvalues[eigenvalues.size() - 1]);
    const std::vector<double> sums = cotangent_sums(intrinsic);
    std::printf("degenerate min sum %g\n", *std::min_element(sums.begin(), sums.end()));
  }
}

TEST(IntrinsicMesh, IsTheMeshItselfWhereNothingIsDegenerate) {
  const TriMesh mesh = test::creature(2);
  const IntrinsicMesh intrinsic = intrinsic_mesh(mesh);
  EXPECT_TRUE(intrinsic.faces == mesh.faces);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(intrinsic.lengths(f, k), (mesh.vertices.row(mesh.faces(f, (k + 1) % 3)) - mesh.vertices.row(mesh.faces(f, (k + 2) % 3))).norm());
  EXPECT_LT((face_areas(intrinsic) - face_areas(mesh.vertices, mesh.faces)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(MakeDelaunay, LeavesADelaunayMeshAloneAndIsDeterministic) {
  IntrinsicMesh sphere = intrinsic_mesh(test::icosphere(3));
  const IntrinsicMesh before = sphere;
  make_delaunay(sphere);
  EXPECT_TRUE(sphere.faces == before.faces);
  EXPECT_TRUE(sphere.lengths == before.lengths);
  IntrinsicMesh first = intrinsic_mesh(rough(3, 0.3)), second = first;
  make_delaunay(first);
  make_delaunay(second);
  EXPECT_TRUE(first.faces == second.faces);
  EXPECT_TRUE(first.lengths == second.lengths);
}

}  // namespace
}  // namespace spherematch
