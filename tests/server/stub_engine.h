// An engine whose uploads are words and whose preparation waits for the test.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <string>
#include <thread>

#include "server/engine_port.h"

namespace spherematch::testing {

/// "sphere ..." is a tetrahedron; "torus" is refused; a sphere whose upload contains "hopeless" fails in preparation.
class StubEngine final : public EnginePort {
 public:
  std::atomic<bool> hold_preparation = false;  ///< preparations wait while this is set, unless they are cancelled
  std::atomic<bool> hold_matches = false;
  std::atomic<int> reads = 0;
  std::atomic<int> preparations = 0;  ///< started
  std::atomic<int> cancellations = 0;
  std::atomic<int> lose_next = 0;  ///< so many preparations end as if their process had crashed
  std::atomic<bool> no_memory = false;
  mutable std::atomic<int> matches = 0;          ///< started
  mutable std::atomic<bool> same_shape = false;  ///< the last match was of one object with itself
  std::string version_text = "stub-1";
  mutable GroundTruth last_truth;  ///< that evaluate() got last; for tests of one thread
  mutable std::string mesh_name;   ///< that read_mesh() got last; for tests of one thread

  [[nodiscard]] std::string version() const override { return version_text; }

  [[nodiscard]] Surface read_surface(std::span<const std::byte> bytes, std::string_view, const ReadOptions& options,
                                     const ReadLimits& limits) const override {
    ++const_cast<StubEngine*>(this)->reads;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("torus")) {
      throw EngineError(ErrorCode::wrong_genus, "Euler characteristic 0", {.vertices = {}, .faces = {7}, .edges = {{1, 2}}});
    }
    if (text.starts_with("crowd")) throw EngineError(ErrorCode::too_many_vertices, "more than " + std::to_string(limits.max_vertices));
    if (!text.starts_with("sphere")) throw EngineError(ErrorCode::unsupported_format, "no reader recognises the bytes");
    return tetrahedron(options, text.find("hopeless") != std::string_view::npos);
  }

