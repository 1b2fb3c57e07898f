#include "engine/mesh/weld.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "engine/mesh/glue.h"

namespace spherematch {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Per uploaded vertex on a boundary: the lowest uploaded boundary vertex in the same place; -1 elsewhere.
std::vector<std::int32_t> boundary_places(const Draft& draft) {
  std::vector<std::int32_t> place(at(draft.upload->vertex_count()), -1);
  std::vector<std::int32_t> vertices;
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    if (draft.mate_of(h) != no_half_edge) continue;
    vertices.push_back(draft.start(h));
    vertices.push_back(draft.end(h));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const Points& p = draft.upload->vertices;
  const auto coordinates = [&](std::int32_t v) { return std::make_tuple(p(v, 0), p(v, 1), p(v, 2)); };
  std::stable_sort(vertices.begin(), vertices.end(), [&](std::int32_t a, std::int32_t b) { return coordinates(a) < coordinates(b); });
  for (std::size_t i = 0, first = 0; i < vertices.size(); ++i) {
    if (coordinates(vertices[i]) != coordinates(vertices[first])) first = i;
    place[at(vertices[i])] = vertices[first];
  }
  return place;
}

/// Leaves out triangles with three boundary edges that lie where an earlier one does.
void drop_loose_duplicates(Draft& draft, const std::vector<std::int32_t>& place) {
  struct Key {
    std::array<std::int32_t, 3> places;
    std::int32_t face;
    bool operator<(const Key& other) const { return std::tie(places, face) < std::tie(other.places, other.face); }
  };
  std::vector<Key> loose;
  for (std::int32_t f = 0; f < draft.face_count(); ++f) {
    const HalfEdge h = 3 * f;
    if (draft.mate_of(h) != no_half_edge || draft.mate_of(h + 1) != no_half_edge || draft.mate_of(h + 2) != no_half_edge) continue;
    std::array<std::int32_t, 3> places{place[at(draft.start(h))], place[at(draft.start(h + 1))], place[at(draft.start(h + 2))]};
    std::sort(places.begin(), places.end());
    loose.push_back({places, f});
  }
  std::sort(loose.begin(), loose.end());
  std::vector<char> keep(at(draft.face_count()), 1);
  std::int32_t dropped = 0;
  for (std::size_t i = 1; i < loose.size(); ++i)
    if (loose[i].places == loose[i - 1].places) {
      keep[at(loose[i].face)] = 0;
      ++dropped;
    }
  if (dropped == 0) return;
  draft.report.removed_faces += dropped;
  draft.keep_faces(keep);
}

void glue_by_place(Draft& draft, const std::vector<std::int32_t>& place) {
  std::vector<EdgeEnd> ends;
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    if (draft.mate_of(h) != no_half_edge) continue;
    const std::int32_t from = place[at(draft.start(h))];
    const std::int32_t to = place[at(draft.end(h))];
    if (from != to) ends.push_back({std::min(from, to), std::max(from, to), h, from < to});
  }
  glue_groups(draft, ends, true);
}

struct Conflicts {
  std::vector<char> vertices;                    ///< 1 for a vertex of an edge in conflict; empty when there is none
  std::vector<std::array<HalfEdge, 2>> doubled;  ///< one half-edge of each, where exactly two glued edges are in conflict
  Offenders offenders;
};

/// Edges that the numbered draft has twice or that have one vertex at both ends.
Conflicts find_conflicts(const Draft& draft) {
  std::vector<EdgeEnd> edges;
  edges.reserve(draft.corner.size() / 2);
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    if (draft.mate_of(h) > h) continue;  // the other side stands for both
    const auto [low, high] = std::minmax({draft.vertex_of(h), draft.vertex_of(next_in_face(h))});
    edges.push_back({low, high, h, true});
  }
  std::sort(edges.begin(), edges.end());
  Conflicts conflicts;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (end - i > 1 || edges[i].low == edges[i].high) {
      conflicts.vertices.resize(draft.position.size(), 0);
      conflicts.vertices[at(edges[i].low)] = conflicts.vertices[at(edges[i].high)] = 1;
      conflicts.offenders.add_edge(draft.start(edges[i].half_edge), draft.end(edges[i].half_edge));
      const HalfEdge a = edges[i].half_edge;
      const HalfEdge b = edges[end - 1].half_edge;
      if (end - i == 2 && draft.mate_of(a) != no_half_edge && draft.mate_of(b) != no_half_edge) conflicts.doubled.push_back({a, b});
    }
    i = end;
  }
  return conflicts;
}

/// Glues the four half-edges of each doubled edge the other way round. False when there was none.
bool exchange_mates(Draft& draft, const Conflicts& conflicts) {
  for (const auto& [a, b] : conflicts.doubled) {
    if (draft.same_way[at(a)] != 0 || draft.same_way[at(b)] != 0) continue;
    const HalfEdge mate_a = draft.mate_of(a);
    const HalfEdge mate_b = draft.mate_of(b);
    const bool by_weld = draft.welded[at(a)] != 0 || draft.welded[at(b)] != 0;
    const bool parallel = draft.vertex_of(a) == draft.vertex_of(b);
    const HalfEdge new_mate_a = parallel ? mate_b : b;
    const HalfEdge other = parallel ? b : mate_b;
    if (a / 3 == new_mate_a / 3 || mate_a / 3 == other / 3) continue;
    draft.glue(a, new_mate_a, false, by_weld);
    draft.glue(mate_a, other, false, by_weld);
  }
  return !conflicts.doubled.empty();
}

/// Opens the welds at vertices in conflict; all welds when `everywhere`. False when there was none.
bool open_welds(Draft& draft, const std::vector<char>& conflict, bool everywhere) {
  bool opened = false;
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    if (draft.welded[at(h)] == 0) continue;
    if (!everywhere && conflict[at(draft.vertex_of(h))] == 0 && conflict[at(draft.vertex_of(next_in_face(h)))] == 0) continue;
    draft.unglue(h);
    opened = true;
  }
  return opened;
}

}  // namespace

void glue_seams(Draft& draft) {
  if (std::find(draft.mate.begin(), draft.mate.end(), no_half_edge) == draft.mate.end()) return;
  const std::vector<std::int32_t> place = boundary_places(draft);
  drop_loose_duplicates(draft, place);
  glue_by_place(draft, place);
}

void number_vertices_without_double_edges(Draft& draft) {
  constexpr int exchanging_rounds = 1;
  constexpr int local_rounds = 8;
  for (int round = 0;; ++round) {
    number_vertices(draft);
    const Conflicts conflicts = find_conflicts(draft);
    if (conflicts.vertices.empty()) return;
    if (round < exchanging_rounds && exchange_mates(draft, conflicts)) continue;
    if (!open_welds(draft, conflicts.vertices, round >= local_rounds)) return;
  }
}

void refuse_double_edges(const Draft& draft) {
  const Conflicts conflicts = find_conflicts(draft);
  if (conflicts.vertices.empty()) return;
  throw EngineError(ErrorCode::non_manifold, "faces meet at an edge in a way that splitting vertices cannot resolve",
                    conflicts.offenders.elements());
}

}  // namespace spherematch
