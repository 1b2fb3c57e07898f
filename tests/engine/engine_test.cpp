#include "engine/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/mesh/laplacian.h"
#include "engine/spectrum/curvature.h"
#include "engine/spectrum/signatures.h"
#include "engine/sphere/orientation.h"
#include "tests/support/meshes.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace spherematch {
namespace {

using test::quick_preparation;
using test::same_bytes;

void expect_same_shape(const PreprocessedShape& a, const PreprocessedShape& b) {
  EXPECT_TRUE(same_bytes(a.sphere, b.sphere));
  EXPECT_TRUE(same_bytes(a.eigenvalues, b.eigenvalues));
  EXPECT_TRUE(same_bytes(a.eigenvectors, b.eigenvectors));
  ASSERT_EQ(a.signals.size(), b.signals.size());
  for (std::size_t i = 0; i < a.signals.size(); ++i) EXPECT_TRUE(same_bytes(a.signals[i].values, b.signals[i].values));
  EXPECT_EQ(a.sphere_quality.flipped, b.sphere_quality.flipped);
  EXPECT_EQ(a.sphere_quality.solid_angle_defect, b.sphere_quality.solid_angle_defect);
  EXPECT_EQ(a.sphere_quality.area_distortion, b.sphere_quality.area_distortion);
}

void expect_same_match(const MatchResult& a, const MatchResult& b) {
  EXPECT_EQ(a.map.vertex, b.map.vertex);
  EXPECT_TRUE(same_bytes(a.map.corners, b.map.corners));
  EXPECT_TRUE(same_bytes(a.map.bary, b.map.bary));
  EXPECT_EQ(a.quality, b.quality);
  ASSERT_EQ(a.candidates.size(), b.candidates.size());
  for (std::size_t i = 0; i < a.candidates.size(); ++i) {
    EXPECT_EQ(a.candidates[i].rotation, b.candidates[i].rotation);
    EXPECT_EQ(a.candidates[i].correlation, b.candidates[i].correlation);
    EXPECT_EQ(a.candidates[i].score, b.candidates[i].score);
    EXPECT_EQ(a.candidates[i].chosen, b.candidates[i].chosen);
  }
}

void expect_prepared(const PreprocessedShape& shape, const TriMesh& mesh, const PreprocessParameters& parameters) {
  EXPECT_TRUE(shape.surface.mesh.vertices == mesh.vertices) << "the surface keeps its uploaded coordinates";
  ASSERT_EQ(shape.sphere.rows(), mesh.vertex_count());
  EXPECT_LT((shape.sphere.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE(flipped_faces(shape.sphere, mesh.faces).empty());
  EXPECT_EQ(shape.sphere_quality.flipped, 0);
  EXPECT_LT(shape.sphere_quality.solid_angle_defect, 1e-12);  // measured: 2e-14
  EXPECT_LT(shape.sphere_quality.area_distortion, 0.1);       // measured: 0.046
  EXPECT_EQ(shape.eigenvalues.size(), parameters.eigenpairs);
  EXPECT_EQ(shape.eigenvectors.rows(), mesh.vertex_count());
  EXPECT_EQ(shape.engine, engine_version());
  ASSERT_EQ(shape.signals.size(), parameters.hks_times.size() + selection_signal_names().size() + position_signal_names.size() + 1 +
                                      eigenfunction_names(parameters.eigenpairs).size());
  EXPECT_EQ(shape.signals[parameters.hks_times.size() - 1].name, "hks_0.01");
  EXPECT_EQ(shape.signals.back().name, eigenfunction_names(parameters.eigenpairs).back());
  for (const SignalGrid& signal : shape.signals) {
    EXPECT_EQ(signal.values.rows(), parameters.signal_resolution);
    EXPECT_EQ(signal.values.cols(), parameters.signal_resolution);
    EXPECT_TRUE(signal.values.allFinite());
  }
  ASSERT_FALSE(shape.seconds.empty());
  EXPECT_EQ(shape.seconds.back().first, "total");
}

/// Distance of each source vertex's image from the truth, relative to the square root of the target's area.
Eigen::VectorXd errors(const MatchResult& result, const TriMesh& target, const std::function<std::int32_t(std::int32_t)>& truth) {
  const double size = std::sqrt(test::total_area(target));
  Eigen::VectorXd distances(static_cast<Eigen::Index>(result.map.vertex.size()));
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) image += static_cast<double>(result.map.bary(i, k)) * target.vertices.row(result.map.corners(i, k));
    distances[i] = (image - target.vertices.row(truth(static_cast<std::int32_t>(i)))).norm() / size;
  }
  return distances;
}

void expect_valid_map(const MatchResult& result, const TriMesh& target) {
  for (std::size_t i = 0; i < result.map.vertex.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    ASSERT_GE(result.map.corners.row(row).minCoeff(), 0);
    ASSERT_LT(result.map.corners.row(row).maxCoeff(), target.vertex_count());
    ASSERT_GE(result.map.bary.row(row).minCoeff(), 0);
    ASSERT_NEAR(result.map.bary.row(row).sum(), 1, 1e-6);
    ASSERT_TRUE((result.map.corners.row(row).array() == result.map.vertex[i]).any());
  }
  int chosen = 0;
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    const CandidateSummary& candidate = result.candidates[i];
    if (i > 0) {
      EXPECT_LE(candidate.correlation, result.candidates[i - 1].correlation);
    }
    chosen += candidate.chosen ? 1 : 0;
    for (const CandidateSummary& other : result.candidates) EXPECT_TRUE(!candidate.chosen || candidate.score <= other.score);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(candidate.rotation.data());
    EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  }
  EXPECT_EQ(chosen, 1);
}

