#include "engine/io/gltf.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "tests/engine/io/reading.h"
#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

namespace spherematch {
namespace {

using test::append_number;
using test::expect_refused;
using test::expect_same;
using test::glb_container;
using test::with;

constexpr ErrorCode malformed = ErrorCode::malformed_mesh;

PolygonMesh tetrahedron() { return test::polygons(test::tetrahedron()); }
/// glTF JSON of a tetrahedron, and its GLB file.
std::string json() { return test::gltf_json(4, 12, ""); }
std::string glb(const std::string& text) { return glb_container(text, test::gltf_buffer(tetrahedron())); }

/// The tetrahedron with one primitive whose indices are these, of this component type.
template <typename Index>
std::string glb_of_indices(const std::vector<Index>& indices, int component_type, int mode) {
  std::string buffer = test::gltf_buffer(tetrahedron()).substr(0, 48);
  for (const Index index : indices) append_number(buffer, index);
  const std::string length = std::to_string(indices.size() * sizeof(Index));
  std::string text = with(json(), R"("byteLength": 96)", R"("byteLength": )" + std::to_string(buffer.size()));
  text = with(text, R"("byteOffset": 48, "byteLength": 48)", R"("byteOffset": 48, "byteLength": )" + length);
  text = with(text, R"("componentType": 5125, "count": 12)",
              R"("componentType": )" + std::to_string(component_type) + R"(, "count": )" + std::to_string(indices.size()));
  return glb_container(with(text, R"("indices": 1)", R"("indices": 1, "mode": )" + std::to_string(mode)), buffer);
}

TEST(Gltf, ReadsBothContainers) {
  const PolygonMesh mesh = test::fit_for_every_format(test::creature(3));
  expect_same(read_gltf(test::gltf_file(mesh)), mesh);
  expect_same(read_gltf(test::glb_file(mesh)), mesh);
  expect_same(read_gltf(test::gltf_file(mesh).insert(0, "\xEF\xBB\xBF \n")), mesh);
  expect_same(read_gltf(with(test::gltf_file(mesh), "application/octet-stream", "application/gltf-buffer")), mesh);
  std::string filled_with_zeros = json();
  filled_with_zeros.append((4 - filled_with_zeros.size() % 4) % 4 + 4, '\0');
  expect_same(read_gltf(glb(filled_with_zeros)), tetrahedron());
}

TEST(Gltf, AppliesTransformsDownTheTree) {
  // Column-major matrix in the root, translation, rotation and scale in the child.
  const std::string text = with(json(), R"("nodes": [{"mesh": 0}])",
                                R"("nodes": [{"matrix": [0,2,0,0, -2,0,0,0, 0,0,2,0, 5,6,7,1], "children": [1]}, )"
                                R"({"mesh": 0, "translation": [1,2,3], "rotation": [0.5,0.5,0.5,0.5], "scale": [1,2,3]}])");
  Eigen::Matrix4d root;
  root << 0, -2, 0, 5, 2, 0, 0, 6, 0, 0, 2, 7, 0, 0, 0, 1;
  Eigen::Affine3d child = Eigen::Affine3d::Identity();
  child.translate(Eigen::Vector3d(1, 2, 3)).rotate(Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)).scale(Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix4d expected = root * child.matrix();
  const PolygonMesh mesh = read_gltf(glb(text));
  const PolygonMesh flat = tetrahedron();
  EXPECT_EQ(mesh.indices, flat.indices);
  for (Eigen::Index v = 0; v < 4; ++v) {
    const Eigen::Vector4d point = expected * Eigen::Vector4d(flat.vertices(v, 0), flat.vertices(v, 1), flat.vertices(v, 2), 1);
    EXPECT_LT((mesh.vertices.row(v).transpose() - point.head<3>()).norm(), 1e-12);
  }
}

TEST(Gltf, TurnsFacesRoundWhereANodeMirrors) {
  const PolygonMesh mesh = read_gltf(glb(with(json(), R"({"mesh": 0})", R"({"mesh": 0, "scale": [-1, 1, 1]})")));
  EXPECT_EQ(mesh.indices, (std::vector<std::int32_t>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}));
  EXPECT_EQ(mesh.vertices(1, 0), -1);
  // Mirrored twice is not mirrored.
  const std::string twice =
      with(json(), R"([{"mesh": 0}])", R"([{"scale": [1, -1, 1], "children": [1]}, {"mesh": 0, "scale": [-1, 1, 1]}])");
  EXPECT_EQ(read_gltf(glb(twice)).indices, tetrahedron().indices);
}

TEST(Gltf, RepeatsInstancesDepthFirst) {
  const std::string text = with(json(), R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])",
                                R"("scenes": [{"nodes": [3, 0]}], "nodes": [{"mesh": 0, "translation": [10,0,0], "children": [2, 1]}, )"
                                R"({"mesh": 0, "translation": [0,1,0]}, {"children": [4]}, {"mesh": 0, "translation": [40,0,0]}, )"
                                R"({"mesh": 0, "translation": [0,0,5]}])");
  const PolygonMesh mesh = read_gltf(glb(text));
  ASSERT_EQ(mesh.vertex_count(), 16);
  // Vertex 0 of the tetrahedron is the origin, so that it shows the translation: nodes 3, 0, 2 -> 4, 1.
  EXPECT_EQ(mesh.vertices.row(0), Eigen::RowVector3d(40, 0, 0));
  EXPECT_EQ(mesh.vertices.row(4), Eigen::RowVector3d(10, 0, 0));
  EXPECT_EQ(mesh.vertices.row(8), Eigen::RowVector3d(10, 0, 5));
  EXPECT_EQ(mesh.vertices.row(12), Eigen::RowVector3d(10, 1, 0));
  EXPECT_EQ(mesh.face_count(), 16);
  EXPECT_EQ(mesh.face(4)[0], 4);
}

