#include "server/shape_cache.h"

namespace spherematch {

namespace {

template <typename Matrix>
std::size_t bytes_of(const Matrix& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
}

}  // namespace

std::size_t memory_of(const PreprocessedShape& shape) {
  const Surface& surface = shape.surface;
  std::size_t bytes = sizeof(PreprocessedShape) + bytes_of(surface.mesh.vertices) + bytes_of(surface.mesh.faces) +
                      bytes_of(surface.uploaded_corners) + surface.surface_vertex.size() * sizeof(surface.surface_vertex[0]) +
                      bytes_of(shape.sphere) + bytes_of(shape.eigenvalues) + bytes_of(shape.eigenvectors);
  for (const SignalGrid& signal : shape.signals) bytes += bytes_of(signal.values);
  return bytes;
}

ShapePointer ShapeCache::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->shape;
}

void ShapeCache::put(const std::string& id, ShapePointer shape) {
  const std::size_t bytes = memory_of(*shape);
  const std::lock_guard lock(mutex_);
  erase_locked(id);
  if (bytes > max_bytes_) return;
  entries_.push_front({id, std::move(shape), bytes});
  by_id_[id] = entries_.begin();
  bytes_ += bytes;
  while (bytes_ > max_bytes_) erase_locked(std::string(entries_.back().id));
}

void ShapeCache::erase(const std::string& id) {
  const std::lock_guard lock(mutex_);
  erase_locked(id);
}

std::size_t ShapeCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

void ShapeCache::erase_locked(const std::string& id) {
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return;
  bytes_ -= found->second->bytes;
  entries_.erase(found->second);
  by_id_.erase(found);
}

}  // namespace spherematch
