#include "engine/mesh/half_edges.h"

#include <algorithm>

namespace spherematch {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// `items` in rising order of key(item), equal ones as they were: one pass of a radix sort.
template <typename Key>
std::vector<std::int32_t> sorted_by(const std::vector<std::int32_t>& items, Eigen::Index key_count, const Key& key) {
  std::vector<std::int32_t> offset(at(key_count) + 1, 0), result(items.size());
  for (const std::int32_t item : items) ++offset[at(key(item)) + 1];
  for (std::size_t k = 1; k < offset.size(); ++k) offset[k] += offset[k - 1];
  for (const std::int32_t item : items) result[at(offset[at(key(item))]++)] = item;
  return result;
}

}  // namespace

HalfEdges::HalfEdges(const Triangles& faces, Eigen::Index vertex_count)
    : origin_(faces.data(), faces.data() + faces.size()), twin_(origin_.size()), spoke_(at(vertex_count)), valence_(at(vertex_count)) {
  std::vector<std::int32_t> order(origin_.size());
  for (std::size_t h = 0; h < order.size(); ++h) {
    order[h] = static_cast<std::int32_t>(h);
    spoke_[at(origin_[h])] = order[h];
    ++valence_[at(origin_[h])];
  }
  // Sorted by both ends, the two halves of an edge stand side by side.
  order = sorted_by(order, vertex_count, [this](std::int32_t h) { return std::max(origin_[at(h)], head(h)); });
  order = sorted_by(order, vertex_count, [this](std::int32_t h) { return std::min(origin_[at(h)], head(h)); });
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    twin_[at(order[i])] = order[i + 1];
    twin_[at(order[i + 1])] = order[i];
  }
}

void HalfEdges::collapse(std::int32_t spoke) {
  const std::int32_t from = origin_[at(spoke)], to = head(spoke), back = twin_[at(spoke)];
  valence_[at(to)] += valence_[at(from)] - 4;
  std::int32_t h = spoke;
  do {
    origin_[at(h)] = to;
    h = twin_[at(previous(h))];
  } while (h != spoke);
  drop_face_at(spoke);
  drop_face_at(back);
}

/// Takes out the face of `half_edge`, both ends of which are the same vertex by now, and glues its two other sides together.
void HalfEdges::drop_face_at(std::int32_t half_edge) {
  const std::int32_t ahead = next(half_edge), behind = previous(half_edge);
  const std::int32_t vertex = origin_[at(half_edge)], side = origin_[at(behind)];
  const std::int32_t outer = twin_[at(ahead)], inner = twin_[at(behind)];  // outer: side to vertex; inner: vertex to side
  twin_[at(outer)] = inner;
  twin_[at(inner)] = outer;
  spoke_[at(side)] = outer;
  spoke_[at(vertex)] = inner;
  --valence_[at(side)];
  for (const std::int32_t h : {half_edge, ahead, behind}) origin_[at(h)] = -1;
}

}  // namespace spherematch
