#include "bench/experiments/shape_classes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <stdexcept>

#include "engine/engine.h"
#include "engine/io/map_reader.h"
#include "engine/mesh/laplacian.h"

namespace spherematch::bench {

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return bytes;
}

std::string class_of(const fs::path& file, bool whole_folders) {
  std::string folder = fs::absolute(file).parent_path().filename().string();
  if (whole_folders) return folder;
  const std::string name = file.stem().string();
  return folder + "/" + name.substr(0, name.find_last_not_of("0123456789_") + 1);
}

fs::path beside(const fs::path& file, const char* extension) { return fs::path(file).replace_extension(extension); }

std::vector<std::int32_t> list_in(const fs::path& file) { return read_landmarks(bytes_of(file)); }

}  // namespace

ShapeClasses classes_in(const std::vector<std::string>& places, bool whole_folders, std::size_t least) {
  ShapeClasses classes;
  const auto add = [&](const fs::path& file) { classes[class_of(file, whole_folders)].push_back(file); };
  for (const fs::path place : places) {
    if (!fs::is_directory(place)) {
      add(place);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(place))
      if (entry.path().extension() == ".off") add(entry.path());
  }
  for (auto& [name, files] : classes) std::sort(files.begin(), files.end());
  std::erase_if(classes, [least](const auto& entry) { return entry.second.size() < least; });
  if (classes.empty()) throw std::runtime_error("no class of at least " + std::to_string(least) + " OFF files");
  return classes;
}

Surface read_shape(const fs::path& file) {
  const std::string bytes = bytes_of(file);
  return read_surface(std::as_bytes(std::span(bytes)), file.string(), {}, ReadLimits::none());
}

std::optional<GroundTruth> truth_between(const fs::path& source, const fs::path& target, const Surface& source_surface,
                                         const Surface& target_surface) {
  if (fs::exists(beside(source, ".vts")) && fs::exists(beside(target, ".vts"))) {
    const std::vector<std::int32_t> sources = list_in(beside(source, ".vts"));
    GroundTruth truth;
    truth.direct = paired(sources, list_in(beside(target, ".vts")));
    if (fs::exists(beside(target, ".sym.vts"))) truth.mirrored = paired(sources, list_in(beside(target, ".sym.vts")));
    return truth;
  }
  if (source_surface.uploaded_vertices() != target_surface.uploaded_vertices()) return std::nullopt;
  return identity_truth(source_surface.uploaded_vertices(), target_surface.uploaded_vertices());
}

std::optional<std::vector<Landmark>> listed_symmetry(const fs::path& file) {
  if (!fs::exists(beside(file, ".vts")) || !fs::exists(beside(file, ".sym.vts"))) return std::nullopt;
  return paired(list_in(beside(file, ".vts")), list_in(beside(file, ".sym.vts")));
}

std::vector<std::int32_t> vertices_drawn_by_area(const Surface& surface, int count) {
  const Eigen::VectorXd areas = vertex_areas(surface.mesh.vertices, surface.mesh.faces);
  // Weights of uploaded vertices; those that share a place, or were dropped, do not matter here.
  std::vector<double> weights;
  for (const std::int32_t vertex : surface.surface_vertex) weights.push_back(vertex < 0 ? 0 : areas[vertex]);
  std::mt19937_64 generator(1);
  std::discrete_distribution<std::int32_t> draw(weights.begin(), weights.end());
  std::vector<std::int32_t> drawn;
  for (int i = 0; i < count; ++i) drawn.push_back(draw(generator));
  return drawn;
}

std::optional<std::vector<Landmark>> extrinsic_symmetry(const Surface& surface, int count) {
  const TriMesh& mesh = surface.mesh;
  const Eigen::VectorXd areas = vertex_areas(mesh.vertices, mesh.faces);
  const double middle = mesh.vertices.col(0).dot(areas) / areas.sum();
  std::vector<std::int32_t> uploaded(static_cast<std::size_t>(mesh.vertex_count()), -1);
  for (std::size_t v = 0; v < surface.surface_vertex.size(); ++v) {
    if (surface.surface_vertex[v] >= 0) uploaded[static_cast<std::size_t>(surface.surface_vertex[v])] = static_cast<std::int32_t>(v);
  }
  std::vector<Landmark> pairs;
  double misses = 0;
  for (const std::int32_t vertex : vertices_drawn_by_area(surface, count)) {
    Eigen::RowVector3d image = mesh.vertices.row(surface.surface_vertex[static_cast<std::size_t>(vertex)]);
    image[0] = 2 * middle - image[0];
    double nearest = std::numeric_limits<double>::infinity();
    std::int32_t mirrored = -1;
    for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
      const double distance = (mesh.vertices.row(v) - image).norm();
      if (uploaded[static_cast<std::size_t>(v)] < 0 || distance >= nearest) continue;
      nearest = distance;
      mirrored = uploaded[static_cast<std::size_t>(v)];
    }
    misses += nearest / count;
    pairs.push_back({vertex, mirrored});
  }
  if (misses > 0.01 * std::sqrt(areas.sum())) return std::nullopt;
  return pairs;
}

}  // namespace spherematch::bench