/// Collects reports, from any thread.
struct Log {
  std::mutex mutex;
  std::vector<double> fractions;
  std::vector<std::string> stages;
  [[nodiscard]] Progress progress() {
    return {[this](std::string_view stage, double fraction) {
              const std::scoped_lock lock(mutex);
              stages.emplace_back(stage);
              fractions.push_back(fraction);
            },
            {}};
  }
  void expect_rising() const {
    ASSERT_GE(fractions.size(), 3U);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_GE(fractions.front(), 0);
    EXPECT_EQ(fractions.back(), 1);
    for (const std::string& stage : stages) EXPECT_NE(stage, "");
  }
};

/// Without the shortcuts whose small errors depend on the numbering, which decides where they cut and in which order they add.
PreprocessParameters exact(PreprocessParameters parameters) {
  parameters.exact_rasterization = true;
  parameters.multilevel_eigenbasis = false;
  parameters.conformal_coarse_vertices = 0;
  return parameters;
}

class EngineOnCopies : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Parameters, EngineOnCopies, ::testing::Values(false, true),
                         [](const auto& tested) { return tested.param ? "Exact" : "Default"; });

TEST_P(EngineOnCopies, MapsABodyToItsTurnedAndRenumberedCopy) {
  const TriMesh body = test::creature(4);
  const auto order = test::shuffled(static_cast<std::int32_t>(body.vertex_count()), 1);
  const TriMesh copy = test::renumbered(test::transformed(body, 3, test::some_rotation(), {10, -4, 7}), order);
  std::vector<std::int32_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);

  const PreprocessParameters parameters = GetParam() ? exact({}) : PreprocessParameters{};
  Log preparing;
  const PreprocessedShape source = preprocess(test::verbatim_surface(body), parameters, preparing.progress(), 2);
  preparing.expect_rising();
  expect_prepared(source, body, parameters);
  const PreprocessedShape target = preprocess(test::verbatim_surface(copy), parameters, {}, 2);
  expect_prepared(target, copy, parameters);

  Log matching;
  const MatchResult result = match(source, target, {}, matching.progress(), 2);
  matching.expect_rising();
  ASSERT_EQ(result.map.vertex.size(), order.size());
  expect_valid_map(result, copy);
  const Eigen::VectorXd distances = errors(result, copy, [&](std::int32_t i) { return place[static_cast<std::size_t>(i)]; });
  // Measured in the mean: 1.0e-7 by the exact stages, since coordinates are kept in single precision, and 1.7e-4 by the others.
  EXPECT_LT(distances.mean(), GetParam() ? 1e-6 : 3.4e-4);
  EXPECT_EQ(result.seconds.back().first, "total");
  for (const auto& [name, value] : result.quality)
    if (name.starts_with("flipped")) {
      EXPECT_EQ(value, 0) << name;
    }

  // The same bytes at another number of threads.
  expect_same_shape(preprocess(test::verbatim_surface(body), parameters, {}, 1), source);
  expect_same_match(match(source, target, {}, {}, 1), result);
}

