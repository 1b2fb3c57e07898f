#include "samples/holes.h"

#include <algorithm>

namespace spherematch::samples {

Cut cut_holes(const Mesh& mesh, const std::vector<Ball>& balls) {
  Cut cut;
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles) {
    if (std::any_of(t.begin(), t.end(), [&](int v) { return is_in(balls, mesh.vertices[static_cast<std::size_t>(v)]); })) continue;
    cut.triangles.push_back(t);
    for (const int v : t) used[static_cast<std::size_t>(v)] = true;
  }
  cut.new_number.assign(mesh.vertices.size(), -1);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    cut.new_number[v] = static_cast<int>(cut.kept.size());
    cut.kept.push_back(static_cast<int>(v));
  }
  for (Triangle& t : cut.triangles)
    for (int& v : t) v = cut.new_number[static_cast<std::size_t>(v)];
  return cut;
}

}  // namespace spherematch::samples
