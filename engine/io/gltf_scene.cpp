#include "engine/io/gltf_scene.h"

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "engine/io/gltf_accessor.h"
#include "engine/io/mesh_limits.h"

namespace spherematch {

namespace {

/// A mesh where a node puts it.
struct Instance {
  std::size_t mesh;
  Eigen::Affine3d transform;
};

Eigen::Affine3d local_transform(const tinygltf::Node& node, const GltfPart& part) {
  const auto check_length = [&](const std::vector<double>& numbers, std::size_t length, const std::string& name) {
    if (!numbers.empty() && numbers.size() != length) part.fail("its " + name + " needs " + std::to_string(length) + " numbers");
  };
  check_length(node.matrix, 16, "matrix");
  check_length(node.translation, 3, "translation");
  check_length(node.rotation, 4, "rotation");
  check_length(node.scale, 3, "scale");

  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (!node.matrix.empty()) {
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    if (transform.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) part.fail("the last row of its matrix is not 0 0 0 1");
    return transform;
  }
  if (!node.translation.empty()) transform.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
  if (!node.rotation.empty()) {
    const Eigen::Quaterniond rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(rotation.norm() > 0)) part.fail("its rotation is zero");
    transform.rotate(rotation.normalized());
  }
  if (!node.scale.empty()) transform.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
  return transform;
}

/// Walks the nodes of a scene depth first. Each node has one parent at most, so that no node is met twice.
class SceneWalk {
 public:
  explicit SceneWalk(const tinygltf::Model& model) : model_(model), met_(model.nodes.size(), false) {}

  std::vector<Instance> instances() {
    push(roots(), Eigen::Affine3d::Identity(), {"scene", scene_index()});
    std::vector<Instance> instances;
    while (!waiting_.empty()) {
      const auto [index, above] = waiting_.back();
      waiting_.pop_back();
      const tinygltf::Node& node = model_.nodes[index];
      const GltfPart part{"node", static_cast<std::int64_t>(index)};
      const Eigen::Affine3d transform = above * local_transform(node, part);
      if (node.mesh >= 0) {
        if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) part.fail("there is no mesh " + std::to_string(node.mesh));
        instances.push_back({static_cast<std::size_t>(node.mesh), transform});
      }
      push(node.children, transform, part);
    }
    return instances;
  }

 private:
  struct Waiting {
    std::size_t node;
    Eigen::Affine3d above;
  };

  [[nodiscard]] int scene_index() const { return model_.defaultScene < 0 ? 0 : model_.defaultScene; }

  /// Those of the default scene, else of the first one, else the nodes without a parent.
  [[nodiscard]] std::vector<int> roots() const {
    const auto scene = static_cast<std::size_t>(scene_index());
    if (scene < model_.scenes.size()) return model_.scenes[scene].nodes;
    if (model_.defaultScene >= 0) GltfPart{"scene", scene_index()}.fail("there is no such scene");
    std::vector<bool> has_parent(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < has_parent.size()) has_parent[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < has_parent.size(); ++i)
      if (!has_parent[i]) roots.push_back(static_cast<int>(i));
    return roots;
  }

  void push(const std::vector<int>& nodes, const Eigen::Affine3d& above, const GltfPart& parent) {
    const std::size_t first = waiting_.size();
    for (const int node : nodes) {
      if (node < 0 || static_cast<std::size_t>(node) >= met_.size()) parent.fail("there is no node " + std::to_string(node));
      if (met_[static_cast<std::size_t>(node)]) GltfPart{"node", node}.fail("it has two parents, or is among its own children");
      met_[static_cast<std::size_t>(node)] = true;
      waiting_.push_back({static_cast<std::size_t>(node), above});
    }
    std::reverse(waiting_.begin() + static_cast<std::ptrdiff_t>(first), waiting_.end());
  }

  const tinygltf::Model& model_;
  std::vector<bool> met_;
  std::vector<Waiting> waiting_;
};

/// A primitive made of triangles.
struct TrianglePrimitive {
  int mode;
  int positions;  ///< accessor
  int indices;    ///< accessor, or -1
  std::int64_t vertices;
  std::int64_t most_corners;
};

struct TriangleMesh {
  std::vector<TrianglePrimitive> primitives;
  std::int64_t vertices = 0;
  std::int64_t most_corners = 0;
};

/// Nothing for points and lines.
std::optional<TrianglePrimitive> triangle_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                    const GltfPart& part) {
  if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES) return std::nullopt;
  if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) part.fail("there is no mode " + std::to_string(primitive.mode));
  const auto positions = primitive.attributes.find("POSITION");
  if (positions == primitive.attributes.end()) part.fail("a primitive has no POSITION");
  TrianglePrimitive result{primitive.mode, positions->second, primitive.indices, position_count(model, positions->second), 0};
  const std::int64_t count = primitive.indices < 0 ? result.vertices : index_count(model, primitive.indices);
  const bool separate = primitive.mode == TINYGLTF_MODE_TRIANGLES;
  if (separate && count % 3 != 0) part.fail("a primitive has " + std::to_string(count) + " corners, which make no triangles");
  result.most_corners = separate ? count : 3 * std::max<std::int64_t>(count - 2, 0);
  return result;
}

