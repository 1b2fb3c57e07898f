// What the server needs of the engine; tests put a stub in its place.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/parameters.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// A preparation ended without a result and without a reason that lies in the shape for certain: its process crashed, was killed or
/// ran out of memory. what() says how.
class PreparationLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using ShapePointer = std::shared_ptr<const PreprocessedShape>;

/// Implementations are thread-safe. The functions and their errors are those of engine/engine.h.
class EnginePort {
 public:
  virtual ~EnginePort() = default;
  [[nodiscard]] virtual std::string version() const = 0;
  [[nodiscard]] virtual Surface read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                                             const ReadLimits& limits) const = 0;
  /// An upload that read_surface() accepted, as its file has it (engine/io/mesh_reader.h).
  [[nodiscard]] virtual PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name) const = 0;
  /// @throws PreparationLost as well
  [[nodiscard]] virtual PreprocessedShape preprocess(Surface surface, const Progress& progress) const = 0;
  /// Shapes that are the same object as in an earlier call may be matched faster.
  [[nodiscard]] virtual MatchResult match(const ShapePointer& source, const ShapePointer& target, const MatchParameters& parameters,
                                          const Progress& progress) const = 0;
  /// `reverse` may be null.
  [[nodiscard]] virtual Evaluation evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                            const Correspondence* reverse, const GroundTruth& truth, const Progress& progress) const = 0;
  [[nodiscard]] virtual VertexQuality vertex_quality(const ShapePointer& source, const ShapePointer& target,
                                                     const Correspondence& map) const = 0;
};

}  // namespace spherematch
