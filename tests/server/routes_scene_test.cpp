#include "engine/io/mesh_reader.h"
#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesScene : public testing::TestService {
 protected:
  HttpResponse scene(const std::string& src, const std::string& tgt, std::multimap<std::string, std::string> query = {},
                     std::map<std::string, std::string> headers = {}) {
    query.emplace("src", src);
    query.emplace("tgt", tgt);
    return call({.method = "GET", .path = "/scene", .query = std::move(query), .body = {}, .file_name = {}, .headers = std::move(headers)});
  }
};

TEST_F(RoutesScene, BothMeshesAreInOneFileUnderTheirNames) {
  const std::string src = shape(post("sphere 1", {{"name", "left \"one\""}, {"wait", "10"}})).id;
  const std::string tgt = ready("sphere 2");
  const HttpResponse response = scene(src, tgt);
  EXPECT_EQ(response.status, 200) << response.body;
  EXPECT_EQ(response.content_type, "model/gltf-binary");
  EXPECT_EQ(read_mesh(std::as_bytes(std::span(response.body)), "").vertex_count(), 10);
  EXPECT_NE(response.body.find(R"("name":"left \"one\"")"), std::string::npos);
  EXPECT_NE(response.body.find(R"("name":")" + tgt + '"'), std::string::npos);  // it has no name
  EXPECT_EQ(scene(src, tgt).body, response.body);
  EXPECT_EQ(engine.matches, 1);
  EXPECT_EQ(scene(src, tgt, {{"format", "glb"}}, {{"accept", "image/png"}}).status, 200);
  EXPECT_EQ(problem_code(scene(src, tgt, {}, {{"accept", "image/png"}})), api::Code::not_acceptable);
}

TEST_F(RoutesScene, ATagSparesTheComputationUntilAShapeIsRenamed) {
  const std::string src = ready("sphere 1");
  const std::string tgt = ready("sphere 2");
  const std::string tag = header(scene(src, tgt), "ETag");
  EXPECT_EQ(scene(src, tgt, {}, {{"if-none-match", tag}}).status, 304);
  EXPECT_EQ(scene(tgt, src, {}, {{"if-none-match", tag}}).status, 200);
  EXPECT_EQ(scene(src, tgt, {{"method", "paper"}}, {{"if-none-match", tag}}).status, 200);
  EXPECT_EQ(scene(src, tgt, {{"refine", "none"}}, {{"if-none-match", tag}}).status, 200);
  shapes->change(tgt, {.name = "new", .tags = {}}, {});
  EXPECT_EQ(scene(src, tgt, {}, {{"if-none-match", tag}}).status, 200);
}

TEST_F(RoutesScene, ParametersAndShapesAreChecked) {
  const std::string src = ready("sphere 1");
  EXPECT_EQ(problem_code(scene(src, std::string(32, '0'))), api::Code::not_found);
  EXPECT_EQ(problem_code(scene(src, "")), api::Code::invalid_parameter);
  for (const auto& [name, value] :
       {std::pair("format", "ply"), std::pair("both", "yes"), std::pair("wait", "x"), std::pair("cache", "x")}) {
    EXPECT_EQ(problem_code(scene(src, src, {{name, value}})), api::Code::invalid_parameter) << name;
  }
  const std::string hopeless = shape(post("sphere hopeless")).id;
  EXPECT_EQ(problem_code(scene(src, hopeless)), api::Code::shape_failed);
}

}  // namespace
}  // namespace spherematch