TEST(Gltf, ChoosesTheScene) {
  const std::string scenes = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";
  const std::string nodes = R"("nodes": [{"mesh": 0, "translation": [1,0,0]}, {"mesh": 0, "translation": [2,0,0]}, {"children": [0]}])";
  const auto first_of = [&](const std::string& replacement) { return read_gltf(glb(with(json(), scenes, replacement))).vertices(0, 0); };
  EXPECT_EQ(first_of(R"("scene": 1, "scenes": [{"nodes": [2]}, {"nodes": [1]}], )" + nodes), 2);
  EXPECT_EQ(first_of(R"("scenes": [{"nodes": [2]}, {"nodes": [1]}], )" + nodes), 1);
  const PolygonMesh all = read_gltf(glb(with(json(), scenes, nodes)));
  ASSERT_EQ(all.vertex_count(), 8);
  EXPECT_EQ(all.vertices(0, 0), 2);
  EXPECT_EQ(all.vertices(4, 0), 1);
  expect_refused(malformed, "scene 2: there is no such scene", glb(with(json(), R"("scenes")", R"("scene": 2, "scenes")")));
}

TEST(Gltf, ReadsPrimitivesInOrderAndSkipsPointsAndLines) {
  const std::string primitive = R"({"attributes": {"POSITION": 0}, "indices": 1})";
  std::string primitives =
      R"({"attributes": {"POSITION": 0}, "mode": 0}, )" + primitive + R"(, {"attributes": {"POSITION": 0}, "mode": 3}, )";
  primitives += R"({"attributes": {"POSITION": 0, "NORMAL": 99}, "indices": 1, "material": 5, "targets": [{"POSITION": 7}]})";
  const PolygonMesh mesh = read_gltf(glb(with(json(), primitive, primitives)));
  EXPECT_EQ(mesh.vertex_count(), 8);
  EXPECT_EQ(mesh.face_count(), 8);
  EXPECT_EQ(mesh.face(4)[1], 6);
}

TEST(Gltf, ReadsEveryTypeOfIndex) {
  const std::vector<std::int32_t> indices = tetrahedron().indices;
  expect_same(read_gltf(glb_of_indices(std::vector<std::uint8_t>(indices.begin(), indices.end()), 5121, 4)), tetrahedron());
  expect_same(read_gltf(glb_of_indices(std::vector<std::uint16_t>(indices.begin(), indices.end()), 5123, 4)), tetrahedron());
  expect_same(read_gltf(glb_of_indices(std::vector<std::uint32_t>(indices.begin(), indices.end()), 5125, 4)), tetrahedron());
}

