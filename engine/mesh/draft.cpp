#include "engine/mesh/draft.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace spherematch {

namespace {

constexpr std::size_t most_listed = 20;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Disjoint sets of corners; the root of a set is its lowest corner.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t find(std::int32_t corner) {
    while (parent_[at(corner)] != corner) {
      parent_[at(corner)] = parent_[at(parent_[at(corner)])];
      corner = parent_[at(corner)];
    }
    return corner;
  }

  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// Pairs (uploaded vertex, class) without repetition, sorted.
void count_welded_and_split(Draft& draft, std::int32_t classes) {
  std::vector<std::pair<std::int32_t, std::int32_t>> uses;
  uses.reserve(draft.corner.size());
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) uses.emplace_back(draft.start(h), draft.vertex_of(h));
  std::sort(uses.begin(), uses.end());
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  const auto used = static_cast<std::int32_t>(std::count_if(
      uses.begin(), uses.end(), [last = -1](const auto& use) mutable { return std::exchange(last, use.first) != use.first; }));
  draft.report.welded_vertices = static_cast<std::int32_t>(uses.size()) - classes;
  draft.report.split_vertices = static_cast<std::int32_t>(uses.size()) - used;
}

}  // namespace

HalfEdge Draft::add_face(const std::array<std::int32_t, 3>& corners, std::int32_t from_polygon) {
  const HalfEdge first = half_edge_count();
  corner.insert(corner.end(), corners.begin(), corners.end());
  mate.insert(mate.end(), 3, no_half_edge);
  same_way.insert(same_way.end(), 3, 0);
  welded.insert(welded.end(), 3, 0);
  vertex.insert(vertex.end(), 3, -1);
  polygon.push_back(from_polygon);
  turned.push_back(0);
  return first;
}

void Draft::glue(HalfEdge a, HalfEdge b, bool runs_same_way, bool by_weld) {
  mate[at(a)] = b;
  mate[at(b)] = a;
  same_way[at(a)] = same_way[at(b)] = runs_same_way ? 1 : 0;
  welded[at(a)] = welded[at(b)] = by_weld ? 1 : 0;
}

void Draft::unglue(HalfEdge h) {
  for (const HalfEdge side : {mate_of(h), h}) {
    mate[at(side)] = no_half_edge;
    same_way[at(side)] = 0;
    welded[at(side)] = 0;
  }
}

void Draft::turn_face(std::int32_t face) {
  const HalfEdge h = 3 * face;
  // Half-edges (0,1), (1,2), (2,0) become (0,2), (2,1), (1,0): the first and the last change places.
  std::swap(corner[at(h + 1)], corner[at(h + 2)]);
  std::swap(vertex[at(h + 1)], vertex[at(h + 2)]);
  std::swap(mate[at(h)], mate[at(h + 2)]);
  std::swap(same_way[at(h)], same_way[at(h + 2)]);
  std::swap(welded[at(h)], welded[at(h + 2)]);
  for (HalfEdge side = h; side < h + 3; ++side) {
    const HalfEdge other = mate_of(side);
    if (other == no_half_edge) continue;
    mate[at(other)] = side;
    same_way[at(side)] ^= 1;
    same_way[at(other)] = same_way[at(side)];
  }
  turned[at(face)] ^= 1;
}

void Draft::keep_faces(const std::vector<char>& keep) {
  std::vector<std::int32_t> number(at(face_count()), -1);
  std::int32_t kept = 0;
  for (std::int32_t f = 0; f < face_count(); ++f)
    if (keep[at(f)] != 0) number[at(f)] = kept++;
  for (std::int32_t f = 0; f < face_count(); ++f) {
    if (number[at(f)] < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const std::size_t from = at(3 * f + k);
      const std::size_t to = at(3 * number[at(f)] + k);
      const HalfEdge other = mate[from];
      const std::int32_t face = other == no_half_edge ? -1 : number[at(other / 3)];
      corner[to] = corner[from];
      vertex[to] = vertex[from];
      mate[to] = face < 0 ? no_half_edge : 3 * face + other % 3;
      same_way[to] = face < 0 ? char{0} : same_way[from];
      welded[to] = face < 0 ? char{0} : welded[from];
    }
    polygon[at(number[at(f)])] = polygon[at(f)];
    turned[at(number[at(f)])] = turned[at(f)];
  }
  for (auto* corners : {&corner, &mate, &vertex}) corners->resize(at(3 * kept));
  for (auto* flags : {&same_way, &welded}) flags->resize(at(3 * kept));
  polygon.resize(at(kept));
  turned.resize(at(kept));
}

void Offenders::add_vertex(std::int32_t vertex) {
  if (elements_.vertices.size() < most_listed) elements_.vertices.push_back(vertex);
}

void Offenders::add_face(std::int32_t face) {
  // Several triangles can come from one polygon.
  if (elements_.faces.size() < most_listed && (elements_.faces.empty() || elements_.faces.back() != face)) elements_.faces.push_back(face);
}

void Offenders::add_edge(std::int32_t a, std::int32_t b) {
  if (elements_.edges.size() < most_listed) elements_.edges.push_back({std::min(a, b), std::max(a, b)});
}

void number_vertices(Draft& draft) {
  CornerSets sets(draft.corner.size());
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    const HalfEdge other = draft.mate_of(h);
    if (other < h) continue;  // a boundary, or seen from the other side
    const bool same = draft.same_way[at(h)] != 0;
    sets.join(h, same ? other : next_in_face(other));
    sets.join(next_in_face(h), same ? next_in_face(other) : other);
  }
  // The root is the lowest corner; the class's lowest uploaded vertex comes first in the order.
  std::vector<std::int32_t> lowest(draft.corner.size(), std::numeric_limits<std::int32_t>::max());
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    std::int32_t& low = lowest[at(sets.find(h))];
    low = std::min(low, draft.start(h));
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> order;
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h)
    if (sets.find(h) == h) order.emplace_back(lowest[at(h)], h);
  std::sort(order.begin(), order.end());

  std::vector<std::int32_t> number(draft.corner.size(), -1);
  draft.position.clear();
  for (const auto& [uploaded, root] : order) {
    number[at(root)] = static_cast<std::int32_t>(draft.position.size());
    draft.position.emplace_back(draft.upload->vertices.row(uploaded).transpose());
  }
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) draft.vertex[at(h)] = number[at(sets.find(h))];
  count_welded_and_split(draft, static_cast<std::int32_t>(order.size()));
}

}  // namespace spherematch