TriangleMesh triangle_mesh(const tinygltf::Model& model, std::size_t index) {
  TriangleMesh result;
  for (const tinygltf::Primitive& primitive : model.meshes[index].primitives)
    if (const auto triangles = triangle_primitive(model, primitive, {"mesh", static_cast<std::int64_t>(index)})) {
      result.primitives.push_back(*triangles);
      result.vertices += triangles->vertices;
      result.most_corners += triangles->most_corners;
    }
  return result;
}

/// Puts instances one after the other.
class Assembly {
 public:
  Assembly(const tinygltf::Model& model, const ReadLimits& limits) : model_(model), limits_(limits), meshes_(model.meshes.size()) {}

  PolygonMesh assemble(const std::vector<Instance>& instances) {
    allocate(instances);
    for (const Instance& instance : instances)
      for (const TrianglePrimitive& primitive : meshes_[instance.mesh]->primitives) add(primitive, instance);
    check_not_empty(mesh_.vertices.rows(), static_cast<std::int64_t>(mesh_.offsets.size()) - 1);
    return std::move(mesh_);
  }

 private:
  /// Only after all that will be there was counted and found to be within the limits.
  void allocate(const std::vector<Instance>& instances) {
    std::int64_t vertices = 0;
    std::int64_t corners = 0;
    for (const Instance& instance : instances) {
      std::optional<TriangleMesh>& mesh = meshes_[instance.mesh];
      if (!mesh) mesh = triangle_mesh(model_, instance.mesh);
      limits_.check_vertices(vertices += mesh->vertices);
      limits_.check_corners(corners += mesh->most_corners, GltfPart{"mesh", static_cast<std::int64_t>(instance.mesh)});
    }
    mesh_.vertices.resize(vertices, 3);
    mesh_.indices.reserve(static_cast<std::size_t>(corners));
    mesh_.offsets.reserve(static_cast<std::size_t>(corners / 3 + 1));
  }

  void add(const TrianglePrimitive& primitive, const Instance& instance) {
    auto points = mesh_.vertices.middleRows(used_, primitive.vertices);
    read_positions(model_, primitive.positions, points);
    // Multiplying by the identity would turn -0 into 0.
    if (!instance.transform.matrix().isIdentity(0))
      for (auto point : points.rowwise()) point = (instance.transform * point.transpose()).transpose();
    if (!points.allFinite()) GltfPart{"accessor", primitive.positions}.fail("a position is not finite, or not where its node puts it");
    add_triangles(primitive, instance.transform.linear().determinant() < 0);
    used_ += primitive.vertices;
  }

  void add_triangles(const TrianglePrimitive& primitive, bool mirrored) {
    const std::vector<std::uint32_t> indices =
        primitive.indices < 0 ? std::vector<std::uint32_t>() : read_indices(model_, primitive.indices);
    const auto corner = [&](std::int64_t i) -> std::int64_t { return primitive.indices < 0 ? i : indices[static_cast<std::size_t>(i)]; };
    const std::int64_t triangles = primitive.most_corners / 3;
    for (std::int64_t t = 0; t < triangles; ++t) {
      std::array<std::int64_t, 3> corners{};
      switch (primitive.mode) {
        case TINYGLTF_MODE_TRIANGLE_STRIP:
          corners = {corner(t), corner(t + 1 + t % 2), corner(t + 2 - t % 2)};
          break;
        case TINYGLTF_MODE_TRIANGLE_FAN:
          corners = {corner(t + 1), corner(t + 2), corner(0)};
          break;
        default:
          corners = {corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)};
      }
      if (mirrored) std::swap(corners[1], corners[2]);
      add_triangle(corners, primitive);
    }
  }

  void add_triangle(const std::array<std::int64_t, 3>& corners, const TrianglePrimitive& primitive) {
    const bool flat = corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    // Strips are joined by triangles without area, which the file's author did not mean as faces.
    if (flat && primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return;
    for (const std::int64_t index : corners) {
      const GltfPart part{"accessor", primitive.indices};
      mesh_.indices.push_back(static_cast<std::int32_t>(used_) + checked_index(index, primitive.vertices, part));
    }
    mesh_.offsets.push_back(static_cast<std::int32_t>(mesh_.indices.size()));
  }

  const tinygltf::Model& model_;
  MeshLimits limits_;
  std::vector<std::optional<TriangleMesh>> meshes_;  ///< of those that were met
  PolygonMesh mesh_;
  std::int64_t used_ = 0;  ///< rows of mesh_.vertices
};

}  // namespace

PolygonMesh read_gltf_scene(const tinygltf::Model& model, const ReadLimits& limits) {
  return Assembly(model, limits).assemble(SceneWalk(model).instances());
}

}  // namespace spherematch
