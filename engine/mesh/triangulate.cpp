#include "engine/mesh/triangulate.h"

#include <algorithm>
#include <span>
#include <string>
#include <tuple>
#include <unordered_set>

#include "engine/mesh/polygon_triangulation.h"

namespace spherematch {

namespace {

constexpr std::int64_t most_work = 50'000'000;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// Unordered pairs of uploaded vertices; only looked up, never walked through.
class EdgeSet {
 public:
  void insert(std::int32_t a, std::int32_t b) { edges_.insert(key(a, b)); }
  [[nodiscard]] bool contains(std::int32_t a, std::int32_t b) const { return edges_.contains(key(a, b)); }

 private:
  static std::uint64_t key(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
  }
  std::unordered_set<std::uint64_t> edges_;
};

class Triangulator {
 public:
  explicit Triangulator(Draft& draft) : draft_(draft), mesh_(*draft.upload) {
    const bool only_triangles = mesh_.indices.size() == 3 * at(mesh_.face_count());
    if (only_triangles) return;
    for (std::int32_t f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(f);
      for (std::size_t k = 0; k < face.size(); ++k) edges_.insert(face[k], face[(k + 1) % face.size()]);
    }
  }

  /// True when the face kept all of its corners.
  bool add(std::int32_t f) {
    const std::vector<std::int32_t> corners = without_repetition(mesh_.face(f));
    if (corners.size() == 3) {
      draft_.add_face({corners[0], corners[1], corners[2]}, f);
      return mesh_.face(f).size() == 3;
    }
    if (corners.size() < 3) {
      ++draft_.report.removed_faces;
      return false;
    }
    return add_polygon(corners, f) && corners.size() == mesh_.face(f).size();
  }

 private:
  /// The corners less those that equal the one before them, round the face.
  static std::vector<std::int32_t> without_repetition(std::span<const std::int32_t> face) {
    std::vector<std::int32_t> corners(face.begin(), face.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    // Of a triangle (a, b, a) nothing is left.
    if (corners.size() == 3 && corners[0] == corners[2]) corners.clear();
    return corners;
  }

  bool add_polygon(const std::vector<std::int32_t>& corners, std::int32_t f) {
    bool complete = true;
    for (const auto& [i, j, k] : triangles_of(corners)) {
      const std::int32_t a = corners[at(i)];
      const std::int32_t b = corners[at(j)];
      const std::int32_t c = corners[at(k)];
      if (a == b || b == c || c == a) {
        ++draft_.report.removed_faces;
        complete = false;
        continue;
      }
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) edges_.insert(from, to);
      draft_.add_face({a, b, c}, f);
    }
    return complete;
  }

  PolygonTriangles triangles_of(const std::vector<std::int32_t>& corners) {
    const auto n = static_cast<std::int32_t>(corners.size());
    const std::int64_t work = n > most_triangulated_corners ? 0 : triangulation_work(n);
    if (work > 0 && work_ + work <= most_work) {
      work_ += work;
      std::vector<Eigen::Vector3d> points;
      points.reserve(corners.size());
      for (const std::int32_t v : corners) points.emplace_back(mesh_.vertices.row(v).transpose());
      const auto allowed = [&](std::int32_t i, std::int32_t j) {
        return corners[at(i)] != corners[at(j)] && !edges_.contains(corners[at(i)], corners[at(j)]);
      };
      if (auto triangles = triangulate_polygon(points, allowed)) return *triangles;
    }
    PolygonTriangles fan;
    for (std::int32_t k = 1; k + 1 < n; ++k) fan.push_back({0, k, k + 1});
    return fan;
  }

  Draft& draft_;
  const PolygonMesh& mesh_;
  EdgeSet edges_;
  std::int64_t work_ = 0;
};

/// Marks all but the first of the faces over the same three vertices.
std::vector<char> first_of_each(const Draft& draft) {
  struct Key {
    std::array<std::int32_t, 3> corners;
    std::int32_t face;
    bool operator<(const Key& other) const { return std::tie(corners, face) < std::tie(other.corners, other.face); }
  };
  std::vector<Key> keys;
  keys.reserve(at(draft.face_count()));
  for (std::int32_t f = 0; f < draft.face_count(); ++f) {
    std::array<std::int32_t, 3> corners{draft.start(3 * f), draft.start(3 * f + 1), draft.start(3 * f + 2)};
    std::sort(corners.begin(), corners.end());
    keys.push_back({corners, f});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> keep(keys.size(), 1);
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].corners == keys[i - 1].corners) keep[at(keys[i].face)] = 0;
  return keep;
}

}  // namespace

void triangulate(Draft& draft, RepairMode mode) {
  Offenders repeated;
  Triangulator triangulator(draft);
  for (std::int32_t f = 0; f < draft.upload->face_count(); ++f)
    if (!triangulator.add(f)) repeated.add_face(f);
  if (mode == RepairMode::none && !repeated.elements().faces.empty())
    throw EngineError(ErrorCode::degenerate, "the mesh has faces with a repeated corner", repeated.elements());

  const std::vector<char> keep = first_of_each(draft);
  const auto duplicates = static_cast<std::int32_t>(std::count(keep.begin(), keep.end(), char{0}));
  if (duplicates == 0) return;
  if (mode == RepairMode::none) {
    Offenders offenders;
    for (std::int32_t f = 0; f < draft.face_count(); ++f)
      if (keep[at(f)] == 0) offenders.add_face(draft.polygon[at(f)]);
    throw EngineError(ErrorCode::degenerate, "the mesh has " + std::to_string(duplicates) + " duplicate faces", offenders.elements());
  }
  draft.report.removed_faces += duplicates;
  draft.keep_faces(keep);
}

}  // namespace spherematch
