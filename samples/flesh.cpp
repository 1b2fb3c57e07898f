#include "samples/flesh.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace spherematch::samples {
namespace {

/// Far outside of everything: neutral in a union.
constexpr Sample nothing{1e9, {}};

/// Left and right limbs come closer to each other than to the trunk, and still do not move each other's skin.
constexpr double range_between_sides = 5;

/// From 0 at -1 to 1 at 1, flat at both ends.
double smooth_step(double t) {
  const double s = std::clamp(t, -1.0, 1.0);
  return 0.5 + s * (3 - s * s) / 4;
}

Sample negated(const Sample& s) { return {-s.value, -1.0 * s.gradient}; }

}  // namespace

Sample signed_distance(const RoundCone& cone, const Vec3& p) {
  // Stretch space along `thin` to make the cone round, and measure there.
  const double stretch = 1 / cone.flatness - 1;
  const auto stretched = [&](const Vec3& d) { return d + (stretch * dot(d, cone.thin)) * cone.thin; };
  const Vec3 q = stretched(p - cone.a);
  const Vec3 axis = stretched(cone.b - cone.a);
  const double length = norm(axis);
  Vec3 centre;
  double radius = cone.radius_a;
  if (length > 0) {
    // Of the spheres along the axis, sqrt(r^2 + (y - s)^2) - radius(s) is convex in s and smallest where its derivative vanishes.
    const double slope = (cone.radius_b - cone.radius_a) / length;
    const double y = dot(q, axis) / length;
    const double r = std::sqrt(std::max(0.0, dot(q, q) - y * y));
    const double s = std::clamp(y + slope * r / std::sqrt(1 - slope * slope), 0.0, length);
    centre = (s / length) * axis;
    radius += slope * s;
  }
  const double to_centre = distance(q, centre);
  if (to_centre == 0) return {-radius, {}};
  const Vec3 gradient = stretched((1 / to_centre) * (q - centre));
  const double steepness = norm(gradient);
  return {(to_centre - radius) / steepness, (1 / steepness) * gradient};
}

Sample smooth_minimum(const Sample& a, const Sample& b, double width) {
  const double overlap = std::max(0.0, width - std::abs(a.value - b.value)) / width;
  const double share_of_larger = overlap / 2;
  const double share_of_a = a.value <= b.value ? 1 - share_of_larger : share_of_larger;
  return {std::min(a.value, b.value) - overlap * overlap * width / 4, share_of_a * a.gradient + (1 - share_of_a) * b.gradient};
}

Flesh::Flesh(Skeleton skeleton, std::vector<Group> groups) : skeleton_(std::move(skeleton)) {
  std::vector<bool> has_flesh(skeleton_.bones().size(), false);
  for (Group& group : groups) {
    Limb& limb = limbs_.emplace_back();
    limb.group = std::move(group);
    for (const Part& part : limb.group.parts) {
      const auto bone = static_cast<std::size_t>(skeleton_.find(part.bone));
      limb.bones.push_back(bone);
      if (!part.carved) has_flesh[bone] = true;
      if (!part.carved && limb.group.paired) has_flesh[static_cast<std::size_t>(skeleton_.bones()[bone].mirror)] = true;
      limb.centre += (0.5 / static_cast<double>(limb.group.parts.size())) * (part.cone.a + part.cone.b);
      limb.least_flatness = std::min(limb.least_flatness, part.cone.flatness);
    }
    for (const Part& part : limb.group.parts)
      limb.radius = std::max(
          {limb.radius, distance(limb.centre, part.cone.a) + part.cone.radius_a, distance(limb.centre, part.cone.b) + part.cone.radius_b});
  }
  if (const auto bare = std::find(has_flesh.begin(), has_flesh.end(), false); bare != has_flesh.end())
    throw std::invalid_argument("no flesh on " + skeleton_.bones()[static_cast<std::size_t>(bare - has_flesh.begin())].name);
}

/// The given side of a limb; nothing where its value is certainly above `near`. Values are at least the distance times the flatness, and
/// blending takes off at most its width from each part's.
Sample Flesh::side(const Limb& limb, const Vec3& p, double near) {
  const double swell = 2;
  if (limb.least_flatness * (distance(p, limb.centre) - limb.radius) > near + swell) return nothing;
  Sample sum = nothing;
  for (const Part& part : limb.group.parts) {
    const Sample s = signed_distance(part.cone, p);
    sum = part.carved ? negated(smooth_minimum(negated(sum), s, part.blend)) : smooth_minimum(sum, s, part.blend);
  }
  return sum;
}