TEST(Gltf, ReadsStripsFansAndTrianglesWithoutIndices) {
  using Indices = std::vector<std::uint8_t>;
  const auto faces = [](const Indices& indices, int mode) { return read_gltf(glb_of_indices(indices, 5121, mode)).indices; };
  EXPECT_EQ(faces({0, 1, 2, 3}, 5), (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(faces({0, 1, 2, 3, 0}, 5), (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2, 2, 3, 0}));
  EXPECT_EQ(faces({0, 1, 2, 2, 3, 3, 1, 0}, 5), (std::vector<std::int32_t>{0, 1, 2, 3, 0, 1})) << "joined without area";
  EXPECT_EQ(faces({0, 1, 2, 3}, 6), (std::vector<std::int32_t>{1, 2, 0, 2, 3, 0}));
  EXPECT_EQ(faces({0, 1, 1}, 4), (std::vector<std::int32_t>{0, 1, 1})) << "a face without area stays";
  expect_refused(ErrorCode::degenerate, "no vertices or no faces", glb_of_indices(Indices{0, 1}, 5121, 5));
  const PolygonMesh strip = read_gltf(glb(with(json(), R"("indices": 1)", R"("mode": 5)")));
  EXPECT_EQ(strip.indices, (std::vector<std::int32_t>{0, 1, 2, 1, 3, 2}));
}

TEST(Gltf, ReadsSparsePositions) {
  std::string buffer = test::gltf_buffer(tetrahedron());
  for (const std::uint16_t index : std::array<std::uint16_t, 2>{1, 3}) append_number(buffer, index);
  for (const float value : {7.0F, 8.0F, 9.0F, -1.0F, -2.0F, -3.0F}) append_number(buffer, value);
  const std::string sparse = R"("sparse": {"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, )"
                             R"("values": {"bufferView": 2, "byteOffset": 4}})";
  std::string text = with(json(), R"("byteLength": 96)", R"("byteLength": 124)");
  text = with(text, R"("bufferViews": [)",
              R"("bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                                              {"buffer": 0, "byteOffset": 96, "byteLength": 28}, )");
  const std::string with_base = with(text, R"("type": "VEC3")", R"("type": "VEC3", )" + sparse);
  PolygonMesh expected = tetrahedron();
  expected.vertices.row(1) << 7, 8, 9;
  expected.vertices.row(3) << -1, -2, -3;
  expect_same(read_gltf(glb_container(with_base, buffer)), expected);
  expected.vertices.row(2).setZero();
  expect_same(read_gltf(glb_container(with(with_base, R"({"bufferView": 0, "componentType": 5126)", R"({"componentType": 5126)"), buffer)),
              expected);

  for (const auto& [from, to, message] : std::vector<std::array<const char*, 3>>{
           {R"("count": 2)", R"("count": 5)", "accessor 0: its sparse part has a wrong count"},
           {R"("count": 2)", R"("count": 0)", "accessor 0: its sparse part has a wrong count"},
           {R"("bufferView": 2, "componentType": 5123)", R"("bufferView": 9, "componentType": 5123)",
            "accessor 0: there is no buffer view 9"},
           {R"("componentType": 5123)", R"("componentType": 5126)", "accessor 0: indices cannot have the component type 5126"},
           {R"("byteOffset": 4)", R"("byteOffset": 8)", "accessor 0: it ends beyond buffer view 2"},
           {R"("byteOffset": 4)", R"("byteOffset": 2000000000)", "accessor 0: it ends beyond buffer view 2"},
           {R"("bufferView": 2, "componentType": 5123)", R"("bufferView": 2, "byteOffset": 4, "componentType": 5125)",
            "replaces element 1088421888 of 4"}})
    expect_refused(malformed, message, glb_container(with(with_base, from, to), buffer));
}

