// Keeps results of matches beside the shapes, bounded by bytes, the least recently used dropped first.
//
// Thread-safe, and safe beside other processes on the same file, like storage/shape_store.h, whose errors it shares. What it keeps can
// be computed again, so that nothing depends on a result being there.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "engine/data/correspondence.h"
#include "storage/shape_store.h"

namespace spherematch {

class MatchStore {
 public:
  /// On the file of `shapes`. `max_bytes` bounds the encoded results together; 0 keeps none.
  MatchStore(const ShapeStore& shapes, std::size_t max_bytes);

  /// What save() got under this key; null when it is not there, or cannot be read (any more) and is forgotten for that.
  [[nodiscard]] std::shared_ptr<const MatchResult> find(std::string_view key);

  /// Results of another engine version for one of the two shapes are dropped. False, with nothing stored, when a shape is gone or the
  /// result alone passes the bound.
  bool save(std::string_view key, std::string_view source, std::string_view target, std::string_view engine, const MatchResult& result);

  /// Of all results that are kept.
  [[nodiscard]] std::size_t bytes() const;

 private:
  std::shared_ptr<ConnectionPool> pool_;
  std::size_t max_bytes_;
};

}  // namespace spherematch
