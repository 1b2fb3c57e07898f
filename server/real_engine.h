// The engine itself, with a fixed number of threads; preparations run in processes of their own.
#pragma once

#include "engine/engine.h"
#include "server/engine_port.h"
#include "server/lru_cache.h"

namespace spherematch {

class RealEngine final : public EnginePort {
 public:
  /// Keeps what matches read of the shapes used last, up to `cache_bytes` beside the shapes themselves.
  RealEngine(int threads, std::size_t cache_bytes) : threads_(threads), match_shapes_(cache_bytes) {}

  [[nodiscard]] std::string version() const override;
  [[nodiscard]] Surface read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                                     const ReadLimits& limits) const override;
  [[nodiscard]] PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name) const override;
  [[nodiscard]] PreprocessedShape preprocess(Surface surface, const Progress& progress) const override;
  [[nodiscard]] MatchResult match(const ShapePointer& source, const ShapePointer& target, const MatchParameters& parameters,
                                  const Progress& progress) const override;
  [[nodiscard]] Evaluation evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                    const Correspondence* reverse, const GroundTruth& truth, const Progress& progress) const override;
  [[nodiscard]] VertexQuality vertex_quality(const ShapePointer& source, const ShapePointer& target,
                                             const Correspondence& map) const override;

 private:
  [[nodiscard]] std::shared_ptr<const MatchShape> match_shape(const ShapePointer& shape) const;

  int threads_;
  mutable LruCache<MatchShape> match_shapes_;  ///< by the address of the shape, which its MatchShape keeps
};

}  // namespace spherematch
