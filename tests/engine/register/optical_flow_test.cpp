#include "engine/register/optical_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/sphere/orientation.h"
#include "tests/engine/sphere/spheres.h"
#include "tests/support/meshes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::icosphere;

FlowParameters three_levels() { return {{{16, 6, {0, 1}}, {32, 6, {0, 1}}, {64, 6, {0, 1}}}, 0.05}; }

/// Two smooth functions on the vertices, turned by R. One alone would leave open where a point goes along its level lines.
Eigen::MatrixXd signal(const Points& sphere, const Matrix3d& rotation) {
  Eigen::MatrixXd values(sphere.rows(), 2);
  for (Eigen::Index v = 0; v < sphere.rows(); ++v) {
    const Vector3d p = rotation.transpose() * sphere.row(v).transpose();
    values.row(v) << test::smooth_function(p), test::smooth_function({p[1], p[2], p[0]});
  }
  return values;
}

struct Pair {
  Points source, target;
};

Pair flow(const TriMesh& mesh, const Eigen::MatrixXd& f, const Eigen::MatrixXd& g, const FlowParameters& parameters) {
  const FlipRepair repair(mesh);
  FlowShape source{&mesh.faces, &f, &repair, mesh.vertices}, target{&mesh.faces, &g, &repair, mesh.vertices};
  flow_together(source, target, parameters, {});
  EXPECT_LT((source.sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE(flipped_faces(source.sphere, mesh.faces).empty());
  EXPECT_TRUE(flipped_faces(target.sphere, mesh.faces).empty());
  return {source.sphere, target.sphere};
}

double largest_move(const Points& a, const Points& b) { return (a - b).rowwise().norm().maxCoeff(); }

TEST(FlowTogether, MovesNothingBetweenIdenticalSignals) {
  const TriMesh mesh = icosphere(3);
  const Eigen::MatrixXd f = signal(mesh.vertices, Matrix3d::Identity());
  const Pair moved = flow(mesh, f, f, three_levels());
  EXPECT_TRUE(moved.source == mesh.vertices);
  EXPECT_TRUE(moved.target == mesh.vertices);
}

TEST(FlowTogether, FindsASmallRotation) {
  const TriMesh mesh = icosphere(4);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Vector3d axis = test::Random(seed).unit_vector();
    const double angle = 0.02;
    const Matrix3d rotation = AngleAxisd(angle, axis).toRotationMatrix(), half = AngleAxisd(angle / 2, axis).toRotationMatrix();
    const Pair moved = flow(mesh, signal(mesh.vertices, Matrix3d::Identity()), signal(mesh.vertices, rotation), three_levels());
    // The source goes half the way and the target comes the other half.
    const double source = largest_move(moved.source, test::rotated(mesh.vertices, half));
    const double target = largest_move(moved.target, test::rotated(mesh.vertices, half.transpose()));
    // Measured: 3.2e-5, of 0.01.
    EXPECT_LT(source, 7e-5);
    EXPECT_LT(target, 7e-5);
  }
}

TEST(FlowTogether, MovesLessTheSmootherItMustBe) {
  const TriMesh mesh = icosphere(3);
  const Matrix3d rotation = AngleAxisd(0.02, Vector3d(0.3, 0.5, 0.8).normalized()).toRotationMatrix();
  double previous = 0.01;  // half the angle: the whole way
  for (const double alpha : {0.001, 0.05, 2.0, 100.0}) {
    const FlowParameters one_step{{{32, 1, {0, 1}}}, alpha};
    const Pair moved = flow(mesh, signal(mesh.vertices, Matrix3d::Identity()), signal(mesh.vertices, rotation), one_step);
    const double move = std::sqrt((moved.source - mesh.vertices).rowwise().squaredNorm().mean());
    EXPECT_LT(move, previous);
    EXPECT_GT(move, 0);
    previous = move;
  }
  // Measured: 0.0077, 0.0072, 0.0022, 6e-5.
  EXPECT_LT(previous, 1.2e-4);
}

TEST(FlowTogether, IsSymmetricInItsArguments) {
  const TriMesh mesh = icosphere(3);
  const Eigen::MatrixXd f = signal(mesh.vertices, Matrix3d::Identity()),
                        g = signal(mesh.vertices, AngleAxisd(0.2, Vector3d(0.1, 0.6, -0.5).normalized()).toRotationMatrix());
  const Pair there = flow(mesh, f, g, three_levels()), back = flow(mesh, g, f, three_levels());
  // Measured: 6e-16.
  EXPECT_LT(largest_move(there.source, back.target), 1e-14);
  EXPECT_LT(largest_move(there.target, back.source), 1e-14);
  EXPECT_GT(largest_move(there.source, mesh.vertices), 0.02);
}

TEST(FlowTogether, DoesNotDependOnTheGridsPoles) {
  // Turning both shapes by the same rotation turns the result.
  const TriMesh mesh = icosphere(4);
  const Matrix3d turn = test::Random(5).rotation();
  TriMesh turned = mesh;
  turned.vertices = test::rotated(mesh.vertices, turn).rowwise().normalized();
  const Eigen::MatrixXd f = signal(mesh.vertices, Matrix3d::Identity()),
                        g = signal(mesh.vertices, AngleAxisd(0.1, Vector3d(0.1, 0.6, -0.5).normalized()).toRotationMatrix());
  const Pair straight = flow(mesh, f, g, three_levels()), crooked = flow(turned, f, g, three_levels());
  // Measured: 3.5e-5, of moves up to 0.05.
  EXPECT_GT(largest_move(straight.source, mesh.vertices), 0.04);
  EXPECT_LT(largest_move(crooked.source, test::rotated(straight.source, turn)), 8e-5);
}

TEST(FlowTogether, BringsTheSignalsCloser) {
  const TriMesh mesh = icosphere(4);
  // Bumps at slightly different places, which no rotation brings together.
  const auto bumps = [&](const std::vector<Vector3d>& places) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(mesh.vertex_count(), 2);
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v)
      for (const Vector3d& place : places) values(v, 0) += 2 * std::exp(8 * (mesh.vertices.row(v).dot(place.normalized()) - 1));
    return values;
  };
  const std::vector<Vector3d> here{{1, 0, 0.2}, {-0.6, 0.7, 0.3}, {-0.2, -0.8, -0.4}, {0.1, 0.3, -1}};
  const std::vector<Vector3d> there{{1, 0.2, 0.1}, {-0.5, 0.8, 0.45}, {-0.35, -0.8, -0.3}, {0.1, 0.15, -1}};
  const Eigen::MatrixXd f = bumps(here), g = bumps(there);
  const Pair moved = flow(mesh, f, g, three_levels());
  // Each bump's summit, followed as the vertex nearest to it, ends near its partner.
  for (std::size_t i = 0; i < here.size(); ++i) {
    Eigen::Index a = 0, b = 0;
    (mesh.vertices * here[i].normalized()).maxCoeff(&a);
    (mesh.vertices * there[i].normalized()).maxCoeff(&b);
    const double before = (mesh.vertices.row(a) - mesh.vertices.row(b)).norm(), after = (moved.source.row(a) - moved.target.row(b)).norm();
    // Measured: 0.24 at most; the summit's vertex is up to 0.035 from the summit.
    EXPECT_LT(after, 0.4 * before);
  }
}

TEST(FlowTogether, SurvivesAConstantSignalAndStopsWhenAsked) {
  const TriMesh mesh = icosphere(2);
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Ones(mesh.vertex_count(), 2), f = signal(mesh.vertices, Matrix3d::Identity());
  const Pair moved = flow(mesh, constant, 2 * constant, three_levels());
  EXPECT_LT(largest_move(moved.source, mesh.vertices), 1e-12);
  const FlipRepair repair(mesh);
  FlowShape source{&mesh.faces, &f, &repair, mesh.vertices}, target = source;
  std::stop_source stop;
  stop.request_stop();
  const Progress progress{{}, stop.get_token()};
  test::expect_refusal(ErrorCode::cancelled, [&] { flow_together(source, target, three_levels(), progress); });
}

}  // namespace
}  // namespace spherematch
