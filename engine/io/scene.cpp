#include "engine/io/scene.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "engine/io/float_range.h"
#include "engine/io/glb_file.h"
#include "engine/io/map_mesh.h"

namespace spherematch {

namespace {

/// What moves the target beside the source.
Eigen::RowVector3d offset_beside(const Box& source, const Box& target) {
  constexpr double gap_share = 0.2;
  const double gap = gap_share * 2 * std::max(source.radius(), target.radius());
  Eigen::RowVector3d offset = source.center() - target.center();
  offset(0) = source.high(0) + gap - target.low(0);
  // A stray vertex may lie so far away that sums of coordinates are infinite, which JSON does not have.
  constexpr double farthest = 1e300;
  return offset.cwiseAbs().maxCoeff() < farthest ? offset : Eigen::RowVector3d(Eigen::RowVector3d::Zero());
}

}  // namespace

std::string encode_scene(PolygonMesh source, const PolygonMesh& target, const Correspondence& map, const Surface& target_surface,
                         const SceneNames& names) {
  if (target.vertex_count() != target_surface.uploaded_vertices()) {
    throw std::invalid_argument("the target mesh has " + std::to_string(target.vertex_count()) + " vertices and its shape " +
                                std::to_string(target_surface.uploaded_vertices()));
  }
  const MapMesh painted = paint_mesh(std::move(source), map, target_surface);
  const Colors target_colors = own_colors(target_surface);
  GlbFile file;
  file.add(painted.mesh, &painted.colors, {.name = names.source});
  file.add(target, &target_colors, {.name = names.target, .offset = offset_beside(box_of(painted.mesh.vertices), box_of(target.vertices))});
  return file.bytes();
}

}  // namespace spherematch