TEST(Gltf, ReadsQuantizedAndInterleavedPositions) {
  struct Case {
    int component_type;
    bool normalized;
    std::size_t size;
    std::array<double, 3> values;  ///< of the raw integers 0x00, 0x40, 0x80 in their highest byte, the others zero
  };
  for (const auto& [type, normalized, size, values] : std::vector<Case>{{5120, false, 1, {0, 64, -128}},
                                                                        {5120, true, 1, {0, 64.0 / 127, -1}},
                                                                        {5121, false, 1, {0, 64, 128}},
                                                                        {5121, true, 1, {0, 64.0 / 255, 128.0 / 255}},
                                                                        {5122, false, 2, {0, 16384, -32768}},
                                                                        {5122, true, 2, {0, 16384.0 / 32767, -1}},
                                                                        {5123, false, 2, {0, 16384, 32768}},
                                                                        {5123, true, 2, {0, 16384.0 / 65535, 32768.0 / 65535}}}) {
    std::string buffer(16, '\0');
    for (const char* corner : {"\0\x40\x80", "\x40\x80\0", "\x80\0\x40"}) {
      std::string element;
      for (std::size_t k = 0; k < 3; ++k) element += std::string(size - 1, '\0') + corner[k];
      buffer += element + std::string(12 - element.size(), '\xEE');
    }
    const std::string text = R"({"asset": {"version": "2.0"}, "extensionsRequired": ["KHR_mesh_quantization"], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "byteOffset": 8, "componentType": )" +
                             std::to_string(type) + R"(, "count": 3, "type": "VEC3", "normalized": )" + (normalized ? "true" : "false") +
                             R"(}], "bufferViews": [{"buffer": 0, "byteOffset": 8, "byteLength": 44, "byteStride": 12}],
        "buffers": [{"byteLength": 52}]})";
    const PolygonMesh mesh = read_gltf(glb_container(text, buffer));
    for (Eigen::Index v = 0; v < 3; ++v)
      for (Eigen::Index k = 0; k < 3; ++k)
        EXPECT_EQ(mesh.vertices(v, k), values[static_cast<std::size_t>((v + k) % 3)]) << type << normalized;
  }
}

TEST(Gltf, LooksAtNothingButGeometry) {
  const std::string image = R"("images": [{"uri": "../../etc/passwd"}, {"uri": "http://example.com/a.png"}, {"bufferView": 99}, {},
      {"uri": "data:image/png;base64,AAAA"}], "textures": 7, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
      "animations": [{"channels": [-1.5]}], "skins": [{"joints": [99]}], "cameras": {"x": null}, "extras": {"a": [1e5, -3, "\"}]"]},
      "extensions": {"KHR_lights_punctual": {"lights": [{"spot": 1}]}}, )";
  expect_same(read_gltf(glb(test::gltf_json(4, 12, "", image))), tetrahedron());
  std::string text =
      with(json(), R"({"mesh": 0})", R"({"name": "a \" \\", "mesh": 0, "skin": 4, "camera": 3, "weights": [0.5], "extras": -1})");
  text = with(text, R"("type": "VEC3")", R"("type": "VEC3", "min": [-1.5, 0, 0], "max": [1, 1, 1], "name": "p")");
  expect_same(read_gltf(glb(text)), tetrahedron());
}

TEST(Gltf, RefusesCompressedGeometry) {
  for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const std::string required = R"("extensionsUsed": [")" + name + R"("], "extensionsRequired": [")" + name + R"("], )";
    expect_refused(ErrorCode::compressed_geometry, name, glb(test::gltf_json(4, 12, "", required)));
    const std::string used = R"("extensionsUsed": [")" + name + R"("], )";
    const std::string with_fallback = test::gltf_json(4, 12, "", used);
    expect_same(read_gltf(glb(with_fallback)), tetrahedron());
    const std::string without_positions = with(with_fallback, R"({"bufferView": 0, "componentType")", R"({"componentType")");
    expect_refused(ErrorCode::compressed_geometry, name, glb(without_positions));
    const std::string without_indices = with(with_fallback, R"({"bufferView": 1, "componentType")", R"({"componentType")");
    expect_refused(ErrorCode::compressed_geometry, name, glb(without_indices));
  }
}

