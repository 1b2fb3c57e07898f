#include "engine/mesh/components.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace spherematch {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

double area(const Draft& draft, std::int32_t face) {
  const Eigen::Vector3d a = draft.uploaded_position(3 * face);
  return 0.5 * (draft.uploaded_position(3 * face + 1) - a).cross(draft.uploaded_position(3 * face + 2) - a).norm();
}

/// The component of each face, numbered by their lowest face.
std::vector<std::int32_t> component_of_faces(const Draft& draft, std::int32_t& components) {
  std::vector<std::int32_t> component(at(draft.face_count()), -1);
  std::vector<std::int32_t> open;
  components = 0;
  for (std::int32_t seed = 0; seed < draft.face_count(); ++seed) {
    if (component[at(seed)] >= 0) continue;
    component[at(seed)] = components;
    open.push_back(seed);
    while (!open.empty()) {
      const std::int32_t face = open.back();
      open.pop_back();
      for (HalfEdge h = 3 * face; h < 3 * face + 3; ++h) {
        const HalfEdge other = draft.mate_of(h);
        if (other == no_half_edge || component[at(other / 3)] >= 0) continue;
        component[at(other / 3)] = components;
        open.push_back(other / 3);
      }
    }
    ++components;
  }
  return component;
}

void refuse_components(const Draft& draft, const std::vector<std::int32_t>& component, std::int32_t components, std::int32_t largest) {
  Offenders offenders;
  std::int32_t listed = 0;
  for (std::int32_t f = 0; f < draft.face_count(); ++f) {
    if (component[at(f)] < listed) continue;
    if (component[at(f)] != largest) offenders.add_face(draft.polygon[at(f)]);
    listed = component[at(f)] + 1;
  }
  throw EngineError(ErrorCode::disconnected,
                    "the mesh has " + std::to_string(components) + " components; one face of each smaller one is listed",
                    offenders.elements());
}

}  // namespace

void keep_largest_component(Draft& draft, RepairMode mode) {
  std::int32_t components = 0;
  const std::vector<std::int32_t> component = component_of_faces(draft, components);
  std::vector<double> areas(at(components), 0.0);
  for (std::int32_t f = 0; f < draft.face_count(); ++f) areas[at(component[at(f)])] += area(draft, f);
  const auto best = std::max_element(areas.begin(), areas.end());
  if (best == areas.end() || !(*best > 0) || !std::isfinite(*best))
    throw EngineError(ErrorCode::degenerate, "the surface has no area, or more than can be computed with");
  const auto largest = static_cast<std::int32_t>(best - areas.begin());
  if (components == 1) return;
  if (mode == RepairMode::none) refuse_components(draft, component, components, largest);
  std::vector<char> keep(component.size());
  std::transform(component.begin(), component.end(), keep.begin(), [&](std::int32_t c) { return c == largest ? char{1} : char{0}; });
  draft.report.removed_faces += static_cast<std::int32_t>(std::count(keep.begin(), keep.end(), char{0}));
  draft.report.dropped_components = components - 1;
  draft.keep_faces(keep);
}

}  // namespace spherematch
