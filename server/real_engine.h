// The engine itself, with a fixed number of threads; preparations run in processes of their own.
#pragma once

#include "server/engine_port.h"

namespace spherematch {

class RealEngine final : public EnginePort {
 public:
  explicit RealEngine(int threads) : threads_(threads) {}

  [[nodiscard]] std::string version() const override;
  [[nodiscard]] Surface read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                                     const ReadLimits& limits) const override;
  [[nodiscard]] PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name) const override;
  [[nodiscard]] PreprocessedShape preprocess(Surface surface, const Progress& progress) const override;
  [[nodiscard]] MatchResult match(const PreprocessedShape& source, const PreprocessedShape& target, const MatchParameters& parameters,
                                  const Progress& progress) const override;

 private:
  int threads_;
};

}  // namespace spherematch
