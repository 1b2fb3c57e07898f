// What the pictures of shapes and of maps have in common. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <string>

#include "engine/data/tri_mesh.h"
#include "engine/io/renderer.h"

namespace spherematch {

/// A third of the area round each vertex.
[[nodiscard]] Eigen::VectorXd vertex_areas(const TriMesh& mesh);

/// The mesh moved to the origin and scaled to unit area. Its area must be positive; coordinates may be of any finite size.
[[nodiscard]] TriMesh with_unit_area(const TriMesh& mesh);

/// Puts the middle of what is seen into the middle of the picture; returns the larger side of what is seen.
double center_view(Scene& scene);

/// The image as the bytes of a PNG file. @throws std::runtime_error when there is no memory
[[nodiscard]] std::string png_of(const Image& image);

}  // namespace spherematch