  [[nodiscard]] PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name) const override {
    mesh_name = name;
    const Surface surface = read_surface(bytes, name, {}, {});
    PolygonMesh mesh;
    mesh.vertices.setZero(surface.uploaded_vertices(), 3);
    mesh.vertices.topRows(surface.mesh.vertex_count()) = surface.mesh.vertices;
    for (Eigen::Index f = 0; f < surface.mesh.face_count(); ++f) {
      for (const std::int32_t corner : surface.uploaded_corners.row(f)) mesh.indices.push_back(corner);
      mesh.offsets.push_back(static_cast<std::int32_t>(mesh.indices.size()));
    }
    return mesh;
  }

  [[nodiscard]] PreprocessedShape preprocess(Surface surface, const Progress& progress) const override {
    auto& self = *const_cast<StubEngine*>(this);
    ++self.preparations;
    progress.report("conformal", 0.25);
    if (self.lose_next > 0) {
      --self.lose_next;
      throw PreparationLost("its process was ended by signal 11");
    }
    if (no_memory) throw std::bad_alloc();
    try {
      while (hold_preparation) {
        progress.check();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    } catch (const EngineError&) {
      ++self.cancellations;
      throw;
    }
    if (surface.mesh.vertices(0, 0) > 5) throw EngineError(ErrorCode::parametrization_failed, "three flipped triangles remain");
    PreprocessedShape shape;
    shape.sphere = surface.mesh.vertices.rowwise().normalized();
    shape.surface = std::move(surface);
    shape.eigenvalues = Eigen::VectorXd::LinSpaced(2, 0, 1);
    shape.eigenvectors = Eigen::MatrixXf::Ones(shape.sphere.rows(), 2);
    shape.signals = {{"hks_1", Eigen::MatrixXf::Ones(4, 4)}};
    shape.seconds = {{"conformal", 0.5}, {"total", 0.5}};
    shape.engine = version_text;
    return shape;
  }

  [[nodiscard]] MatchResult match(const ShapePointer& source_shape, const ShapePointer& target_shape, const MatchParameters& parameters,
                                  const Progress& progress) const override {
    const PreprocessedShape &source = *source_shape, &target = *target_shape;
    ++matches;
    same_shape = source_shape == target_shape;
    while (hold_matches) {
      progress.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (parameters.candidate > 1) throw EngineError(ErrorCode::invalid_parameter, "candidate: there is no candidate 2");
    const std::int32_t n = source.surface.uploaded_vertices();
    MatchResult result;
    result.map.corners.setConstant(n, 3, -1);
    result.map.bary.setZero(n, 3);
    for (std::int32_t i = 0; i < n; ++i) {
      const bool dropped = source.surface.surface_vertex[static_cast<std::size_t>(i)] < 0;
      result.map.vertex.push_back(dropped ? -1 : (i + 1) % static_cast<std::int32_t>(target.surface.mesh.vertex_count()));
      if (dropped) continue;
      result.map.corners.row(i) << result.map.vertex.back(), 0, 1;
      result.map.bary.row(i) << 0.5F, 0.3F, 0.2F;
    }
    if (parameters.both) result.reverse = result.map;  // the two shapes are of one size
    result.candidates = {{{1, 0, 0, 0, 1, 0, 0, 0, 1}, 0.9, parameters.paper_selection ? 1.0 : 0.0, true}};
    result.reversed = parameters.orientation == Orientation::reverse;
    result.quality = {{"coverage", 1}};
    result.seconds = {{"rotation", 0.125}, {"total", 0.125}};
    return result;
  }

  /// Figures that say what it was asked: how many landmarks of each kind as `scored`, and what is only measured with more than surfaces.
  [[nodiscard]] Evaluation evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                    const Correspondence* reverse, const GroundTruth& truth, const Progress& progress) const override {
    progress.check();
    const auto counted = [](std::size_t count) {
      return MapError{.mean = 0.25, .curve = {0, 1}, .scored = static_cast<std::int32_t>(count)};
    };
    Evaluation result;
    last_truth = truth;
    if (!truth.direct.empty()) result.geodesic = counted(truth.direct.size());
    if (!truth.mirrored.empty()) result.mirrored = counted(truth.mirrored.size());
    if (!truth.mirrored.empty()) result.flipped = true;
    if (target.eigenvectors.size() > 0) result.biharmonic = counted(map.vertex.size());
    if (reverse != nullptr) result.bijectivity = counted(reverse->vertex.size());
    if (truth.dense && reverse != nullptr && source.eigenvectors.size() > 0) result.symmetric_integral = 0.5;
    result.continuity.dirichlet = 1.5;
    result.coverage.area = 0.75;
    result.seconds = {{"errors", 0.25}, {"total", 0.5}};
    return result;
  }

  /// As many entries as the map has.
  [[nodiscard]] VertexQuality vertex_quality(const ShapePointer& source, const ShapePointer& target,
                                             const Correspondence& map) const override {
    if (!source || !target) throw std::invalid_argument("without shapes");
    return {std::vector<float>(map.vertex.size(), 0.25F), std::vector<float>(map.vertex.size(), 0.75F)};
  }

 private:
  /// Four uploaded vertices on the surface and a fifth that was dropped.
  static Surface tetrahedron(const ReadOptions& options, bool hopeless) {
    Surface surface;
    surface.mesh.vertices.resize(4, 3);
    surface.mesh.vertices << (hopeless ? 9.0 : 1.0), 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    surface.mesh.faces.resize(4, 3);
    surface.mesh.faces << 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2;
    surface.uploaded_corners = surface.mesh.faces;
    surface.surface_vertex = {0, 1, 2, 3, -1};
    surface.uploaded_faces = 4;
    surface.report.dropped_vertices = options.repair == RepairMode::fill ? 1 : 0;
    if (options.simplify > 0) surface.decimated = {surface.mesh, {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}, {1, {0, 1, 0}}}, 0.5};
    return surface;
  }
};

}  // namespace spherematch::testing
