// Shapes of a list of pairs, ready for matching.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "engine/register/match_shape.h"
#include "storage/shape_store.h"

namespace spherematch::bench {

/// Prepares each file once into a store, and keeps it in memory. For one thread.
class PreparedShapes {
 public:
  /// The store is not owned.
  PreparedShapes(ShapeStore& store, int threads) : store_(store), threads_(threads) {}

  /// Lives as long as this object. @throws EngineError, std::runtime_error naming the file
  [[nodiscard]] const MatchShape& operator()(const std::filesystem::path& file);

 private:
  ShapeStore& store_;
  int threads_;
  std::map<std::filesystem::path, std::unique_ptr<const MatchShape>> shapes_;
};

}  // namespace spherematch::bench
