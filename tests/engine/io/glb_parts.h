// A GLB file taken apart by hand.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spherematch::test {

/// A file that fulfils what the specification says of containers, views and accessors.
struct Glb {
  using Json = nlohmann::json;

  Json json;
  std::string bytes;
  std::size_t mesh = 0;  ///< that the functions speak of

  explicit Glb(const std::string& file) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, file.substr(at, 4).data(), 4);
      return value;
    };
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), file.size());
    const std::uint32_t text = word(12);
    EXPECT_EQ(text % 4, 0U);
    EXPECT_EQ(file.substr(16, 4), "JSON");
    const std::uint32_t binary = word(20 + text);
    EXPECT_EQ(binary % 4, 0U);
    EXPECT_EQ(file.substr(24 + text, 4), std::string("BIN\0", 4));
    EXPECT_EQ(28U + text + binary, file.size());
    json = Json::parse(file.substr(20, text));
    bytes = file.substr(28 + text);
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_LE(json["buffers"][0]["byteLength"].get<std::size_t>(), bytes.size());
    EXPECT_LT(bytes.size() - json["buffers"][0]["byteLength"].get<std::size_t>(), 4U);
    for (const Json& view : json["bufferViews"]) {
      EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
      EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), bytes.size());
    }
  }

  [[nodiscard]] const Json& primitive() const { return json["meshes"][mesh]["primitives"][0]; }
  [[nodiscard]] const Json& accessor(const std::string& attribute) const {
    return json["accessors"][(attribute == "indices" ? primitive()["indices"] : primitive()["attributes"][attribute]).get<std::size_t>()];
  }
  /// Its numbers, which fill its view.
  template <typename Number>
  [[nodiscard]] std::vector<Number> numbers(const std::string& attribute, const std::string& type, int component, std::size_t width) const {
    const Json& a = accessor(attribute);
    EXPECT_EQ(a["type"], type);
    EXPECT_EQ(a["componentType"], component);
    const Json& view = json["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<Number> result(a["count"].get<std::size_t>() * width);
    EXPECT_EQ(view["byteLength"], result.size() * sizeof(Number));
    EXPECT_EQ(view["target"], attribute == "indices" ? 34963 : 34962);
    std::memcpy(result.data(), bytes.data() + view["byteOffset"].get<std::size_t>(), result.size() * sizeof(Number));
    return result;
  }
  [[nodiscard]] std::vector<float> positions() const { return numbers<float>("POSITION", "VEC3", 5126, 3); }
  [[nodiscard]] std::vector<float> normals() const { return numbers<float>("NORMAL", "VEC3", 5126, 3); }
  [[nodiscard]] std::vector<std::uint8_t> colors() const { return numbers<std::uint8_t>("COLOR_0", "VEC4", 5121, 4); }
  [[nodiscard]] std::vector<std::uint32_t> indices() const { return numbers<std::uint32_t>("indices", "SCALAR", 5125, 1); }
};

}  // namespace spherematch::test
