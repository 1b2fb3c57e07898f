// A software renderer: painted triangles to an anti-aliased image, by z-buffer. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/io/camera.h"

namespace spherematch {

/// Red, green, blue, row by row from the top left.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< 3 * width * height

  Image(int w, int h);
  [[nodiscard]] std::uint8_t* at(int x, int y) {
    return pixels.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

struct Scene {
  const TriMesh& mesh;  ///< closed, facing outward
  const Points& paint;  ///< per vertex: colour in [0, 1]^3; NaN for neutral gray
  ViewAxes axes;
  Eigen::Vector3d center;  ///< the point in the middle of the picture
  double pixels_per_unit = 1;
};

/// Draws the scene, orthographic, into the square part of the image whose left end is at `left`; as high as the image.
void render(const Scene& scene, Image& image, int left);

}  // namespace spherematch
