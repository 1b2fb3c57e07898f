#include "engine/mesh/zero_area.h"

#include <array>
#include <deque>
#include <numeric>

#include "engine/mesh/draft.h"

namespace spherematch {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }
constexpr HalfEdge previous_in_face(HalfEdge h) { return next_in_face(next_in_face(h)); }

class ZeroAreaRemover {
 public:
  explicit ZeroAreaRemover(Draft& draft)
      : draft_(draft), alive_(at(draft.face_count()), 1), alive_count_(draft.face_count()), become_(draft.position.size()) {
    std::iota(become_.begin(), become_.end(), 0);
  }

  std::vector<std::int32_t> run() {
    for (std::int32_t f = 0; f < draft_.face_count(); ++f) enqueue(f);
    const bool any = !queue_.empty();
    while (!queue_.empty() && steps_ < most_steps) {
      const std::int32_t face = queue_.front();
      queue_.pop_front();
      if (alive_[at(face)] != 0 && has_zero_area(face) && !collapse_a_side(face)) flip_longest_side(face);
    }
    if (any) draft_.keep_faces(alive_);
    // A vertex that went into another always went into a lower one.
    for (std::int32_t& vertex : become_) vertex = become_[at(vertex)];
    return become_;
  }

 private:
  /// Bounds the walks round vertices of many faces.
  static constexpr std::int64_t most_steps = 20'000'000;

  void enqueue(std::int32_t face) {
    if (alive_[at(face)] != 0 && has_zero_area(face)) queue_.push_back(face);
  }

  [[nodiscard]] bool has_zero_area(std::int32_t face) const {
    return is_zero_area(draft_.position_of(3 * face), draft_.position_of(3 * face + 1), draft_.position_of(3 * face + 2));
  }

  /// Calls visit(half-edge) for each that starts at the start of h.
  template <typename Visit>
  void round_vertex(HalfEdge h, const Visit& visit) {
    HalfEdge around = h;
    do {
      visit(around);
      around = next_in_face(draft_.mate_of(around));
      ++steps_;
    } while (around != h);
  }

  std::vector<std::int32_t> neighbours(HalfEdge h) {
    std::vector<std::int32_t> ring;
    round_vertex(h, [&](HalfEdge out) { ring.push_back(draft_.vertex_of(next_in_face(out))); });
    std::sort(ring.begin(), ring.end());
    return ring;
  }

  bool collapse_a_side(std::int32_t face) {
    for (HalfEdge h = 3 * face; h < 3 * face + 3; ++h)
      if (draft_.position_of(h) == draft_.position_of(next_in_face(h)) && collapse(h)) return true;
    return false;
  }

  /// Only when the surface stays a simplicial sphere: the ends have no common neighbours but the two across the edge.
  bool collapse(HalfEdge h) {
    if (alive_count_ <= 4) return false;
    const HalfEdge opposite = draft_.mate_of(h);
    if (draft_.vertex_of(h) < draft_.vertex_of(opposite)) return collapse(opposite);
    const std::vector<std::int32_t> gone_ring = neighbours(h);
    const std::vector<std::int32_t> kept_ring = neighbours(opposite);
    std::vector<std::int32_t> common;
    std::set_intersection(gone_ring.begin(), gone_ring.end(), kept_ring.begin(), kept_ring.end(), std::back_inserter(common));
    if (common.size() != 2) return false;

    const std::int32_t gone = draft_.vertex_of(h);
    const std::int32_t kept = draft_.vertex_of(opposite);
    round_vertex(h, [&](HalfEdge out) { draft_.vertex[at(out)] = kept; });
    become_[at(gone)] = kept;
    for (const HalfEdge side : {h, opposite}) {
      const HalfEdge a = draft_.mate_of(next_in_face(side));
      const HalfEdge b = draft_.mate_of(previous_in_face(side));
      draft_.glue(a, b, false, false);
      alive_[at(side / 3)] = 0;
      enqueue(a / 3);
      enqueue(b / 3);
    }
    alive_count_ -= 2;
    draft_.report.removed_faces += 2;
    ++draft_.report.welded_vertices;
    return true;
  }

  [[nodiscard]] HalfEdge longest_side(std::int32_t face) const {
    const auto length = [&](HalfEdge h) { return (draft_.position_of(next_in_face(h)) - draft_.position_of(h)).squaredNorm(); };
    HalfEdge longest = 3 * face;
    for (HalfEdge h = longest + 1; h < 3 * face + 3; ++h)
      if (length(h) > length(longest)) longest = h;
    return longest;
  }

  /// From (u, v, c) and (v, u, d) to (u, d, c) and (d, v, c).
  void flip_longest_side(std::int32_t face) {
    const HalfEdge uv = longest_side(face);
    const HalfEdge vu = draft_.mate_of(uv);
    const HalfEdge vc = next_in_face(uv);
    const HalfEdge cu = previous_in_face(uv);
    const HalfEdge ud = next_in_face(vu);
    const HalfEdge dv = previous_in_face(vu);
    if (is_zero_area(draft_.position_of(uv), draft_.position_of(dv), draft_.position_of(cu)) ||
        is_zero_area(draft_.position_of(dv), draft_.position_of(vu), draft_.position_of(cu)))
      return;
    const std::int32_t u = draft_.vertex_of(uv);
    const std::int32_t v = draft_.vertex_of(vu);
    const std::int32_t c = draft_.vertex_of(cu);
    const std::int32_t d = draft_.vertex_of(dv);
    const std::vector<std::int32_t> ring = neighbours(cu);
    if (c == d || std::binary_search(ring.begin(), ring.end(), d)) return;

    const HalfEdge f = 3 * (uv / 3);
    const HalfEdge g = 3 * (vu / 3);
    const std::array<HalfEdge, 4> outside{draft_.mate_of(ud), draft_.mate_of(cu), draft_.mate_of(dv), draft_.mate_of(vc)};
    set_face(f, {u, d, c});
    set_face(g, {d, v, c});
    draft_.glue(f, outside[0], false, false);
    draft_.glue(f + 1, g + 2, false, false);
    draft_.glue(f + 2, outside[1], false, false);
    draft_.glue(g, outside[2], false, false);
    draft_.glue(g + 1, outside[3], false, false);
    ++draft_.report.removed_faces;
    for (const HalfEdge h : outside) enqueue(h / 3);
  }

  void set_face(HalfEdge first, const std::array<std::int32_t, 3>& vertices) {
    for (std::int32_t k = 0; k < 3; ++k) {
      draft_.vertex[at(first + k)] = vertices[at(k)];
      draft_.corner[at(first + k)] = -1;
    }
    draft_.polygon[at(first / 3)] = -1;
  }

  Draft& draft_;
  std::vector<char> alive_;
  std::int32_t alive_count_;
  std::vector<std::int32_t> become_;
  std::deque<std::int32_t> queue_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::vector<std::int32_t> remove_zero_area_faces(Draft& draft) { return ZeroAreaRemover(draft).run(); }

}  // namespace spherematch