TEST(Engine, TheReverseMapIsTheInverse) {
  // The same body in another pose and on another mesh: stretched, and bent about the x axis.
  const TriMesh a = test::creature(3);
  TriMesh b = test::creature(4);
  for (Eigen::Index v = 0; v < b.vertex_count(); ++v) {
    const double y = 1.2 * b.vertices(v, 1), z = b.vertices(v, 2), angle = 0.15 * z;
    b.vertices.row(v) << 0.9 * b.vertices(v, 0), std::cos(angle) * y - std::sin(angle) * z, std::sin(angle) * y + std::cos(angle) * z;
  }
  const PreprocessedShape source = preprocess(test::verbatim_surface(a), quick_preparation()),
                          target = preprocess(test::verbatim_surface(b), quick_preparation());
  const MatchResult there = match(source, target), back = match(target, source);
  expect_valid_map(there, b);
  expect_valid_map(back, a);
  ASSERT_EQ(there.candidates.size(), back.candidates.size());
  const auto chosen = [](const MatchResult& result) {
    for (const CandidateSummary& candidate : result.candidates)
      if (candidate.chosen) return candidate;
    return CandidateSummary{};
  };
  const CandidateSummary forward = chosen(there), backward = chosen(back);
  EXPECT_NEAR(forward.correlation, backward.correlation, 1e-12);
  EXPECT_NEAR(forward.score, backward.score, 1e-10);  // measured: 1.1e-12
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(forward.rotation[3 * i + j], backward.rotation[3 * j + i], 1e-11);
  // There and back within the size of a triangle: both directions interpolate linearly on different meshes.
  double sum = 0;
  for (std::size_t i = 0; i < there.map.vertex.size(); ++i) {
    Eigen::RowVector3d image = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const std::int32_t corner = there.map.corners(static_cast<Eigen::Index>(i), k);
      for (int l = 0; l < 3; ++l)
        image += static_cast<double>(there.map.bary(static_cast<Eigen::Index>(i), k) * back.map.bary(corner, l)) *
                 a.vertices.row(back.map.corners(corner, l));
    }
    sum += (image - a.vertices.row(static_cast<Eigen::Index>(i))).norm();
  }
  const double mean = sum / static_cast<double>(there.map.vertex.size()) / std::sqrt(test::total_area(a));
  // Measured: 0.0017.
  EXPECT_LT(mean, 0.0034);
}

TEST_P(EngineOnCopies, PreprocessingDoesNotDependOnSizeAndPlace) {
  const TriMesh body = test::creature(3);
  const PreprocessParameters parameters = GetParam() ? exact(quick_preparation()) : quick_preparation();
  const PreprocessedShape one = preprocess(test::verbatim_surface(body), parameters);
  for (const double scale : {1e-6, 1e6}) {
    const PreprocessedShape other = preprocess(
        test::verbatim_surface(test::transformed(body, scale, Eigen::Matrix3d::Identity(), scale * Eigen::Vector3d(1, 2, 3))), parameters);
    // Measured: 5e-15; of eigenvalues up to 800, 5e-12 by the exact stages and 6e-4 by the others.
    EXPECT_LT((other.sphere - one.sphere).rowwise().norm().maxCoeff(), 1e-12);
    EXPECT_LT((other.eigenvalues - one.eigenvalues).cwiseAbs().maxCoeff(), GetParam() ? 1e-10 : 2e-3);
  }
}

TEST(Engine, StopsWithinHalfASecond) {
  // At points spread over the stages. Measured: 0.08 s at most.
  const Surface surface = test::verbatim_surface(test::creature(6));
  for (const int milliseconds : {0, 100, 300, 600}) {
    std::stop_source source;
    std::chrono::steady_clock::time_point asked;
    std::jthread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      asked = std::chrono::steady_clock::now();
      source.request_stop();
    });
    const Progress progress{{}, source.get_token()};
    test::expect_refusal(ErrorCode::cancelled, [&] { (void)preprocess(surface, {}, progress, 2); });
    const auto ended = std::chrono::steady_clock::now();
    stopper.join();
    EXPECT_LT(std::chrono::duration<double>(ended - asked).count(), 0.5) << "asked after " << milliseconds << " ms";
  }
}

