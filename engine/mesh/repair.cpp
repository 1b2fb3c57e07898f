#include "engine/mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/mesh/components.h"
#include "engine/mesh/draft.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/glue.h"
#include "engine/mesh/orient.h"
#include "engine/mesh/triangulate.h"
#include "engine/mesh/weld.h"
#include "engine/mesh/zero_area.h"

namespace spherematch {

namespace {

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

void refuse_unusable(const PolygonMesh& upload) {
  for (std::int32_t v = 0; v < upload.vertex_count(); ++v)
    if (!upload.vertices.row(v).allFinite())
      throw EngineError(ErrorCode::degenerate, "vertex " + std::to_string(v) + " is not finite",
                        {.vertices = {v}, .faces = {}, .edges = {}});
  if (upload.vertex_count() < 4 || upload.face_count() < 1)
    throw EngineError(ErrorCode::degenerate, "the mesh has fewer than four vertices, or no face");
  for (const std::int32_t index : upload.indices)
    if (index < 0 || index >= upload.vertex_count())
      throw EngineError(ErrorCode::malformed_mesh, "a face has the vertex " + std::to_string(index) + ", which does not exist");
  // Volumes are products of three lengths and must stay within the range of doubles.
  constexpr double smallest = 1e-60;
  constexpr double largest = 1e60;
  const double extent = (upload.vertices.colwise().maxCoeff() - upload.vertices.colwise().minCoeff()).maxCoeff();
  if (!(extent > smallest) || !(upload.vertices.cwiseAbs().maxCoeff() < largest))
    throw EngineError(ErrorCode::degenerate, "the mesh is too small or too large to compute with");
}

/// Per uploaded vertex its lowest class, -1 for none, and whether it has several.
struct UploadedPlaces {
  std::vector<std::int32_t> lowest;
  std::vector<char> several;
};

UploadedPlaces uploaded_places(const Draft& draft) {
  const std::size_t count = at(draft.upload->vertex_count());
  UploadedPlaces places{std::vector<std::int32_t>(count, -1), std::vector<char>(count, 0)};
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    std::int32_t& lowest = places.lowest[at(draft.start(h))];
    if (lowest >= 0 && lowest != draft.vertex_of(h)) places.several[at(draft.start(h))] = 1;
    lowest = lowest < 0 ? draft.vertex_of(h) : std::min(lowest, draft.vertex_of(h));
  }
  return places;
}

/// What RepairMode::none refuses of vertices: those of several fans, and those of none.
void refuse_vertices(const UploadedPlaces& places) {
  Offenders several;
  Offenders unused;
  for (std::size_t v = 0; v < places.lowest.size(); ++v) {
    if (places.several[v] != 0) several.add_vertex(static_cast<std::int32_t>(v));
    if (places.lowest[v] < 0) unused.add_vertex(static_cast<std::int32_t>(v));
  }
  if (!several.elements().vertices.empty())
    throw EngineError(ErrorCode::non_manifold, "the mesh has non-manifold vertices", several.elements());
  if (!unused.elements().vertices.empty())
    throw EngineError(ErrorCode::disconnected, "the mesh has vertices without a face", unused.elements());
}

void refuse_zero_area(const Draft& draft) {
  Offenders offenders;
  for (std::int32_t f = 0; f < draft.face_count(); ++f)
    if (is_zero_area(draft.position_of(3 * f), draft.position_of(3 * f + 1), draft.position_of(3 * f + 2)))
      offenders.add_face(draft.polygon[at(f)]);
  if (!offenders.elements().faces.empty())
    throw EngineError(ErrorCode::degenerate, "the mesh has triangles of zero area", offenders.elements());
}

/// The new number of each class that has a face, in order; -1 for the others.
std::vector<std::int32_t> used_classes(const Draft& draft, std::int32_t& count) {
  std::vector<std::int32_t> number(draft.position.size(), -1);
  for (const std::int32_t vertex : draft.vertex) number[at(vertex)] = 0;
  count = 0;
  for (std::int32_t& entry : number)
    if (entry == 0) entry = count++;
  return number;
}

void refuse_other_than_sphere(const Draft& draft) {
  std::int32_t vertices = 0;
  (void)used_classes(draft, vertices);
  if (vertices < 4) throw EngineError(ErrorCode::degenerate, "the surface has fewer than four vertices");
  const std::int32_t characteristic = vertices - draft.half_edge_count() / 2 + draft.face_count();
  if (characteristic != 2)
    throw EngineError(ErrorCode::wrong_genus, "the surface has genus " + std::to_string((2 - characteristic) / 2) +
                                                  "; only genus 0, a sphere without handles, can be matched");
}

/// `lowest` is the lowest class of each uploaded vertex before `become` merged some.
Surface surface_of(const Draft& draft, const std::vector<std::int32_t>& lowest, const std::vector<std::int32_t>& become) {
  std::int32_t vertices = 0;
  const std::vector<std::int32_t> number = used_classes(draft, vertices);
  Surface surface;
  surface.mesh.vertices.resize(vertices, 3);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) surface.mesh.vertices.row(number[v]) = draft.position[v].transpose();
  surface.mesh.faces.resize(draft.face_count(), 3);
  surface.uploaded_corners.resize(draft.face_count(), 3);
  for (HalfEdge h = 0; h < draft.half_edge_count(); ++h) {
    surface.mesh.faces(h / 3, h % 3) = number[at(draft.vertex_of(h))];
    surface.uploaded_corners(h / 3, h % 3) = draft.start(h);
  }
  surface.surface_vertex.reserve(lowest.size());
  for (const std::int32_t vertex : lowest) surface.surface_vertex.push_back(vertex < 0 ? -1 : number[at(become[at(vertex)])]);
  surface.uploaded_faces = draft.upload->face_count();
  surface.report = draft.report;
  surface.report.dropped_vertices = static_cast<std::int32_t>(std::count(lowest.begin(), lowest.end(), -1));
  for (std::int32_t f = 0; f < draft.face_count(); ++f)
    if (draft.polygon[at(f)] >= 0) surface.report.flipped_faces += draft.turned[at(f)];
  return surface;
}

}  // namespace

Surface repair(const PolygonMesh& upload, RepairMode mode) {
  refuse_unusable(upload);
  Draft draft(upload);
  triangulate(draft, mode);
  glue_by_index(draft, mode);
  if (mode == RepairMode::fill) glue_seams(draft);
  agree_orientations(draft);
  number_vertices_without_double_edges(draft);
  if (mode == RepairMode::none) refuse_vertices(uploaded_places(draft));
  keep_largest_component(draft, mode);
  refuse_contradictions(draft);
  refuse_double_edges(draft);

  const std::vector<std::int32_t> lowest = uploaded_places(draft).lowest;
  if (mode == RepairMode::fill) fill_holes(draft);
  refuse_other_than_sphere(draft);
  std::vector<std::int32_t> become(draft.position.size());
  std::iota(become.begin(), become.end(), 0);
  if (mode == RepairMode::fill)
    become = remove_zero_area_faces(draft);
  else
    refuse_zero_area(draft);
  turn_outward(draft, mode);
  return surface_of(draft, lowest, become);
}

}  // namespace spherematch
