#include "tests/server/test_service.h"

namespace spherematch {
namespace {

using Tags = std::vector<std::string>;

class RoutesShapePatch : public testing::TestService {
 protected:
  void SetUp() override { id = shape(post("sphere 1", {{"name", "cat"}, {"tags", "a,b"}, {"wait", "10"}})).id; }
  HttpResponse patch(const std::string& body, std::map<std::string, std::string> headers = {}) {
    return call({.method = "PATCH", .path = "/shapes/" + id, .query = {}, .body = body, .file_name = {}, .headers = std::move(headers)});
  }
  api::Shape stored() { return shape(get("/shapes/" + id)); }

  std::string id;
};

TEST_F(RoutesShapePatch, WhatIsNamedChangesAndTheRestStays) {
  const api::Shape before = stored();
  api::Shape expected = before;
  expected.name = "dog";
  const HttpResponse response = patch(R"({"name": "dog"})");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "application/json");
  EXPECT_EQ(shape(response), expected);
  EXPECT_EQ(stored(), expected);
  expected.tags = {"c", "d"};
  EXPECT_EQ(shape(patch(R"({"tags": ["d", "c", "d"]})")), expected);
  EXPECT_EQ(shape(patch("{}")), expected);
  expected.name.clear();
  expected.tags.clear();
  EXPECT_EQ(shape(patch(R"({"name": null, "tags": null})")), expected);
  EXPECT_EQ(stored(), expected);
}

TEST_F(RoutesShapePatch, OtherChangesAreRefused) {
  const api::Shape before = stored();
  for (const std::string& body :
       {std::string(), std::string("{"), std::string("[]"), std::string("null"), std::string(R"({"state": "ready"})"),
        std::string(R"({"name": 1})"), std::string(R"({"name": "a\nb"})"), R"({"name": ")" + std::string(201, 'x') + "\"}",
        std::string(R"({"tags": "a"})"), std::string(R"({"tags": ["a b"]})"), std::string(R"({"tags": [""]})"),
        std::string(R"({"name": "x", "tags": [1]})")}) {
    EXPECT_EQ(problem_code(patch(body)), api::Code::invalid_parameter) << body;
  }
  std::string many = R"("0")";
  for (int i = 1; i <= 20; ++i) many += ",\"" + std::to_string(i) + "\"";
  EXPECT_EQ(problem_code(patch(R"({"tags": [)" + many + "]}")), api::Code::invalid_parameter);
  EXPECT_EQ(stored(), before);
  id = std::string(32, '0');
  EXPECT_EQ(problem_code(patch("{}")), api::Code::not_found);
  id = "x";
  EXPECT_EQ(problem_code(patch("{}")), api::Code::not_found);
}

TEST_F(RoutesShapePatch, ATagOfAnEarlierStateIsRefused) {
  const std::string tag = header(get("/shapes/" + id), "ETag");
  const HttpResponse first = patch(R"({"name": "dog"})", {{"if-match", tag}});
  EXPECT_EQ(first.status, 200);
  EXPECT_EQ(header(first, "ETag"), header(get("/shapes/" + id), "ETag"));
  EXPECT_EQ(problem_code(patch(R"({"name": "lynx"})", {{"if-match", tag}})), api::Code::precondition_failed);
  EXPECT_EQ(stored().name, "dog");
  EXPECT_EQ(patch(R"({"name": "lynx"})", {{"if-match", "\"other\", " + header(first, "ETag")}}).status, 200);
  EXPECT_EQ(patch(R"({"name": "puma"})", {{"if-match", "*"}}).status, 200);
}

TEST_F(RoutesShapePatch, ARenamedShapeIsStillRead) {
  const HttpResponse posted =
      call({.method = "POST", .path = "/shapes", .query = {}, .body = "sphere 2", .file_name = "a.stl", .headers = {}});
  id = shape(posted).id;
  patch(R"({"name": "no format here"})");
  (void)shapes->load_mesh(id);
  EXPECT_EQ(engine.mesh_name, ".stl");
}

}  // namespace
}  // namespace spherematch
