#include "engine/mesh/glue.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <tuple>

namespace spherematch {

namespace {

/// Edges with more faces than this are cut open rather than sorted out, which bounds the quadratic work below.
constexpr std::size_t most_faces_at_edge = 64;

struct Wing {
  HalfEdge half_edge;
  bool rising;
  double angle;  ///< of the face round the edge, counter-clockwise seen along it from high to low, in (-pi, pi]
};

/// The faces at an edge in the order of their angles; empty when the edge has no length or too many faces.
std::vector<Wing> sorted_wings(const Draft& draft, std::span<const EdgeEnd> group) {
  if (group.size() > most_faces_at_edge) return {};
  const EdgeEnd& first = group.front();
  Eigen::Vector3d low = draft.uploaded_position(first.half_edge);
  Eigen::Vector3d high = draft.uploaded_position(next_in_face(first.half_edge));
  if (!first.rising) std::swap(low, high);
  const Eigen::Vector3d axis = high - low;
  if (axis.squaredNorm() == 0) return {};
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.normalized().cross(u);
  std::vector<Wing> wings;
  for (const EdgeEnd& end : group) {
    const HalfEdge apex = next_in_face(next_in_face(end.half_edge));
    const Eigen::Vector3d arm = draft.uploaded_position(apex) - low;
    wings.push_back({end.half_edge, end.rising, std::atan2(arm.dot(v), arm.dot(u))});
  }
  std::sort(wings.begin(), wings.end(),
            [](const Wing& a, const Wing& b) { return std::tie(a.angle, a.half_edge) < std::tie(b.angle, b.half_edge); });
  return wings;
}

bool alternate(const std::vector<Wing>& wings) {
  if (wings.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < wings.size(); ++i)
    if (wings[i].rising == wings[(i + 1) % wings.size()].rising) return false;
  return true;
}

/// The outside of a face whose half-edge rises lies at larger angles, so the solid is between it and the face before it.
void glue_solids(Draft& draft, const std::vector<Wing>& wings, bool inside_out, bool by_weld) {
  for (std::size_t i = 0; i < wings.size(); ++i) {
    if (wings[i].rising == inside_out) continue;
    const Wing& before = wings[(i + wings.size() - 1) % wings.size()];
    draft.glue(wings[i].half_edge, before.half_edge, false, by_weld);
  }
}

void glue_flattest(Draft& draft, const std::vector<Wing>& wings, bool by_weld) {
  struct Pair {
    bool same_way;
    double bend;  ///< 0 for faces in one plane, on either side of the edge
    std::size_t a;
    std::size_t b;
    auto key() const { return std::tie(same_way, bend, a, b); }
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < wings.size(); ++a)
    for (std::size_t b = a + 1; b < wings.size(); ++b) {
      const double bend = std::abs(std::abs(wings[b].angle - wings[a].angle) - std::numbers::pi);
      pairs.push_back({wings[a].rising == wings[b].rising, bend, a, b});
    }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.key() < y.key(); });
  std::vector<bool> used(wings.size(), false);
  for (const Pair& pair : pairs) {
    if (used[pair.a] || used[pair.b] || wings[pair.a].half_edge / 3 == wings[pair.b].half_edge / 3) continue;
    used[pair.a] = used[pair.b] = true;
    draft.glue(wings[pair.a].half_edge, wings[pair.b].half_edge, pair.same_way, by_weld);
  }
}

bool is_inside_out(const Draft& draft) {
  if (draft.half_edge_count() == 0) return false;
  const Eigen::Vector3d origin = draft.uploaded_position(0);
  double volume = 0;
  for (HalfEdge h = 0; h < draft.half_edge_count(); h += 3)
    volume +=
        (draft.uploaded_position(h) - origin).dot((draft.uploaded_position(h + 1) - origin).cross(draft.uploaded_position(h + 2) - origin));
  return volume < 0;
}

template <typename Visit>
void for_each_group(std::span<const EdgeEnd> ends, const Visit& visit) {
  for (std::size_t i = 0; i < ends.size();) {
    std::size_t last = i + 1;
    while (last < ends.size() && ends[last].low == ends[i].low && ends[last].high == ends[i].high) ++last;
    visit(ends.subspan(i, last - i));
    i = last;
  }
}

template <typename Offends>
void refuse_edges(std::span<const EdgeEnd> ends, ErrorCode code, const std::string& what, const Offends& offends) {
  Offenders offenders;
  std::int64_t count = 0;
  for_each_group(ends, [&](std::span<const EdgeEnd> group) {
    if (!offends(group)) return;
    ++count;
    offenders.add_edge(group.front().low, group.front().high);
  });
  if (count > 0) throw EngineError(code, "the mesh has " + std::to_string(count) + " " + what, offenders.elements());
}

void refuse_defects(std::span<const EdgeEnd> ends) {
  using Group = std::span<const EdgeEnd>;
  refuse_edges(ends, ErrorCode::non_manifold, "edges of more than two faces", [](Group group) { return group.size() > 2; });
  refuse_edges(ends, ErrorCode::inconsistent_orientation, "edges whose two faces are oriented differently",
               [](Group group) { return group.size() == 2 && group[0].rising == group[1].rising; });
  refuse_edges(ends, ErrorCode::not_closed, "boundary edges", [](Group group) { return group.size() == 1; });
}

}  // namespace

void glue_groups(Draft& draft, std::vector<EdgeEnd>& ends, bool by_weld) {
  std::sort(ends.begin(), ends.end());
  const bool inside_out = is_inside_out(draft);
  for_each_group(ends, [&](std::span<const EdgeEnd> group) {
    if (group.size() == 2) {
      if (group[0].half_edge / 3 != group[1].half_edge / 3)
        draft.glue(group[0].half_edge, group[1].half_edge, group[0].rising == group[1].rising, by_weld);
    } else if (group.size() > 2) {
      const std::vector<Wing> wings = sorted_wings(draft, group);
      if (alternate(wings))
        glue_solids(draft, wings, inside_out, by_weld);
      else
        glue_flattest(draft, wings, by_weld);
    }
  });
}

void glue_by_index(Draft& draft, RepairMode mode) {
  std::vector<EdgeEnd> ends;
  ends.reserve(draft.corner.size());
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    const auto [low, high] = std::minmax({draft.start(h), draft.end(h)});
    ends.push_back({low, high, h, draft.start(h) == low});
  }
  glue_groups(draft, ends, false);
  if (mode == RepairMode::none) refuse_defects(ends);
}

}  // namespace spherematch
