#include "engine/io/mesh_reader.h"

#include <algorithm>
#include <array>

#include "engine/data/error.h"
#include "engine/io/gltf.h"
#include "engine/io/obj.h"
#include "engine/io/off.h"
#include "engine/io/ply.h"
#include "engine/io/stl.h"

namespace spherematch {

namespace {

/// One row per format; a format is tried by content in this order, then by the extension of the name.
struct Format {
  std::string_view extension;
  bool (*recognises)(std::string_view text);
  PolygonMesh (*read)(std::string_view text, const ReadLimits& limits);
};

bool is_glb(std::string_view text) { return text.starts_with("glTF"); }

// OBJ comes last, for it is recognised by its statements and not by a signature.
constexpr std::array formats{Format{".ply", is_ply, read_ply}, Format{".glb", is_glb, read_gltf}, Format{".gltf", is_gltf, read_gltf},
                             Format{".off", is_off, read_off}, Format{".stl", is_stl, read_stl},  Format{".obj", is_obj, read_obj}};

/// What people upload by mistake, by its first bytes.
struct Stranger {
  std::string_view signature;
  std::string_view description;
};

using namespace std::string_view_literals;
constexpr std::array strangers{Stranger{"\x1F\x8B"sv, "is compressed with gzip; upload it unpacked"},
                               Stranger{"PK\x03\x04"sv, "is a zip archive; upload the mesh in it"},
                               Stranger{"BZh"sv, "is compressed with bzip2; upload it unpacked"},
                               Stranger{"\xFD\x37zXZ\0"sv, "is compressed with xz; upload it unpacked"},
                               Stranger{"\x28\xB5\x2F\xFD"sv, "is compressed with zstd; upload it unpacked"},
                               Stranger{"7z\xBC\xAF\x27\x1C"sv, "is a 7z archive; upload the mesh in it"},
                               Stranger{"Kaydara FBX Binary"sv, "is FBX"},
                               Stranger{"; FBX"sv, "is FBX"},
                               Stranger{"BLENDER"sv, "is a Blender scene"},
                               Stranger{"# vtk DataFile"sv, "is VTK"},
                               Stranger{"#VRML"sv, "is VRML"},
                               Stranger{"ISO-10303-21"sv, "is STEP"},
                               Stranger{"<"sv, "is XML or HTML"},
                               Stranger{"\xFF\xFE"sv, "is text in UTF-16; save it as ASCII or UTF-8"},
                               Stranger{"\xFE\xFF"sv, "is text in UTF-16; save it as ASCII or UTF-8"},
                               Stranger{"\x89PNG"sv, "is an image"},
                               Stranger{"\xFF\xD8\xFF"sv, "is an image"},
                               Stranger{"%PDF"sv, "is PDF"}};

constexpr std::string_view supported = "OFF, OBJ, PLY, STL, glTF and GLB are supported";

bool ends_with_ignoring_case(std::string_view name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(extension.begin(), extension.end(), name.end() - static_cast<std::ptrdiff_t>(extension.size()),
                    [&](char e, char n) { return e == lower(n); });
}

const Stranger* stranger_of(std::string_view text) {
  const auto* const found =
      std::find_if(strangers.begin(), strangers.end(), [&](const Stranger& s) { return text.starts_with(s.signature); });
  return found == strangers.end() ? nullptr : found;
}

const Format* format_of(std::string_view text, std::string_view name) {
  for (const Format& format : formats)
    if (format.recognises(text)) return &format;
  if (stranger_of(text) != nullptr) return nullptr;
  for (const Format& format : formats)
    if (ends_with_ignoring_case(name, format.extension)) return &format;
  return nullptr;
}

std::string_view text_of(std::span<const std::byte> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

PolygonMesh read_mesh(std::span<const std::byte> bytes, std::string_view name, const ReadLimits& limits) {
  if (bytes.empty()) throw EngineError(ErrorCode::malformed_mesh, "the mesh file is empty");
  const std::string_view text = text_of(bytes);
  if (const Format* format = format_of(text, name)) return format->read(text, limits);
  if (const Stranger* stranger = stranger_of(text))
    throw EngineError(ErrorCode::unsupported_format, "the file " + std::string(stranger->description) + ". " + std::string(supported));
  throw EngineError(ErrorCode::unsupported_format, "the format of the mesh file is not recognised; " + std::string(supported));
}

std::string_view mesh_format_of(std::span<const std::byte> bytes, std::string_view name) {
  const Format* format = format_of(text_of(bytes), name);
  return format == nullptr ? std::string_view() : format->extension.substr(1);
}

}  // namespace spherematch
