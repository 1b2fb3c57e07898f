#include "engine/mesh/orient.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <utility>

namespace spherematch {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Disjoint sets of faces that know whether each face must be turned relative to the lowest of its set.
class OrientationSets {
 public:
  explicit OrientationSets(std::size_t count) : parent_(count), turned_(count, 0) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The root of a face, and whether it is turned relative to the root.
  std::pair<std::int32_t, char> find(std::int32_t face) {
    std::int32_t root = face;
    char turned = 0;
    for (; parent_[at(root)] != root; root = parent_[at(root)]) turned ^= turned_[at(root)];
    const std::pair<std::int32_t, char> found{root, turned};
    while (parent_[at(face)] != root && face != root) {
      const char next_turned = static_cast<char>(turned ^ turned_[at(face)]);
      turned_[at(face)] = turned;
      turned = next_turned;
      face = std::exchange(parent_[at(face)], root);
    }
    return found;
  }

  /// False when it contradicts what was joined before.
  bool join(std::int32_t a, std::int32_t b, bool turn) {
    const auto [root_a, turned_a] = find(a);
    const auto [root_b, turned_b] = find(b);
    const char between = static_cast<char>(turned_a ^ turned_b ^ (turn ? 1 : 0));
    if (root_a == root_b) return between == 0;
    const auto [low, high] = std::minmax({root_a, root_b});
    parent_[at(high)] = low;
    turned_[at(high)] = between;
    return true;
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<char> turned_;
};

}  // namespace

void agree_orientations(Draft& draft) {
  OrientationSets sets(at(draft.face_count()));
  for (const char by_weld : {char{0}, char{1}})
    for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
      const HalfEdge other = draft.mate_of(h);
      if (other < h || draft.welded[at(h)] != by_weld) continue;
      if (!sets.join(h / 3, other / 3, draft.same_way[at(h)] != 0) && by_weld != 0) draft.unglue(h);
    }
  for (std::int32_t f = 0; f < draft.face_count(); ++f)
    if (sets.find(f).second != 0) draft.turn_face(f);
}

void refuse_contradictions(const Draft& draft) {
  Offenders offenders;
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h)
    if (draft.same_way[at(h)] != 0 && draft.mate_of(h) > h) offenders.add_edge(draft.start(h), draft.end(h));
  if (!offenders.elements().edges.empty())
    throw EngineError(ErrorCode::inconsistent_orientation, "the surface is not orientable", offenders.elements());
}

void turn_outward(Draft& draft, RepairMode mode) {
  const Eigen::Vector3d origin = draft.position_of(0);
  double volume = 0;
  double area = 0;
  for (HalfEdge h = 0; h < draft.half_edge_count(); h += 3) {
    const Eigen::Vector3d a = draft.position_of(h) - origin;
    const Eigen::Vector3d b = draft.position_of(h + 1) - origin;
    const Eigen::Vector3d c = draft.position_of(h + 2) - origin;
    volume += a.dot(b.cross(c)) / 6;
    area += (b - a).cross(c - a).norm() / 2;
  }
  constexpr double smallest_volume = 1e-12;  // of that of a cube with faces of the area; rounding leaves less
  if (!(std::abs(volume) > smallest_volume * area * std::sqrt(area)))
    throw EngineError(ErrorCode::degenerate, "the surface encloses no volume");
  if (volume > 0) return;
  if (mode == RepairMode::none) throw EngineError(ErrorCode::inconsistent_orientation, "the faces of the mesh point inward");
  for (std::int32_t f = 0; f < draft.face_count(); ++f) draft.turn_face(f);
}

}  // namespace spherematch
