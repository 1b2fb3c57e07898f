// A software renderer: painted triangles to an anti-aliased image, by z-buffer. Internal to engine/io.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/data/tri_mesh.h"
#include "engine/io/camera.h"

namespace spherematch {

enum class Background { white, transparent };

/// Red, green, blue, and on a transparent background alpha; colours are not multiplied by it. Row by row from the top left.
struct Image {
  int width = 0;
  int height = 0;
  Background background;
  std::vector<std::uint8_t> pixels;  ///< channels() * width * height

  /// All background.
  Image(int w, int h, Background behind = Background::white);
  [[nodiscard]] int channels() const { return background == Background::white ? 3 : 4; }
  [[nodiscard]] std::uint8_t* at(int x, int y) {
    return pixels.data() + static_cast<std::size_t>(channels()) *
                               (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// What the numbers of a scene's paint are.
enum class Paint {
  color,   ///< red, green, blue in [0, 1]; NaN for neutral gray
  checker  ///< texture coordinates u, v in the first two columns, shown as checker_color(); NaN for neutral gray
};

/// Red, green, blue in [0, 1] of a checkerboard of eight by eight fields over the unit square, which repeats beyond it. The hue
/// changes with u and the brightness with v, so that no two fields look alike.
[[nodiscard]] Eigen::Vector3f checker_color(float u, float v);

struct Scene {
  const TriMesh& mesh;
  const Points& paint;  ///< per vertex
  ViewAxes axes;
  Eigen::Vector3d center;  ///< the point in the middle of the picture
  double pixels_per_unit = 1;
  Paint kind = Paint::color;
  bool two_sided = false;  ///< also faces that look away, lit from behind; else the mesh is taken for closed, facing outward
};

/// Draws the scene, orthographic, into the square part of the image whose left end is at `left`; as high as the image.
void render(const Scene& scene, Image& image, int left);

}  // namespace spherematch
