#include "samples/skeleton.h"

#include <stdexcept>

namespace spherematch::samples {

Skeleton::Skeleton(std::span<const BoneRow> rows) {
  for (const BoneRow& row : rows) {
    const int index = static_cast<int>(bones_.size());
    const int parent = row.parent.empty() ? -1 : find(row.parent);
    if (row.pivot.x == 0) {
      bones_.push_back({std::string(row.name), parent, index, row.pivot, row.softness, row.edge});
      continue;
    }
    const int other_parent = parent < 0 ? -1 : bones_[static_cast<std::size_t>(parent)].mirror;
    bones_.push_back({std::string(row.name) + ".l", parent, index + 1, row.pivot, row.softness, row.edge});
    bones_.push_back({std::string(row.name) + ".r", other_parent, index, mirrored(row.pivot), row.softness, row.edge});
  }
}

int Skeleton::find(std::string_view name) const {
  for (std::size_t i = 0; i < bones_.size(); ++i)
    if (bones_[i].name == name || bones_[i].name == std::string(name) + ".l") return static_cast<int>(i);
  throw std::invalid_argument("no bone " + std::string(name));
}

std::vector<RigidMotion> Skeleton::motions(std::span<const Turn> turns) const {
  std::vector<Quaternion> local(bones_.size());
  for (const Turn& t : turns) {
    Quaternion& q = local[static_cast<std::size_t>(find(t.bone))];
    q = turn(t.axis, t.degrees) * q;
  }
  std::vector<RigidMotion> motions;
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    const Vec3& pivot = bones_[i].pivot;
    const RigidMotion about_pivot{local[i], pivot - RigidMotion{local[i], {}}(pivot)};
    motions.push_back(bones_[i].parent < 0 ? about_pivot : motions[static_cast<std::size_t>(bones_[i].parent)] * about_pivot);
  }
  return motions;
}

}  // namespace spherematch::samples
