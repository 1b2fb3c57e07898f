// A libFuzzer target over the reader of every format: any bytes end in a mesh that keeps its promises or in an EngineError.
#include <cstdint>
#include <cstdlib>

#include "engine/data/error.h"
#include "engine/io/mesh_reader.h"

using namespace spherematch;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The first byte chooses the name, so that readers also see what they would not recognise.
  constexpr const char* names[] = {"", "a.off", "a.obj", "a.ply", "a.stl", "a.gltf", "a.glb"};
  if (size == 0) return 0;
  try {
    const ReadLimits limits{.max_vertices = 10'000};
    const PolygonMesh mesh = read_mesh(std::as_bytes(std::span(data + 1, size - 1)), names[data[0] % std::size(names)], limits);
    require(mesh.vertices.allFinite() && mesh.vertex_count() <= limits.max_vertices);
    require(mesh.face_count() >= 1 && mesh.offsets.front() == 0);
    require(static_cast<std::size_t>(mesh.offsets.back()) == mesh.indices.size());
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
      require(mesh.offsets[static_cast<std::size_t>(f) + 1] - mesh.offsets[static_cast<std::size_t>(f)] >= 3);
    for (const std::int32_t index : mesh.indices) require(index >= 0 && index < mesh.vertex_count());
  } catch (const EngineError&) {
    // as it should be
  }
  return 0;
}
