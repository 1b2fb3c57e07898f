// The files of a sample, as bytes that depend on the arguments alone.
#pragma once

#include <string>
#include <vector>

#include "samples/surface_mesh.h"

namespace spherematch::samples {

/// A coordinate with two decimals, "-12.3" for -12.30; no "-0".
[[nodiscard]] std::string decimal(double coordinate);

/// OFF as text: the header line "OFF", counts, positions with two decimals, triangles.
[[nodiscard]] std::string off_file(const Mesh& mesh);

/// Binary glTF 2.0 with one mesh: positions as float32, indices as uint16.
/// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
/// @throws std::invalid_argument for more vertices than a uint16 can number
[[nodiscard]] std::string glb_file(const Mesh& mesh, const std::string& name);

/// One vertex a line, counted from 1.
[[nodiscard]] std::string vts_file(const std::vector<int>& vertices);

}  // namespace spherematch::samples
