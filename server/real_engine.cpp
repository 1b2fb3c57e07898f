#include "server/real_engine.h"

#include "engine/engine.h"

namespace spherematch {

std::string RealEngine::version() const { return std::string(engine_version()); }

Surface RealEngine::read_surface(std::span<const std::byte> bytes, std::string_view name, RepairMode repair,
                                 const ReadLimits& limits) const {
  return spherematch::read_surface(bytes, name, repair, limits);
}

PreprocessedShape RealEngine::preprocess(Surface surface, const Progress& progress) const {
  return spherematch::preprocess(std::move(surface), {}, progress, threads_);
}

MatchResult RealEngine::match(const PreprocessedShape& source, const PreprocessedShape& target, const MatchParameters& parameters,
                              const Progress& progress) const {
  return spherematch::match(source, target, parameters, progress, threads_);
}

}  // namespace spherematch