TEST(Engine, AMatchStopsWhenAsked) {
  const PreprocessedShape shape = preprocess(test::verbatim_surface(test::creature(2)), quick_preparation());
  std::stop_source source;
  source.request_stop();
  const Progress progress{{}, source.get_token()};
  test::expect_refusal(ErrorCode::cancelled, [&] { (void)match(shape, shape, {}, progress, 2); });
}

TEST(Engine, PreparesTheSmallestMeshes) {
  for (const TriMesh& mesh : {test::tetrahedron(), test::icosphere(0), test::icosphere(1)}) {
    Log log;
    const PreprocessedShape shape = preprocess(test::verbatim_surface(mesh), quick_preparation(), log.progress());
    log.expect_rising();  // also where the conformal stage has to begin anew
    EXPECT_EQ(shape.sphere_quality.flipped, 0);
    EXPECT_LT(shape.sphere_quality.solid_angle_defect, 1e-12);
    const MatchResult result = match(shape, shape);
    expect_valid_map(result, mesh);
  }
}

template <typename Parameters>
void expect_invalid(const Parameters& parameters, const std::string& field) {
  try {
    parameters.validate();
    ADD_FAILURE() << field << " was accepted";
  } catch (const EngineError& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_parameter);
    EXPECT_EQ(std::string(error.what()).substr(0, field.size() + 1), field + " ") << error.what();
  }
}

TEST(PreprocessParameters, NameTheInvalidField) {
  PreprocessParameters().validate();
  PreprocessParameters::paper().validate();
  const double nan = std::nan(""), infinity = HUGE_VAL;
  const auto with = [](const auto& set) {
    PreprocessParameters parameters;
    set(parameters);
    return parameters;
  };
  for (const int steps : {0, -1, 1001}) expect_invalid(with([&](auto& p) { p.conformal_steps = steps; }), "conformal_steps");
  for (const double size : {0.0, -1.0, nan, infinity}) {
    expect_invalid(with([&](auto& p) { p.conformal_step_size = size; }), "conformal_step_size");
    expect_invalid(with([&](auto& p) { p.authalic_step_size = size; }), "authalic_step_size");
    expect_invalid(with([&](auto& p) { p.authalic_longest_move = size; }), "authalic_longest_move");
    if (size != 0) expect_invalid(with([&](auto& p) { p.conformal_tolerance = size; }), "conformal_tolerance");
    expect_invalid(with([&](auto& p) { p.authalic_smoothing = size; }), "authalic_smoothing");
    expect_invalid(with([&](auto& p) { p.hks_times = {1, size}; }), "hks_times");
  }
  for (const int resolution : {0, 14, 17, 1026}) {
    expect_invalid(with([&](auto& p) { p.authalic_resolution = resolution; }), "authalic_resolution");
    expect_invalid(with([&](auto& p) { p.signal_resolution = resolution; }), "signal_resolution");
  }
  for (const int vertices : {-1, 99, 1'000'001})
    expect_invalid(with([&](auto& p) { p.conformal_coarse_vertices = vertices; }), "conformal_coarse_vertices");
  for (const int steps : {-1, 101}) expect_invalid(with([&](auto& p) { p.conformal_fine_steps = steps; }), "conformal_fine_steps");
  for (const int steps : {-1, 1001}) expect_invalid(with([&](auto& p) { p.authalic_steps = steps; }), "authalic_steps");
  for (const int pairs : {9, 501}) expect_invalid(with([&](auto& p) { p.eigenpairs = pairs; }), "eigenpairs");
  expect_invalid(with([&](auto& p) { p.hks_times.clear(); }), "hks_times");
  expect_invalid(with([&](auto& p) { p.hks_times.assign(33, 1.0); }), "hks_times");
  test::expect_refusal(ErrorCode::invalid_parameter,
                       [&] { (void)preprocess(test::verbatim_surface(test::icosphere(1)), with([](auto& p) { p.eigenpairs = 0; })); });
}

