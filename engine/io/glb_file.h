// A binary glTF 2.0 file, put together mesh by mesh. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/io/map_mesh.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// u, v for each vertex, (n, 2), v downward as glTF has it.
using TextureCoordinates = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// One colour for each vertex, (n, 4), in linear light as glTF has it: red, green, blue, alpha, from 0 to 65535.
using LinearColors = Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Not thread-safe.
class GlbFile {
 public:
  struct Node {
    std::string name;  ///< none where empty
    Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();
  };

  /// Adds a node with the mesh: POSITION, NORMAL, the polygons triangulated, and COLOR_0 where there are colours. Numbers are float;
  /// where that would blur the mesh, the positions are relative to its centre and the node has place and size.
  void add(const PolygonMesh& mesh, const Colors* colors, const Node& node);

  /// The same with colours in linear light.
  void add(const PolygonMesh& mesh, const LinearColors& colors, const Node& node);

  /// The same with TEXCOORD_0 in place of colours, and a material of its own with this picture, the bytes of a PNG file.
  void add(const PolygonMesh& mesh, const TextureCoordinates& coordinates, const std::string& png, const Node& node);

  /// The whole file. At least one mesh must have been added.
  [[nodiscard]] std::string bytes() const;

 private:
  enum class Use { vertices = 34962, triangles = 34963 };

  /// Appends an accessor and returns its number. `format` is its componentType and type, and what else it has.
  template <typename Number>
  int add_numbers(std::span<const Number> numbers, std::size_t count, Use use, const std::string& format);
  /// The number of a new view of these bytes; `target` is what it has besides its place.
  int add_view(std::string_view bytes, const std::string& target);
  /// `attribute` is one more member of the primitive's attributes, or empty.
  void add_mesh(const PolygonMesh& mesh, const Node& node, const std::string& attribute, int material);
  [[nodiscard]] std::string json() const;

  std::string numbers_;
  std::string views_;
  std::string accessors_;
  std::string images_;
  std::string materials_;
  std::string meshes_;
  std::string nodes_;
  int view_count_ = 0;
  int accessor_count_ = 0;
  int image_count_ = 0;
  int mesh_count_ = 0;
};

}  // namespace spherematch
