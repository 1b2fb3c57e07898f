#include "samples/skinning.h"

#include <algorithm>

namespace spherematch::samples {

std::vector<Vec3> posed(const Flesh& flesh, std::span<const Turn> turns, const std::vector<Vec3>& rest) {
  std::vector<DualQuaternion> bones;
  for (const RigidMotion& m : flesh.skeleton().motions(turns)) bones.emplace_back(m);

  std::vector<Vec3> result;
  result.reserve(rest.size());
  for (const Vec3& p : rest) {
    const std::vector<double> w = flesh.weights(p);
    const Quaternion pivot = bones[static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin())].real;
    DualQuaternion sum = bones[0];
    sum.real = sum.dual = {0, {}};
    for (std::size_t b = 0; b < bones.size(); ++b) {
      // q and -q are the same rotation; those on the side of the strongest bone add up along the shorter way.
      const double signed_weight = dot(bones[b].real, pivot) < 0 ? -w[b] : w[b];
      sum.real = sum.real + signed_weight * bones[b].real;
      sum.dual = sum.dual + signed_weight * bones[b].dual;
    }
    result.push_back(sum.motion()(p));
  }
  return result;
}

}  // namespace spherematch::samples