TEST(MatchParameters, NameTheInvalidField) {
  MatchParameters().validate();
  MatchParameters::paper().validate();
  const double nan = std::nan(""), infinity = HUGE_VAL;
  const auto with = [](const auto& set) {
    MatchParameters parameters;
    set(parameters);
    return parameters;
  };
  for (const double size : {0.0, -1.0, nan, infinity}) {
    expect_invalid(with([&](auto& p) { p.rotation_time = size; }), "rotation_time");
    expect_invalid(with([&](auto& p) { p.flow_smoothness = size; }), "flow_smoothness");
    expect_invalid(with([&](auto& p) { p.flow_times = {0.5, size}; }), "flow_times");
  }
  for (const int bandwidth : {3, 65}) expect_invalid(with([&](auto& p) { p.rotation_bandwidth = bandwidth; }), "rotation_bandwidth");
  for (const int count : {0, 17}) expect_invalid(with([&](auto& p) { p.max_candidates = count; }), "max_candidates");
  for (const double separation : {-0.1, 8.0, nan})
    expect_invalid(with([&](auto& p) { p.candidate_separation = separation; }), "candidate_separation");
  for (const double threshold : {-0.1, 1.1, nan})
    expect_invalid(with([&](auto& p) { p.candidate_threshold = threshold; }), "candidate_threshold");
  expect_invalid(with([&](auto& p) { p.flow_times.clear(); }), "flow_times");
  expect_invalid(with([&](auto& p) { p.flow_times.assign(6, 0.5); }), "flow_times");
  for (const int resolution : {6, 9, 34}) expect_invalid(with([&](auto& p) { p.flow_resolution = resolution; }), "flow_resolution");
  for (const int iterations : {-1, 101}) expect_invalid(with([&](auto& p) { p.flow_iterations = iterations; }), "flow_iterations");
  for (const int iterations : {0, 101})
    expect_invalid(with([&](auto& p) { p.elastic_iterations = {2, iterations}; }), "elastic_iterations");
  expect_invalid(with([&](auto& p) { p.elastic_iterations.assign(4, 1); }), "elastic_iterations");
  for (const int count : {-1, 1001}) {
    expect_invalid(with([&](auto& p) { p.elastic_eigenfunctions = count; }), "elastic_eigenfunctions");
    expect_invalid(with([&](auto& p) { p.elastic_more_eigenfunctions = count; }), "elastic_more_eigenfunctions");
  }
  expect_invalid(with([&](auto& p) { p.flow_detail_from = -1; }), "flow_detail_from");
  expect_invalid(with([&](auto& p) { p.flow_repeated = -1; }), "flow_repeated");
  for (const double value : {-1.0, nan, infinity}) {
    expect_invalid(with([&](auto& p) { p.flow_detail = value; }), "flow_detail");
    expect_invalid(with([&](auto& p) { p.elastic_area = value; }), "elastic_area");
    expect_invalid(with([&](auto& p) { p.elastic_yield = value; }), "elastic_yield");
    expect_invalid(with([&](auto& p) { p.elastic_signals = value; }), "elastic_signals");
    expect_invalid(with([&](auto& p) { p.elastic_signal_yield = value; }), "elastic_signal_yield");
    expect_invalid(with([&](auto& p) { p.elastic_spectrum = value; }), "elastic_spectrum");
    expect_invalid(with([&](auto& p) { p.elastic_longest_move = value; }), "elastic_longest_move");
    expect_invalid(with([&](auto& p) { p.elastic_settled = value; }), "elastic_settled");
  }
  expect_invalid(with([&](auto& p) { p.hints.assign(65, {1, 1}); }), "hints");
  expect_invalid(with([&](auto& p) { p.hints = {{0, 0}, {-1, 0}}; }), "hints");
  expect_invalid(with([&](auto& p) { p.hints = {{0, -1}}; }), "hints");
  const PreprocessedShape nothing;
  test::expect_refusal(ErrorCode::invalid_parameter, [&] { (void)match(nothing, nothing, with([](auto& p) { p.max_candidates = 0; })); });
}

}  // namespace
}  // namespace spherematch
