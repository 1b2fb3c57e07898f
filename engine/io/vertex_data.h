// What is known at the vertices of a mesh, for the eye and for mesh files: colours, texture coordinates, labels, values, weights.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/correspondence.h"
#include "engine/io/array.h"
#include "engine/io/map_mesh.h"
#include "engine/io/polygon_mesh.h"

namespace spherematch {

/// What the columns of an array are.
enum class Meaning {
  color,    ///< red, green, blue and perhaps alpha, which is ignored: uint8, or floating-point from 0 to 1
  texture,  ///< u, v: floating-point, v upward as OBJ and PLY have it
  label,    ///< one integer or boolean; -1 and other negative ones for none
  value,    ///< one number, shown from dark to light between the least and the largest
  weights   ///< a share for each bone, up to most_weights: shown as the mean of a colour for each
};

inline constexpr Eigen::Index most_weights = 64;

/// "color", "texture", "label", "value", "weights"; nothing for another name.
[[nodiscard]] std::optional<Meaning> meaning_named(std::string_view name);

/// What an array most likely is: one column of integers label, of floating-point numbers value; two of floating-point texture; three
/// color, and more weights; three or four of uint8 color.
/// @throws EngineError(invalid_parameter) for any other
[[nodiscard]] Meaning likely_meaning(const Array& array);

/// @throws EngineError(invalid_parameter) where the array cannot mean that
void check_meaning(Meaning meaning, const Array& array);

/// Rows are vertices.
struct VertexData {
  Meaning meaning = Meaning::value;
  Eigen::MatrixXd numbers;  ///< (n, columns): the array's
  Points paint;             ///< (n, 3): colours in [0, 1]; of texture u, v, 0; NaN where there is nothing to see

  /// The paint as bytes, neutral gray for NaN. Not for texture.
  [[nodiscard]] Colors colors() const;
};

/// Of an array at the target's vertices, and of what transfer() made of it for the source's: colours that stand for numbers mean the
/// same on both. What `map` has no image for is not painted.
struct VertexDataPair {
  VertexData source;
  VertexData target;
};
/// @throws EngineError(invalid_parameter) where the array cannot mean that, std::invalid_argument when the numbers of rows of `carried`
/// and of the map differ
[[nodiscard]] VertexDataPair vertex_data(Meaning meaning, const Array& carried, const Array& original, const Correspondence& map);

// Mesh files: the mesh as uploaded and its data. The bytes depend on the arguments alone.
// @throws std::invalid_argument when mesh and data differ in their number of vertices

/// Binary little-endian PLY: x y z, and red green blue unless the data are texture coordinates; those as s t and texture_u texture_v,
/// for Blender and three.js and for MeshLab; a label as int `label`, a value as `quality`, weights as `weight_0`, `weight_1`, ...
[[nodiscard]] std::string encode_ply(const PolygonMesh& mesh, const VertexData& data);

/// glTF 2.0 in one binary file: POSITION, NORMAL and COLOR_0 in linear light, or in its place TEXCOORD_0 with a checkerboard as the
/// texture's picture, polygons triangulated. Texture coordinates of vertices that have none are 0.
[[nodiscard]] std::string encode_glb(const PolygonMesh& mesh, const VertexData& data);

}  // namespace spherematch