Sample Flesh::sample(const Vec3& p) const {
  Sample sum = nothing;
  for (const Limb& limb : limbs_) {
    const double near = sum.value + 2 * limb.group.blend;
    Sample s = side(limb, p, near);
    if (limb.group.paired) {
      Sample other = side(limb, mirrored(p), near);
      other.gradient = mirrored(other.gradient);
      s = smooth_minimum(s, other, limb.group.blend);
    }
    sum = smooth_minimum(sum, s, limb.group.blend);
  }
  return sum;
}

Vec3 Flesh::project(Vec3 p) const {
  for (int i = 0; i < 4; ++i) {
    const Sample s = sample(p);
    if (std::abs(s.value) < 1e-9) break;
    p = p - (s.value / std::max(dot(s.gradient, s.gradient), 0.1)) * s.gradient;
  }
  return p;
}

std::vector<double> Flesh::distances(const Vec3& p) const {
  std::vector<double> d(skeleton_.bones().size(), std::numeric_limits<double>::infinity());
  for (const Limb& limb : limbs_)
    for (std::size_t i = 0; i < limb.bones.size(); ++i) {
      const Part& part = limb.group.parts[i];
      if (part.carved) continue;
      const std::size_t bone = limb.bones[i];
      d[bone] = std::min(d[bone], signed_distance(part.cone, p).value);
      if (!limb.group.paired) continue;
      const auto other = static_cast<std::size_t>(skeleton_.bones()[bone].mirror);
      d[other] = std::min(d[other], signed_distance(part.cone, mirrored(p)).value);
    }
  return d;
}

std::vector<double> Flesh::weights(const Vec3& p) const {
  const std::vector<Bone>& bones = skeleton_.bones();
  const std::vector<double> own = distances(p);

  std::vector<double> beyond = own;  // distance to the flesh beyond each joint
  for (std::size_t b = bones.size(); b-- > 1;) {
    double& parent = beyond[static_cast<std::size_t>(bones[b].parent)];
    parent = std::min(parent, beyond[b]);
  }
  std::vector<double> before(bones.size(), std::numeric_limits<double>::infinity());  // to the flesh on the way to the root
  std::vector<double> follows(bones.size(), 1);                                       // how far p follows each joint, 0 to 1
  for (std::size_t b = 1; b < bones.size(); ++b) {
    const auto parent = static_cast<std::size_t>(bones[b].parent);
    before[b] = std::min(before[parent], own[parent]);
    follows[b] = smooth_step((before[b] - beyond[b]) / bones[b].softness);
    for (std::size_t sibling = 1; sibling < bones.size(); ++sibling) {
      if (sibling == b || bones[sibling].parent != bones[b].parent) continue;
      const bool is_mirror = static_cast<std::size_t>(bones[b].mirror) == sibling;
      const double range = is_mirror ? range_between_sides : std::min(bones[b].softness, bones[sibling].softness);
      follows[b] *= smooth_step((beyond[sibling] - beyond[b]) / range);
    }
  }

  // A bone takes along what follows its joint and none of those after it. What two siblings claim is neither's alone: hence the sum.
  std::vector<double> claim = follows;
  for (std::size_t b = 1; b < bones.size(); ++b) {
    claim[b] *= claim[static_cast<std::size_t>(bones[b].parent)];
    for (std::size_t sibling = 1; sibling < bones.size(); ++sibling)
      if (sibling != b && bones[sibling].parent == bones[b].parent) claim[b] *= 1 - follows[sibling];
  }
  double sum = 0;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    for (std::size_t child = b + 1; child < bones.size(); ++child)
      if (bones[child].parent == static_cast<int>(b)) claim[b] *= 1 - follows[child];
    sum += claim[b];
  }
  for (double& w : claim) w /= sum;
  return claim;
}

double Flesh::edge_length(const Vec3& p) const {
  const std::vector<double> w = weights(p);
  double length = 0;
  for (std::size_t b = 0; b < w.size(); ++b) length += w[b] * skeleton_.bones()[b].edge;
  return length;
}

std::pair<Vec3, Vec3> Flesh::bounds() const {
  constexpr double margin = 2;  // blends swell a little
  Vec3 low{0, 0, 0}, high{0, 0, 0};
  for (const Limb& limb : limbs_)
    for (const Part& part : limb.group.parts) {
      if (part.carved) continue;
      const auto include = [&](const Vec3& c, double radius) {
        const double r = radius + margin;
        high = {std::max(high.x, std::abs(c.x) + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
        low = {-high.x, std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
      };
      include(part.cone.a, part.cone.radius_a);
      include(part.cone.b, part.cone.radius_b);
    }
  return {low, high};
}

}  // namespace spherematch::samples
