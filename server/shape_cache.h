// Decoded shapes in memory, the least recently used dropped first, bounded by bytes.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "engine/data/preprocessed_shape.h"

namespace spherematch {

using ShapePointer = std::shared_ptr<const PreprocessedShape>;

/// What the arrays of a shape take in memory.
[[nodiscard]] std::size_t memory_of(const PreprocessedShape& shape);

/// Thread-safe. A shape that a caller holds lives on after it was dropped here.
class ShapeCache {
 public:
  explicit ShapeCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Null when absent.
  [[nodiscard]] ShapePointer find(const std::string& id);
  /// Replaces what the id stood for. A shape larger than the whole cache is not kept.
  void put(const std::string& id, ShapePointer shape);
  void erase(const std::string& id);

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Entry {
    std::string id;
    ShapePointer shape;
    std::size_t bytes;
  };
  void erase_locked(const std::string& id);

  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;  ///< most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> by_id_;
  std::size_t bytes_ = 0;
};

}  // namespace spherematch
