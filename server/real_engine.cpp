#include "server/real_engine.h"

#include <cstdint>
#include <future>

#include "engine/data/parallel.h"
#include "engine/io/mesh_reader.h"
#include "server/preparation_process.h"
#include "server/priority.h"

namespace spherematch {

std::string RealEngine::version() const { return std::string(engine_version()); }

Surface RealEngine::read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                                 const ReadLimits& limits) const {
  return spherematch::read_surface(bytes, name, options, limits);
}

PolygonMesh RealEngine::read_mesh(std::span<const std::byte> bytes, std::string_view name) const {
  return spherematch::read_mesh(bytes, name, ReadLimits::none());
}

PreprocessedShape RealEngine::preprocess(Surface surface, const Progress& progress) const {
  // The running program itself, also where its file has been replaced meanwhile.
  return preprocess_apart("/proc/self/exe", threads_, std::move(surface), progress);
}

std::shared_ptr<const MatchShape> RealEngine::match_shape(const ShapePointer& shape) const {
  const std::string key = std::to_string(reinterpret_cast<std::uintptr_t>(shape.get()));
  if (auto known = match_shapes_.find(key)) return known;
  auto made = std::make_shared<const MatchShape>(shape);
  // One that came with its eigenbasis is larger than what it adds, and nobody else keeps it.
  if (shape->eigenvectors.size() == 0) match_shapes_.put(key, made, made->index_bytes());
  return made;
}

MatchResult RealEngine::match(const ShapePointer& source, const ShapePointer& target, const MatchParameters& parameters,
                              const Progress& progress) const {
  // On a thread of its own, which can be nicer than the one that will write the response.
  return std::async(std::launch::async,
                    [&] {
                      be_nice(match_niceness);
                      std::shared_ptr<const MatchShape> sides[2];
                      run_parallel(2, threads_, [&](std::size_t side) { sides[side] = match_shape(side == 0 ? source : target); });
                      return spherematch::match(*sides[0], *sides[1], parameters, progress, threads_);
                    })
      .get();
}

Evaluation RealEngine::evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                const Correspondence* reverse, const GroundTruth& truth, const Progress& progress) const {
  return std::async(std::launch::async,
                    [&] {
                      be_nice(match_niceness);
                      return spherematch::evaluate(source, target, map, reverse, truth, progress, threads_);
                    })
      .get();
}

VertexQuality RealEngine::vertex_quality(const ShapePointer& source, const ShapePointer& target, const Correspondence& map) const {
  return spherematch::vertex_quality(*match_shape(source), *match_shape(target), map);
}

}  // namespace spherematch
