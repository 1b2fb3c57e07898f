#include "engine/io/map_format.h"

#include <array>
#include <utility>

#include "engine/io/map_mesh.h"
#include "engine/io/map_picture.h"
#include "engine/io/map_writer.h"

namespace spherematch {

namespace {

constexpr std::array<std::pair<std::string_view, MapFormat>, 8> formats{{
    {"npz", MapFormat::npz},
    {"npy", MapFormat::npy},
    {"txt", MapFormat::text},
    {"map", MapFormat::list_from_one},
    {"ply", MapFormat::ply},
    {"glb", MapFormat::glb},
    {"obj", MapFormat::obj},
    {"png", MapFormat::png},
}};

std::string encode_ply(PolygonMesh source_mesh, const Correspondence& map, const Surface& target, VertexQuality quality) {
  MapMesh painted = paint_mesh(std::move(source_mesh), map, target);
  painted.quality = std::move(quality);
  return encode_ply(painted);
}

}  // namespace

std::vector<std::string_view> map_format_names() {
  std::vector<std::string_view> names;
  names.reserve(formats.size());
  for (const auto& [name, format] : formats) names.push_back(name);
  return names;
}

std::optional<MapFormat> map_format_of(std::string_view name) {
  for (const auto& [known, format] : formats) {
    if (known == name) return format;
  }
  return std::nullopt;
}

bool needs_source_mesh(MapFormat format) { return format == MapFormat::ply || format == MapFormat::glb || format == MapFormat::obj; }

bool needs_surfaces(MapFormat format) { return needs_source_mesh(format) || format == MapFormat::png; }

bool holds_quality(MapFormat format) { return format == MapFormat::npz || format == MapFormat::ply; }

std::string encode_map(MapFormat format, const Correspondence& map, const Surface& source, const Surface& target, PolygonMesh source_mesh,
                       VertexQuality quality) {
  switch (format) {
    case MapFormat::npz:
      return encode_npz(map, quality);
    case MapFormat::npy:
      return encode_npy(map);
    case MapFormat::text:
      return encode_text(map);
    case MapFormat::list_from_one:
      return encode_list_from_one(map);
    case MapFormat::ply:
      return encode_ply(std::move(source_mesh), map, target, std::move(quality));
    case MapFormat::glb:
      return encode_glb(paint_mesh(std::move(source_mesh), map, target));
    case MapFormat::obj:
      return encode_obj(paint_mesh(std::move(source_mesh), map, target));
    case MapFormat::png:
      return encode_png(map, source, target);
  }
  return {};
}

}  // namespace spherematch
