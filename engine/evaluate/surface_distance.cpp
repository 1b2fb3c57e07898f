#include "engine/evaluate/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/data/error.h"
#include "engine/data/parallel.h"
#include "engine/evaluate/geodesics.h"
#include "engine/mesh/laplacian.h"

namespace spherematch {

namespace {

void require_index(std::int32_t index, std::size_t count, const char* what) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw EngineError(ErrorCode::invalid_parameter,
                    std::string(what) + ' ' + std::to_string(index) + " is not in 0 to " + std::to_string(count) + " - 1");
}

bool have_a_corner_in_common(const PlacedPoint& a, const PlacedPoint& b) {
  return std::any_of(a.corners.begin(), a.corners.end(),
                     [&b](std::int32_t corner) { return std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end(); });
}

double distance(GeodesicSearch& search, const TriMesh& mesh, const PlacedPoint& from, const PlacedPoint& to) {
  // Within the faces round a vertex the straight line is nearly the geodesic, and the way through a corner can be much longer.
  if (have_a_corner_in_common(from, to)) return (from.position - to.position).norm();
  const auto to_corner = [&mesh](const PlacedPoint& point, std::size_t k) {
    return (point.position - mesh.vertices.row(point.corners[k])).norm();
  };
  std::array<GeodesicSearch::Start, 3> starts{};
  for (std::size_t k = 0; k < 3; ++k) starts[k] = {from.corners[k], to_corner(from, k)};
  const std::vector<double> lengths = search.distances(starts, to.corners);
  double shortest = lengths[0] + to_corner(to, 0);
  for (std::size_t k = 1; k < 3; ++k) shortest = std::min(shortest, lengths[k] + to_corner(to, k));
  return shortest;
}

}  // namespace

std::optional<PlacedPoint> place_of(const Surface& surface, std::int32_t uploaded) {
  require_index(uploaded, surface.surface_vertex.size(), "the vertex");
  const std::int32_t vertex = surface.surface_vertex[static_cast<std::size_t>(uploaded)];
  if (vertex < 0) return std::nullopt;
  return PlacedPoint{{vertex, vertex, vertex}, {1, 0, 0}, surface.mesh.vertices.row(vertex)};
}

std::optional<PlacedPoint> image_of(const Correspondence& map, const Surface& target, std::int32_t source) {
  require_index(source, map.vertex.size(), "the source vertex");
  if (map.vertex[static_cast<std::size_t>(source)] < 0) return std::nullopt;
  PlacedPoint image{{}, {}, Eigen::RowVector3d::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const std::int32_t uploaded = map.corners(source, column);
    require_index(uploaded, target.surface_vertex.size(), "a corner of the map,");
    image.corners[k] = target.surface_vertex[static_cast<std::size_t>(uploaded)];
    require_index(image.corners[k], static_cast<std::size_t>(target.mesh.vertex_count()), "a corner of the map,");
    image.weights[k] = static_cast<double>(map.bary(source, column));
    image.position += image.weights[k] * target.mesh.vertices.row(image.corners[k]);
  }
  return image;
}

std::vector<std::optional<PlacedPoint>> images_of(const Correspondence& map, const Surface& target) {
  std::vector<std::optional<PlacedPoint>> images;
  images.reserve(map.vertex.size());
  for (std::size_t i = 0; i < map.vertex.size(); ++i) images.push_back(image_of(map, target, static_cast<std::int32_t>(i)));
  return images;
}

void require_rows(const Correspondence& map, const Surface& source) {
  if (map.vertex.size() == source.surface_vertex.size()) return;
  throw EngineError(ErrorCode::invalid_parameter, "the map has " + std::to_string(map.vertex.size()) + " rows, its source " +
                                                      std::to_string(source.surface_vertex.size()) + " vertices");
}

double unit_length(const Surface& surface) { return std::sqrt(face_areas(surface.mesh.vertices, surface.mesh.faces).sum()); }

std::vector<double> geodesic_distances(const Surface& surface, std::span<const PlacedPoint> from, std::span<const PlacedPoint> to,
                                       const Progress& progress, int threads) {
  constexpr std::size_t block = 256;
  const GeodesicGraph graph(surface.mesh);
  std::vector<double> result(from.size());
  run_parallel((from.size() + block - 1) / block, threads, [&](std::size_t task) {
    GeodesicSearch search(graph);
    for (std::size_t i = task * block; i < std::min(from.size(), (task + 1) * block); ++i) {
      if (i % 16 == 0) progress.check();
      result[i] = distance(search, surface.mesh, from[i], to[i]);
    }
  });
  return result;
}

}  // namespace spherematch