TEST(Gltf, RefusesRequiredExtensionsThatItDoesNotKnow) {
  const auto requiring = [](const std::string& name) {
    return glb(test::gltf_json(4, 12, "", R"("extensionsRequired": [")" + name + R"("], )"));
  };
  for (const char* name :
       {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp", "KHR_mesh_quantization", "KHR_lights_punctual"})
    expect_same(read_gltf(requiring(name)), tetrahedron());
  for (const char* name : {"EXT_mesh_gpu_instancing", "KHR_node_visibility", "VENDOR_thing", ""})
    expect_refused(ErrorCode::unsupported_format, "requires the glTF extension '" + std::string(name), requiring(name));
}

TEST(Gltf, RefusesBuffersInOtherFiles) {
  for (const char* uri :
       {"mesh.bin", "../../../etc/passwd", "/etc/passwd", "file:///etc/passwd", "http://127.0.0.1:1/x", "a%20b.bin", "~/x"}) {
    expect_refused(ErrorCode::external_reference, "a buffer is in another file", test::gltf_json(4, 12, uri));
    expect_refused(ErrorCode::external_reference, "a buffer is in another file", glb(test::gltf_json(4, 12, uri)));
  }
  expect_refused(ErrorCode::external_reference, "'mesh.bin'", test::gltf_json(4, 12, "mesh.bin"));
  const std::string data = test::base64(test::gltf_buffer(tetrahedron()));
  for (const std::string type : {"data:;base64,", "data:application/octet-stream,", "data:model/x;base64,"})
    expect_refused(malformed, "the data URI of a buffer", test::gltf_json(4, 12, type + data));
}

TEST(Gltf, RefusesOtherVersions) {
  for (const char* version : {"1.0", "3.0", "20"})
    expect_refused(ErrorCode::unsupported_format, std::string("glTF of version '") + version, glb(with(json(), "2.0", version)));
  expect_refused(ErrorCode::unsupported_format, "binary glTF of version 1", with(glb(json()), "glTF\x02", "glTF\x01"));
  expect_refused(ErrorCode::unsupported_format, "has no 'asset'", R"({"type": "FeatureCollection"})");
  expect_refused(ErrorCode::unsupported_format, "has no 'asset'", "{}");
}

TEST(Gltf, RefusesMalformedContainers) {
  const std::string whole = glb(json());
  const auto with_word = [&](std::size_t at, std::uint32_t word) {
    std::string bytes;
    append_number(bytes, word);
    return std::string(whole).replace(at, 4, bytes);
  };
  const auto json_length = static_cast<std::uint32_t>(json().size() + (4 - json().size() % 4) % 4);
  const std::string end = std::to_string(whole.size());
  expect_refused(malformed, "byte 4: the file ends where the version should be", "glTF");
  expect_refused(malformed, "byte 12: the file has " + end + " bytes, and should have 4294967295", with_word(8, 0xFFFFFFFF));
  expect_refused(malformed, "byte 12: the file has " + end + " bytes, and should have 0", with_word(8, 0));
  expect_refused(malformed, "byte 20: the file ends where the end of the JSON chunk should be", with_word(12, 0xFFFFFFFF));
  expect_refused(malformed, "byte 20: the first chunk is not JSON", with_word(16, 1));
  expect_refused(malformed, "the second chunk is not binary", with_word(24 + json_length, 1));
  // tinygltf accepts a binary chunk of up to eight bytes more than there are.
  for (const std::uint32_t more : {4U, 8U, 0x7FFFFFFCU})
    expect_refused(malformed, "the file ends where the end of the binary chunk should be", with_word(20 + json_length, 96 + more));
  expect_refused(malformed, "Insufficient Chunk1(BIN) data size", with_word(20 + json_length, 0));
  expect_refused(malformed, "byte 28: the second chunk is not binary", with_word(12, 0));
  expect_refused(malformed, "byte 20: the JSON text ends too early", glb_container("", ""));
}

TEST(Gltf, RefusesMalformedScenes) {
  struct Case {
    const char* from;
    const char* to;
    const char* message;
  };
  for (const auto& [from, to, message] : std::vector<Case>{
           {R"([{"mesh": 0}])", R"([{"mesh": 1}])", "node 0: there is no mesh 1"},
           {R"({"nodes": [0]})", R"({"nodes": [1]})", "scene 0: there is no node 1"},
           {R"({"nodes": [0]})", R"({"nodes": [0, 0]})", "node 0: it has two parents"},
           {R"({"mesh": 0})", R"({"mesh": 0, "children": [0]})", "node 0: it has two parents, or is among its own children"},
           {R"({"mesh": 0})", R"({"children": [1, 1]}, {"mesh": 0})", "node 1: it has two parents"},
           {R"({"mesh": 0})", R"({"children": [1]}, {"children": [2]}, {"children": [1]})", "node 1: it has two parents"},
           {R"({"mesh": 0})", R"({"mesh": 0, "children": [7]})", "node 0: there is no node 7"},
           {R"({"mesh": 0})", R"({"mesh": 0, "matrix": [1, 2]})", "node 0: its matrix needs 16 numbers"},
           {R"({"mesh": 0})", R"({"mesh": 0, "scale": [1, 2, 3, 4]})", "node 0: its scale needs 3 numbers"},
           {R"({"mesh": 0})", R"({"mesh": 0, "rotation": [0, 0, 0]})", "node 0: its rotation needs 4 numbers"},
           {R"({"mesh": 0})", R"({"mesh": 0, "rotation": [0, 0, 0, 0]})", "node 0: its rotation is zero"},
           {R"({"mesh": 0})", R"({"mesh": 0, "translation": [1]})", "node 0: its translation needs 3 numbers"},
           {R"({"mesh": 0})", R"({"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", "the last row of its matrix"},
           {R"({"mesh": 0})", R"({"mesh": 0, "scale": [1e308, 1e308, 1e308], "translation": [1e308, 0, 0]})", "a position is not finite"},
           {R"("indices": 1)", R"("indices": 1, "mode": 7)", "mesh 0: there is no mode 7"},
           {R"("POSITION": 0)", R"("NORMAL": 0)", "mesh 0: a primitive has no POSITION"},
           {R"("POSITION": 0)", R"("POSITION": 2)", "accessor 2: there is no such accessor"},
           {R"("POSITION": 0)", R"("POSITION": 1)", "accessor 1: positions must be of type VEC3"},
           {R"("indices": 1)", R"("indices": 0, "mode": 5)", "accessor 0: indices must be of type SCALAR"},
           {R"("indices": 1)", R"("indices": 2)", "indices accessor out of bounds"},
           {R"("indices": 1)", R"("mode": 4)", "mesh 0: a primitive has 4 corners, which make no triangles"},
           {R"("attributes": {"POSITION": 0})", R"("attributes": 0)", "'attributes' property is not an object"},
           {R"("count": 4)", R"("count": 0)", "accessor 0: it has no elements"},
           {R"("count": 4)", R"("count": 5)", "accessor 0: it ends beyond buffer view 0"},
           {R"("count": 4)", R"("count": 2)", "accessor 1: vertex index 2 is not in 0 to 1"},
           {R"("count": 12)", R"("count": 15)", "accessor 1: it ends beyond buffer view 1"},
           {R"("componentType": 5126)", R"("componentType": 5125)", "accessor 0: positions cannot have the component type 5125"},
           {R"("componentType": 5125)", R"("componentType": 5126)", "accessor 1: indices cannot have the component type 5126"},
           {R"("componentType": 5126)", R"("componentType": 5130)", "accessor 0: positions cannot have the component type 5130"},
           {R"("bufferView": 0, "c)", R"("bufferView": 2, "c)", "accessor 0: there is no buffer view 2"},
           {R"("bufferView": 0, "c)", R"("bufferView": 0, "byteOffset": 1, "c)", "accessor 0: it ends beyond buffer view 0"},
           {R"("bufferView": 0, "c)", R"("bufferView": 0, "byteOffset": 2147483647, "c)", "accessor 0: it ends beyond buffer view 0"},
           {R"("bufferView": 0, "c)", R"("c)", "accessor 0: it has no data"},
           {R"({"buffer": 0, "byteLength": 48})", R"({"buffer": 1, "byteLength": 48})", "buffer view 0: there is no buffer 1"},
           {R"({"buffer": 0, "byteLength": 48})", R"({"buffer": 0, "byteLength": 97})", "buffer view 0: it ends beyond its buffer"},
           {R"({"buffer": 0, "byteLength": 48})", R"({"buffer": 0, "byteOffset": 49, "byteLength": 48})",
            "buffer view 0: it ends beyond its buffer"},
           {R"({"buffer": 0, "byteLength": 48})", R"({"buffer": 0, "byteLength": 48, "byteStride": 8})",
            "buffer view 0: its stride is smaller"},
           {R"({"buffer": 0, "byteLength": 48})", R"({"buffer": 0, "byteLength": 48, "byteStride": 16})", "accessor 0: it ends beyond"},
           {R"([{"byteLength": 96}])", R"([{"byteLength": 97}])", "Invalid `byteLength'"},
           {R"([{"byteLength": 96}])", R"([{"byteLength": 0}])", "not valid glTF"},
           {R"([{"byteLength": 96}])", R"([{"byteLength": 96}, {"byteLength": 96}])", "more than one buffer has no 'uri'"},
       })
    expect_refused(malformed, message, glb(with(json(), from, to)));
}

TEST(Gltf, RefusesPositionsThatAreNotFinite) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::string number;
    append_number(number, value);
    expect_refused(malformed, "accessor 0: a position is not finite",
                   glb_container(json(), test::gltf_buffer(tetrahedron()).replace(16, 4, number)));
  }
}

TEST(Gltf, RefusesDamagedDataUris) {
  const std::string type = "data:application/octet-stream;base64,";
  const std::string data = test::base64(test::gltf_buffer(tetrahedron()));
  expect_same(read_gltf(test::gltf_json(4, 12, type + data)), tetrahedron());
  for (const std::string& damaged : {data.substr(4), data + "AAAA", data.substr(0, 40) + "*" + data.substr(41), std::string()})
    expect_refused(malformed, "not valid glTF: 'Failed to decode", test::gltf_json(4, 12, type + damaged));
  expect_refused(malformed, "'uri' is missing", json());
}

TEST(Gltf, CountsInstancesBeforeItAllocates) {
  std::string nodes = R"("nodes": [{"mesh": 0})";
  std::string roots = R"("nodes": [0)";
  for (int i = 1; i < 1000; ++i) {
    nodes += R"(, {"mesh": 0})";
    roots += ", " + std::to_string(i);
  }
  const std::string bytes = glb(with(with(json(), R"("nodes": [{"mesh": 0})", nodes), R"("nodes": [0)", roots));
  EXPECT_EQ(test::read(bytes, "", {.max_vertices = 4000}).vertex_count(), 4000);
  expect_refused(ErrorCode::too_many_vertices, "has 4000 vertices; the limit is 3999", bytes, "", {.max_vertices = 3999});

  // One accessor of 36 corners in each of a hundred primitives
  std::vector<std::uint8_t> corners(36, 0);
  std::string primitives = R"({"attributes": {"POSITION": 0}, "indices": 1, "mode": 4})";
  for (int i = 1; i < 100; ++i) primitives += R"(, {"attributes": {"POSITION": 0}, "indices": 1})";
  std::string text = glb_of_indices(corners, 5121, 4);
  text = text.substr(20, text.find("BIN") - 24);
  const std::string buffer = test::gltf_buffer(tetrahedron()).substr(0, 48) + std::string(36, '\0');
  const std::string heavy = glb_container(with(text, R"({"attributes": {"POSITION": 0}, "indices": 1, "mode": 4})", primitives), buffer);
  EXPECT_EQ(test::read(heavy, "", {.max_vertices = 400}).indices.size(), 3600U);
  std::string heavier = glb_container(
      with(text, R"({"attributes": {"POSITION": 0}, "indices": 1, "mode": 4})", with(primitives, R"("mode": 4)", R"("mode": 5)")), buffer);
  EXPECT_EQ(test::read(heavier, "", {.max_vertices = 400}).indices.size(), 3564U);
  const std::string only_strips = with(text, R"("mode": 4)", R"("mode": 5)");
  expect_refused(ErrorCode::too_many_vertices, "mesh 0: the faces have more than 48 corners", glb_container(only_strips, buffer), "",
                 {.max_vertices = 4});
}

TEST(Gltf, ReadsDeepTreesWithoutRecursion) {
  std::string nodes = R"("nodes": [)";
  constexpr int depth = 20000;
  for (int i = 0; i + 1 < depth; ++i) nodes += R"({"children": [)" + std::to_string(i + 1) + R"(], "translation": [1, 0, 0]}, )";
  const PolygonMesh mesh = read_gltf(glb(with(json(), R"("nodes": [{"mesh": 0})", nodes + R"({"mesh": 0})")));
  EXPECT_EQ(mesh.vertices(0, 0), depth - 1);
}

}  // namespace
}  // namespace spherematch
