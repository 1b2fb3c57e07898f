// A binary glTF 2.0 file, put together mesh by mesh. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "engine/io/map_mesh.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

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

  /// The whole file. At least one mesh must have been added.
  [[nodiscard]] std::string bytes() const;

 private:
  enum class Use { vertices = 34962, triangles = 34963 };

  /// Appends an accessor and returns its number. `format` is its componentType and type, and what else it has.
  template <typename Number>
  int add_numbers(std::span<const Number> numbers, std::size_t count, Use use, const std::string& format);
  [[nodiscard]] std::string json() const;

  std::string numbers_;
  std::string views_;
  std::string accessors_;
  std::string meshes_;
  std::string nodes_;
  int accessor_count_ = 0;
  int mesh_count_ = 0;
};

}  // namespace spherematch
