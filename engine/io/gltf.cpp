#include "engine/io/gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string>

#include "engine/data/error.h"
#include "engine/io/byte_reader.h"
#include "engine/io/gltf_json.h"
#include "engine/io/gltf_scene.h"
#include "engine/io/text_scanner.h"

namespace spherematch {

namespace {

constexpr std::string_view glb_signature = "glTF";
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;
constexpr std::size_t json_start = 20;

constexpr std::array<std::string_view, 3> compressions{"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"};
/// Extensions that leave positions and faces what they are without them, or that the accessors' reader knows.
constexpr std::array<std::string_view, 11> harmless_prefixes{"KHR_mesh_quantization", "KHR_materials_",   "KHR_texture_", "KHR_lights_",
                                                             "KHR_animation_pointer", "KHR_xmp",          "EXT_texture_", "EXT_lights_",
                                                             "MSFT_texture_",         "ADOBE_materials_", "KHR_audio"};

/// What tinygltf said and saw.
struct Outcome {
  tinygltf::Model model;
  bool loaded = false;
  std::string error;
  bool asked_for_file = false;
  std::string file;  ///< the first that it asked for
};

std::string remember_file(const std::string& name, void* user_data) {
  auto& outcome = *static_cast<Outcome*>(user_data);
  if (!outcome.asked_for_file) outcome.file = name;
  outcome.asked_for_file = true;
  return name;
}
bool find_no_file(const std::string& /*name*/, void* /*user_data*/) { return false; }
bool read_no_file(std::vector<unsigned char>* /*content*/, std::string* /*error*/, const std::string& /*name*/, void* /*user_data*/) {
  return false;
}
bool write_no_file(std::string* /*error*/, const std::string& /*name*/, const std::vector<unsigned char>& /*content*/,
                   void* /*user_data*/) {
  return false;
}
bool load_no_image(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/, std::string* /*warning*/, int /*width*/,
                   int /*height*/, const unsigned char* /*bytes*/, int /*size*/, void* /*user_data*/) {
  return true;
}

/// The length of the JSON chunk. tinygltf 2.7 lets the binary chunk end eight bytes beyond the file.
std::size_t check_container(std::string_view file) {
  ByteReader reader(file);
  reader.skip(glb_signature.size(), "the signature");
  const auto version = reader.read<std::uint32_t>("the version");
  if (version != 2)
    throw EngineError(ErrorCode::unsupported_format, "binary glTF of version " + std::to_string(version) + " is not supported; 2 is");
  const auto length = reader.read<std::uint32_t>("the length of the file");
  if (length != file.size())
    reader.fail("the file has " + std::to_string(file.size()) + " bytes, and should have " + std::to_string(length));
  const auto json_length = reader.read<std::uint32_t>("the length of the JSON chunk");
  if (reader.read<std::uint32_t>("the type of the JSON chunk") != json_chunk) reader.fail("the first chunk is not JSON");
  reader.skip(json_length, "the end of the JSON chunk");
  if (reader.remaining() == 0) return json_length;
  const auto binary_length = reader.read<std::uint32_t>("the length of the binary chunk");
  if (reader.read<std::uint32_t>("the type of the binary chunk") != binary_chunk) reader.fail("the second chunk is not binary");
  reader.skip(binary_length, "the end of the binary chunk");
  return json_length;
}

/// Never throws for what is in the file, but when memory runs out.
void load(const std::string& file, bool binary, Outcome& outcome) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({find_no_file, remember_file, read_no_file, write_no_file, &outcome});
  loader.SetImageLoader(load_no_image, nullptr);
  std::string warning;
  const auto size = static_cast<unsigned int>(file.size());
  try {
    outcome.loaded = binary ? loader.LoadBinaryFromMemory(&outcome.model, &outcome.error, &warning,
                                                          reinterpret_cast<const unsigned char*>(file.data()), size)
                            : loader.LoadASCIIFromString(&outcome.model, &outcome.error, &warning, file.data(), size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
}

bool is_compression(const std::string& name) { return std::find(compressions.begin(), compressions.end(), name) != compressions.end(); }

[[noreturn]] void refuse_compression(const std::string& name) {
  throw EngineError(ErrorCode::compressed_geometry,
                    "the geometry is compressed with " + name + "; export it again without compression, or unpack it");
}

void check_required_extensions(const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired) {
    if (is_compression(name)) refuse_compression(name);
    const bool harmless =
        std::any_of(harmless_prefixes.begin(), harmless_prefixes.end(), [&](std::string_view prefix) { return name.starts_with(prefix); });
    if (!harmless) throw EngineError(ErrorCode::unsupported_format, "the file requires the glTF extension " + quoted(name, 64));
  }
}

/// Where compression is not required, the file may hold the same geometry uncompressed. It does not when that is missing.
void check_compression(const Outcome& outcome) {
  const std::vector<std::string>& used = outcome.model.extensionsUsed;
  const auto compression = std::find_if(used.begin(), used.end(), is_compression);
  if (compression == used.end()) return;
  const std::vector<tinygltf::Accessor>& accessors = outcome.model.accessors;
  const bool missing = std::any_of(accessors.begin(), accessors.end(),
                                   [](const tinygltf::Accessor& accessor) { return accessor.bufferView < 0 && !accessor.sparse.isSparse; });
  if (!outcome.loaded || missing) refuse_compression(*compression);
}

void check_outcome(const Outcome& outcome) {
  const std::string& version = outcome.model.asset.version;
  if (!version.empty() && !version.starts_with("2."))
    throw EngineError(ErrorCode::unsupported_format, "glTF of version " + quoted(version) + " is not supported; 2.0 is");
  check_required_extensions(outcome.model);
  check_compression(outcome);
  if (outcome.file.starts_with("data:"))
    throw EngineError(ErrorCode::malformed_mesh, "the data URI of a buffer is not of the type application/octet-stream in base64");
  if (!outcome.file.empty())
    throw EngineError(ErrorCode::external_reference, "a buffer is in another file, " + quoted(outcome.file, 64) +
                                                         "; only the uploaded file is read, so put its buffers into it, as GLB does");
  // What it skips with an error, such as a primitive without attributes, would be missing from the mesh.
  if (!outcome.loaded || !outcome.error.empty()) {
    constexpr std::size_t longest = 160;
    throw EngineError(ErrorCode::malformed_mesh, "not valid glTF: " + quoted(outcome.error.substr(0, outcome.error.find('\n')), longest));
  }
}

}  // namespace

bool is_gltf(std::string_view text) {
  return text.starts_with(glb_signature) || TextScanner(without_byte_order_mark(text)).word().starts_with('{');
}

PolygonMesh read_gltf(std::string_view text, const ReadLimits& limits) {
  // tinygltf measures in int.
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw EngineError(ErrorCode::unsupported_format, "glTF files of 2 GiB and more are not supported");
  const bool binary = text.starts_with(glb_signature);
  const std::string_view content = binary ? text : without_byte_order_mark(text);
  const std::size_t start = binary ? json_start : 0;
  const std::size_t json_length = binary ? check_container(content) : content.size();
  std::string file(content);
  reduce_gltf_json(std::span(file).subspan(start, json_length), start + text.size() - content.size(), text.size());
  Outcome outcome;
  load(file, binary, outcome);
  check_outcome(outcome);
  return read_gltf_scene(outcome.model, limits);
}

}  // namespace spherematch
