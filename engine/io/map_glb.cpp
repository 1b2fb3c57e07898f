#include "engine/io/glb_file.h"
#include "engine/io/map_mesh.h"

namespace spherematch {

std::string encode_glb(const MapMesh& painted) {
  GlbFile file;
  file.add(painted.mesh, &painted.colors, {});
  return file.bytes();
}

}  // namespace spherematch
