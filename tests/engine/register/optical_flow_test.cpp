#include "engine/register/optical_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
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

FlowParameters three_levels() { return {{{16, 6, {0, 1}}, {32, 6, {0, 1}}, {64, 6, {0, 1}}}}; }

using Function = std::function<double(const Vector3d&)>;

/// Two smooth functions, turned by R. One alone would leave open where a point goes along its level lines.
std::vector<Function> signal(const Matrix3d& rotation) {
  return {[rotation](const Vector3d& p) { return test::smooth_function(rotation.transpose() * p); },
          [rotation](const Vector3d& p) {
            const Vector3d q = rotation.transpose() * p;
            return test::smooth_function({q[1], q[2], q[0]});
          }};
}

struct Pair {
  Points source, target;
};

/// Both ways of carrying signals along must do the same.
enum class Carrier { mesh, grid };

class FlowTogether : public ::testing::TestWithParam<Carrier> {
 protected:
  /// Where the vertices of a mesh go.
  [[nodiscard]] static Pair flow(const TriMesh& mesh, const std::vector<Function>& f, const std::vector<Function>& g,
                                 const FlowParameters& parameters, const Progress& progress = {}) {
    constexpr int kNodes = 64;
    std::unique_ptr<FlowSide> source, target;
    const GridSamples on_source = samples(f), on_target = samples(g);
    const std::vector<Eigen::Index> channels{0, 1};
    if (GetParam() == Carrier::mesh) {
      source = std::make_unique<MeshFlowSide>(on_mesh(mesh, f), Matrix3d::Identity());
      target = std::make_unique<MeshFlowSide>(on_mesh(mesh, g), Matrix3d::Identity());
    } else {
      source = std::make_unique<GridFlowSide>(on_source, channels, Matrix3d::Identity(), kNodes);
      target = std::make_unique<GridFlowSide>(on_target, channels, Matrix3d::Identity(), kNodes);
    }
    flow_together(*source, *target, FlowPlan(parameters, kNodes), progress);
    const Pair moved{source->warp().forward(mesh.vertices), target->warp().forward(mesh.vertices)};
    EXPECT_LT((moved.source.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
    EXPECT_TRUE(flipped_faces(moved.source, mesh.faces).empty());
    EXPECT_TRUE(flipped_faces(moved.target, mesh.faces).empty());
    return moved;
  }

 private:
  static std::shared_ptr<const MeshSignals> on_mesh(const TriMesh& mesh, const std::vector<Function>& functions) {
    Eigen::MatrixXd values(mesh.vertex_count(), static_cast<Eigen::Index>(functions.size()));
    for (Eigen::Index v = 0; v < values.rows(); ++v)
      for (std::size_t c = 0; c < functions.size(); ++c) values(v, static_cast<Eigen::Index>(c)) = functions[c](mesh.vertices.row(v));
    return std::make_shared<const MeshSignals>(mesh.vertices, mesh.faces, values);
  }
  static GridSamples samples(const std::vector<Function>& functions) {
    std::vector<Grid> grids;
    for (const Function& function : functions) grids.push_back(test::sampled(128, function));
    return GridSamples(grids);
  }
};

INSTANTIATE_TEST_SUITE_P(Carriers, FlowTogether, ::testing::Values(Carrier::mesh, Carrier::grid),
                         [](const auto& tested) { return tested.param == Carrier::mesh ? "Mesh" : "Grid"; });

double largest_move(const Points& a, const Points& b) { return (a - b).rowwise().norm().maxCoeff(); }

TEST_P(FlowTogether, MovesNothingBetweenIdenticalSignals) {
  const TriMesh mesh = icosphere(3);
  const std::vector<Function> f = signal(Matrix3d::Identity());
  const Pair moved = flow(mesh, f, f, three_levels());
  EXPECT_LT(largest_move(moved.source, mesh.vertices), 1e-14);
  EXPECT_LT(largest_move(moved.target, mesh.vertices), 1e-14);
}

TEST_P(FlowTogether, FindsASmallRotation) {
  const TriMesh mesh = icosphere(4);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Vector3d axis = test::Random(seed).unit_vector();
    const double angle = 0.02;
    const Matrix3d rotation = AngleAxisd(angle, axis).toRotationMatrix(), half = AngleAxisd(angle / 2, axis).toRotationMatrix();
    const Pair moved = flow(mesh, signal(Matrix3d::Identity()), signal(rotation), three_levels());
    // The source goes half the way and the target comes the other half.
    const double source = largest_move(moved.source, test::rotated(mesh.vertices, half));
    const double target = largest_move(moved.target, test::rotated(mesh.vertices, half.transpose()));
    // Measured: 3.2e-5, of 0.01.
    EXPECT_LT(source, 7e-5);
    EXPECT_LT(target, 7e-5);
  }
}

TEST_P(FlowTogether, MovesLessTheSmootherItMustBe) {
  const TriMesh mesh = icosphere(3);
  const Matrix3d rotation = AngleAxisd(0.02, Vector3d(0.3, 0.5, 0.8).normalized()).toRotationMatrix();
  double previous = 0.01;  // half the angle: the whole way
  for (const double alpha : {0.001, 0.05, 2.0, 100.0}) {
    const FlowParameters one_step{{{32, 1, {0, 1}}}, alpha};
    const Pair moved = flow(mesh, signal(Matrix3d::Identity()), signal(rotation), one_step);
    const double move = std::sqrt((moved.source - mesh.vertices).rowwise().squaredNorm().mean());
    EXPECT_LT(move, previous);
    EXPECT_GT(move, 0);
    previous = move;
  }
  // Measured: 0.0077, 0.0072, 0.0022, 6e-5.
  EXPECT_LT(previous, 1.2e-4);
}

TEST_P(FlowTogether, IsSymmetricInItsArguments) {
  const TriMesh mesh = icosphere(3);
  const std::vector<Function> f = signal(Matrix3d::Identity()),
                              g = signal(AngleAxisd(0.2, Vector3d(0.1, 0.6, -0.5).normalized()).toRotationMatrix());
  const Pair there = flow(mesh, f, g, three_levels()), back = flow(mesh, g, f, three_levels());
  // Measured: 2e-14.
  EXPECT_LT(largest_move(there.source, back.target), 2e-13);
  EXPECT_LT(largest_move(there.target, back.source), 2e-13);
  EXPECT_GT(largest_move(there.source, mesh.vertices), 0.02);
}

TEST_P(FlowTogether, DoesNotDependOnTheGridsPoles) {
  // Turning both shapes by the same rotation turns the result.
  const TriMesh mesh = icosphere(4);
  const Matrix3d turn = test::Random(5).rotation(), tilt = AngleAxisd(0.1, Vector3d(0.1, 0.6, -0.5).normalized()).toRotationMatrix();
  TriMesh turned = mesh;
  turned.vertices = test::rotated(mesh.vertices, turn).rowwise().normalized();
  const std::vector<Function> f = signal(Matrix3d::Identity()), g = signal(tilt);
  const Pair straight = flow(mesh, f, g, three_levels()), crooked = flow(turned, signal(turn), signal(turn * tilt), three_levels());
  // Measured: 3.5e-5, of moves up to 0.05.
  EXPECT_GT(largest_move(straight.source, mesh.vertices), 0.04);
  EXPECT_LT(largest_move(crooked.source, test::rotated(straight.source, turn)), 8e-5);
}

TEST_P(FlowTogether, BringsTheSignalsCloser) {
  const TriMesh mesh = icosphere(4);
  // Bumps at slightly different places, which no rotation brings together.
  const auto bumps = [](const std::vector<Vector3d>& places) {
    const Function sum = [places](const Vector3d& p) {
      double value = 0;
      for (const Vector3d& place : places) value += 2 * std::exp(8 * (p.dot(place.normalized()) - 1));
      return value;
    };
    return std::vector<Function>{sum, [](const Vector3d&) { return 0.0; }};
  };
  const std::vector<Vector3d> here{{1, 0, 0.2}, {-0.6, 0.7, 0.3}, {-0.2, -0.8, -0.4}, {0.1, 0.3, -1}};
  const std::vector<Vector3d> there{{1, 0.2, 0.1}, {-0.5, 0.8, 0.45}, {-0.35, -0.8, -0.3}, {0.1, 0.15, -1}};
  const std::vector<Function> f = bumps(here), g = bumps(there);
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

TEST_P(FlowTogether, SurvivesAConstantSignalAndStopsWhenAsked) {
  const TriMesh mesh = icosphere(2);
  const auto constant = [](double value) { return std::vector<Function>(2, [value](const Vector3d&) { return value; }); };
  const Pair moved = flow(mesh, constant(1), constant(2), three_levels());
  EXPECT_LT(largest_move(moved.source, mesh.vertices), 1e-12);
  std::stop_source stop;
  stop.request_stop();
  const Progress progress{{}, stop.get_token()};
  const std::vector<Function> f = signal(Matrix3d::Identity());
  test::expect_refusal(ErrorCode::cancelled, [&] { (void)flow(mesh, f, f, three_levels(), progress); });
}

TEST_P(FlowTogether, ALooseSolveOfFewerDegreesStaysClose) {
  const TriMesh mesh = icosphere(3);
  const std::vector<Function> f = signal(Matrix3d::Identity()),
                              g = signal(AngleAxisd(0.2, Vector3d(0.1, 0.6, -0.5).normalized()).toRotationMatrix());
  FlowParameters loose = three_levels();
  loose.tolerance = 0.03;
  loose.finest_resolution = 32;
  const Pair exact = flow(mesh, f, g, three_levels()), fast = flow(mesh, f, g, loose);
  const double move = std::sqrt((exact.source - mesh.vertices).rowwise().squaredNorm().mean());
  const double difference = std::sqrt((exact.source - fast.source).rowwise().squaredNorm().mean());
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, 0.05 * move);
}

TEST(Warp, BackwardUndoesForwardToTheThirdOrder) {
  const Points points = icosphere(3).vertices;
  const HarmonicTransform transform(64, 5);
  const auto error = [&](double size) {
    const auto field = std::make_shared<const TangentField>(transform.synthesize_tangent({}, size * test::random_harmonics(5, 7)));
    Warp warp(test::Random(3).rotation());
    for (int step = 0; step < 5; ++step) warp.append(field, step % 2 == 0 ? 0.5 : -0.25);
    const Points there = warp.forward(points);
    EXPECT_GT(largest_move(there, test::rotated(points, warp.rotation())), size);
    EXPECT_TRUE(warp.forward(points, 2) == there);
    return largest_move(warp.backward(there), points);
  };
  const double large = error(0.004), small = error(0.002);
  EXPECT_GT(small, 0);
  EXPECT_LT(small, large / 5);  // 8 but for the corners of the bilinear samples
}

}  // namespace
}  // namespace spherematch
