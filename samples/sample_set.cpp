#include "samples/sample_set.h"

#include <algorithm>

#include "samples/file_formats.h"
#include "samples/holes.h"
#include "samples/marching.h"
#include "samples/skinning.h"

namespace spherematch::samples {
namespace {

constexpr std::size_t landmark_count = 500;

std::vector<int> mirror_images(const std::vector<int>& vertices, const Landmarks& landmarks) {
  std::vector<int> images;
  for (const int m : landmarks.mirror) images.push_back(vertices[static_cast<std::size_t>(m)]);
  return images;
}

struct Pair {
  const char *set, *source, *target;
};

/// Each way. The meshes with holes and those of their own triangulation are matched like the others; a GLB is not for the scoring program.
constexpr Pair pairs[] = {
    {"hound", "stand", "stride"}, {"hound", "stride", "look"}, {"hound", "look", "stand"}, {"hound", "stand", "bow"},
    {"hound", "look", "sit"},     {"hound", "sit", "bow"},     {"imp", "stand", "run"},    {"imp", "run", "wave"},
    {"imp", "wave", "stand"},     {"imp", "stand", "crouch"},  {"imp", "wave", "dance"},   {"imp", "dance", "crouch"},
};

}  // namespace

RestMeshes rest_meshes(const Creature& creature) {
  // Two grids that have nothing in common lead to two triangulations that have nothing in common.
  const Flesh& flesh = creature.flesh;
  const Mesh shared = remesh(flesh, march(flesh, 1.2, 0.25), creature.shared_scale);
  const Mesh independent = remesh(flesh, march(flesh, 1.1, 0.6), creature.independent_scale);
  RestMeshes rest;
  rest.landmarks = spread_landmarks(flesh, shared, landmark_count, creature.holes);
  rest.shared = remesh_with(flesh, shared, creature.shared_scale, rest.landmarks.points);
  rest.independent = remesh_with(flesh, independent, creature.independent_scale, rest.landmarks.points);
  return rest;
}

std::vector<File> pose_files(const Creature& creature, const RestMeshes& rest, const Pose& pose) {
  PinnedMesh shape = pose.kind == MeshKind::independent ? rest.independent : rest.shared;
  Mesh& mesh = shape.mesh;
  const std::vector<Vec3> rest_positions = mesh.vertices;
  mesh.vertices = posed(creature.flesh, pose.turns, mesh.vertices);
  for (Vec3& p : mesh.vertices) p = pose.placement(p);
  if (pose.kind == MeshKind::holed) {
    const Cut cut = cut_holes({rest_positions, mesh.triangles}, creature.holes);
    Mesh holed{{}, cut.triangles};
    for (const int v : cut.kept) holed.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    mesh = std::move(holed);
    for (int& v : shape.pinned) v = cut.new_number[static_cast<std::size_t>(v)];
  }

  const std::string path = creature.name + '/' + pose.name;
  const bool glb = pose.kind == MeshKind::glb;
  return {{path + (glb ? ".glb" : ".off"), glb ? glb_file(mesh, pose.name) : off_file(mesh)},
          {path + ".vts", vts_file(shape.pinned)},
          {path + ".sym.vts", vts_file(mirror_images(shape.pinned, rest.landmarks))}};
}

File pairs_file() {
  std::string text = "{\"pairs\": [\n";
  const auto line = [&](const char* set, const char* source, const char* target) {
    text += std::string(R"({"set": ")") + set + R"(", "src": ")" + source + R"(", "tgt": ")" + target + R"(", "truth": "vts"})";
  };
  bool first = true;
  for (const Pair& p : pairs) {
    if (!first) text += ",\n";
    first = false;
    line(p.set, p.source, p.target);
    text += ",\n";
    line(p.set, p.target, p.source);
  }
  return {"pairs.json", text + "\n]}\n"};
}

std::vector<File> sample_set() {
  std::vector<File> files;
  for (const Creature& creature : {hound(), imp()}) {
    const RestMeshes rest = rest_meshes(creature);
    for (const Pose& pose : creature.poses) {
      std::vector<File> more = pose_files(creature, rest, pose);
      std::move(more.begin(), more.end(), std::back_inserter(files));
    }
  }
  files.push_back(pairs_file());
  return files;
}

}  // namespace spherematch::samples
