// What the server needs of the engine; tests put a stub in its place.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/data/correspondence.h"
#include "engine/data/parameters.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

/// Implementations are thread-safe. The functions and their errors are those of engine/engine.h.
class EnginePort {
 public:
  virtual ~EnginePort() = default;
  [[nodiscard]] virtual std::string version() const = 0;
  [[nodiscard]] virtual Surface read_surface(std::span<const std::byte> bytes, std::string_view name, RepairMode repair,
                                             const ReadLimits& limits) const = 0;
  [[nodiscard]] virtual PreprocessedShape preprocess(Surface surface, const Progress& progress) const = 0;
  [[nodiscard]] virtual MatchResult match(const PreprocessedShape& source, const PreprocessedShape& target,
                                          const MatchParameters& parameters, const Progress& progress) const = 0;
};

}  // namespace spherematch
