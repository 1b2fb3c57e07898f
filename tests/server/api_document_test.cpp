#include "server/api_document.h"

#include <set>

#include "server/routes_operations.h"
#include "tests/server/test_service.h"

namespace spherematch {
namespace {

using api::Json;

TEST(ApiDocument, YamlKeepsItsTypesAndItsOrder) {
  const Json json = json_of_yaml("b: 1\na: [true, 'true', null, '1', 1.5, x y]\n'200':\n  c: >-\n    two\n    lines\n");
  EXPECT_EQ(json.dump(), R"({"b":1,"a":[true,"true",null,"1",1.5,"x y"],"200":{"c":"two lines"}})");
  EXPECT_THROW((void)json_of_yaml("a: [1"), std::runtime_error);
}

class ApiDocumentTest : public testing::TestService {
 protected:
  ApiDocumentTest() {
    add_metrics_route(*router, metrics, [] { return MetricsSnapshot{}; });
    add_readiness_route(*router, readiness);
  }

  Metrics metrics{"1.2.3", "stub-1"};
  Readiness readiness;
  Json document = json_of_yaml(api_document_text());
};

TEST_F(ApiDocumentTest, NamesExactlyTheRoutesOfTheServer) {
  std::set<std::string> documented, served;
  for (const auto& [path, item] : document["paths"].items()) {
    for (const auto& [method, operation] : item.items()) {
      if (method != "parameters") documented.insert(method + " " + path);
    }
  }
  for (const Router::Route& route : router->routes()) {
    std::string method = route.method;
    std::transform(method.begin(), method.end(), method.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    served.insert(method + " " + route.pattern);
  }
  EXPECT_EQ(documented, served);
}

TEST_F(ApiDocumentTest, IsServedWithATag) {
  const HttpResponse response = get("/openapi.json");
  EXPECT_EQ(response.content_type, "application/json");
  EXPECT_EQ(Json::parse(response.body), document);
  const HttpResponse again = call({.method = "GET",
                                   .path = "/openapi.json",
                                   .query = {},
                                   .body = {},
                                   .file_name = {},
                                   .headers = {{"if-none-match", header(response, "ETag")}}});
  EXPECT_EQ(again.status, 304);
}

TEST_F(ApiDocumentTest, ThePageHasEveryOperationAndEverySchema) {
  const HttpResponse response = get("/docs");
  EXPECT_EQ(response.content_type, "text/html; charset=utf-8");
  for (const auto& [path, item] : document["paths"].items()) EXPECT_NE(response.body.find("<code>" + path + "</code>"), std::string::npos);
  for (const auto& [name, schema] : document["components"]["schemas"].items()) {
    EXPECT_NE(response.body.find("<h3 id=\"" + name + "\">"), std::string::npos) << name;
  }
  // Every link within the page leads somewhere.
  for (auto at = response.body.find("href=\"#"); at != std::string::npos; at = response.body.find("href=\"#", at + 1)) {
    const std::string name = response.body.substr(at + 7, response.body.find('"', at + 7) - at - 7);
    EXPECT_NE(response.body.find("id=\"" + name + "\""), std::string::npos) << name;
  }
  EXPECT_EQ(response.body.find("<script"), std::string::npos);
}

TEST(ApiPage, TextIsEscaped) {
  const Json document =
      Json::parse(R"({"info": {"description": "a <b> & \"c\""}, "tags": [], "paths": {}, "components": {"schemas": {}}})");
  EXPECT_NE(api_page(document).find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
}

}  // namespace
}  // namespace spherematch
