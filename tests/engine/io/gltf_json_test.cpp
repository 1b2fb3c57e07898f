#include "engine/io/gltf_json.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/data/error.h"

namespace spherematch {
namespace {

std::string reduced(std::string text) {
  reduce_gltf_json(std::span(text), 0, text.size());
  return text;
}

std::string refusal_of(std::string text, std::size_t offset = 0) {
  try {
    reduce_gltf_json(std::span(text), offset, text.size());
  } catch (const EngineError& error) {
    return error.what();
  }
  return "";
}

/// Without the blanks.
std::string packed(std::string text) {
  std::erase(text, ' ');
  return text;
}

TEST(GltfJson, KeepsWhatGeometryNeedsByteForByte) {
  const std::string text = R"( {"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
    "nodes":[{"mesh":0,"children":[2],"matrix":[1.5,-2e-3,0,0]},{"rotation":[0,0,0,1],"scale":[-1,1,1],"translation":[]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],
    "accessors":[{"bufferView":0,"byteOffset":12,"componentType":5126,"count":2147483647,"normalized":true,"type":"VEC3",
    "sparse":{"count":1,"indices":{"bufferView":0,"componentType":5123},"values":{"bufferView":1}}}],
    "bufferViews":[{"buffer":0,"byteLength":1,"byteStride":4}],"buffers":[{"byteLength":8,"uri":"data:\/x\",]}"}],
    "extensionsUsed":["A"],"extensionsRequired":[]} )";
  EXPECT_EQ(reduced(text), text);
}

TEST(GltfJson, EmptiesOtherMembersInPlace) {
  EXPECT_EQ(reduced(R"({"asset":{},"images":[{"uri":"x"}]})"), R"({"asset":{},"":0                  })");
  EXPECT_EQ(packed(reduced(R"({"extras":{"nodes":[{}]},"asset":{"copyright":"c","version":"2.0"}})")),
            R"({"":0,"asset":{"":0,"version":"2.0"}})");
  EXPECT_EQ(packed(reduced(R"({"a":1,"asset":{},"b" : -1.5 , "no\u0064es":[1],"":null})")), R"({"":0,"asset":{},"":0,"":0,"":0})");
  // Lines stay where they are, for the parser's messages.
  EXPECT_EQ(reduced("{\"name\":[\n1,\n2],\"asset\":{}}"), "{\"\":0    \n  \n  ,\"asset\":{}}");
}

TEST(GltfJson, RefusesWhatTheParserWouldMisread) {
  EXPECT_EQ(refusal_of(R"({"asset":{},"scene":-1})"), "byte 20: '-1' is not an integer from 0 to 2147483647");
  EXPECT_EQ(refusal_of(R"({"asset":{},"scene":-1})", 100), "byte 120: '-1' is not an integer from 0 to 2147483647");
  for (const char* number : {"2147483648", "4294967296", "99999999999999999999", "1.0", "1e3", "0x1", "NaN", "+1"})
    EXPECT_NE(refusal_of(std::string(R"({"asset":{},"nodes":[{"children":[)") + number + "]}]}").find("is not an integer"),
              std::string::npos)
        << number;
  EXPECT_EQ(refusal_of(R"({"asset":{},"buffers":[{"byteLength":1},{"uri":"a"},{}]})"), "byte 54: more than one buffer has no 'uri'");
  for (const char* none : {R"("uri":"")", R"("uri": 5)", R"("uri":null)", R"("uri":"a","uri":"")", R"("extras":{"uri":"a"})"})
    EXPECT_NE(refusal_of(std::string(R"({"asset":{},"buffers":[{}, {)") + none + "}]}").find("more than one buffer"), std::string::npos)
        << none;
  EXPECT_EQ(refusal_of(R"({"asset":{},"buffers":[{"byteLength":1,"extras":[{}]},{"uri":"a"}]})"), "");
}

TEST(GltfJson, RefusesBrokenStructureNamingTheByte) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "byte 0: the JSON text ends too early"},
           {" [", "byte 1: '{' should stand here"},
           {"{", "byte 1: the JSON text ends too early"},
           {"{\"a", "byte 3: the JSON text ends too early"},
           {"{\"a\\", "byte 5: the JSON text ends too early"},
           {"{\"a\"}", "byte 4: ':' should stand here"},
           {"{\"a\":}", "byte 5: a value should stand here"},
           {"{\"a\":1 2}", "byte 7: ',' or '}' should stand here"},
           {"{\"a\":[1}", "byte 7: ',' or ']' should stand here"},
           {"{a:1}", "byte 1: the name of a member should stand here"},
           {"{\"a\":1,}", "byte 7: the name of a member should stand here"},
           {"{\"a\n\":1}", "byte 3: a control character stands within a string"},
           {"{\"asset\":{}} {", "byte 13: something follows the JSON text"},
       })
    EXPECT_EQ(refusal_of(text), message) << text;
}

TEST(GltfJson, BoundsNesting) {
  const auto nested = [](const std::string& key, int depth) {
    return R"({"asset":{},")" + key + "\":" + std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']') + '}';
  };
  for (const char* key : {"nodes", "extras"}) {
    EXPECT_EQ(refusal_of(nested(key, 64)), "");
    EXPECT_NE(refusal_of(nested(key, 65)).find("values are nested more than 64 deep"), std::string::npos);
    EXPECT_NE(refusal_of(nested(key, 10'000'000)).find("values are nested more than 64 deep"), std::string::npos);
  }
}

TEST(GltfJson, BoundsWhatTheParserWillAllocate) {
  const auto repeated = [](const std::string& key, const std::string& value, int count) {
    std::string text = R"({"asset":{},")" + key + "\":[";
    for (int i = 0; i < count; ++i) text += (i > 0 ? "," : "") + value;
    return text + "]}";
  };
  EXPECT_EQ(refusal_of(repeated("nodes", "{}", 40'000)), "");
  EXPECT_NE(refusal_of(repeated("nodes", "{}", 60'000)).find("there are too many values"), std::string::npos);
  EXPECT_NE(refusal_of(repeated("nodes", "0", 1'000'000)).find("there are too many values"), std::string::npos);
  EXPECT_EQ(refusal_of(repeated("materials", "{}", 1'000'000)), "") << "these are not kept";
}

}  // namespace
}  // namespace spherematch
