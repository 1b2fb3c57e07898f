#include "server/router.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "api/json.h"

namespace spherematch {
namespace {

class RouterTest : public ::testing::Test {
 protected:
  RouterTest() {
    const auto named = [](const std::string& name) {
      return [name](HttpRequest& request) {
        return HttpResponse{200, "text/plain", name + ":" + request.id + ":" + request.body.bytes, {}};
      };
    };
    router.add("GET", "/", named("root"));
    router.add("POST", "/things", named("post"), Body::upload);
    router.add("GET", "/things", named("list"));
    router.add("GET", "/things/{id}", named("get"));
    router.add("DELETE", "/things/{id}", named("delete"));
    router.add("GET", "/things/{id}/part", named("part"));
    router.add("GET", "/broken", [](HttpRequest&) -> HttpResponse { throw std::runtime_error("oops"); });
  }

  HttpResponse call(const std::string& method, const std::string& path) {
    HttpRequest request;
    request.method = method;
    request.path = path;
    request.request_id = "r1";
    return router.handle(request, [this](HttpRequest& r, Body) {
      ++bodies_read;
      r.body.bytes = "body";
    });
  }

  Router router;
  int bodies_read = 0;
};

TEST_F(RouterTest, FindsHandlersAndIds) {
  EXPECT_EQ(call("GET", "/").body, "root::");
  EXPECT_EQ(call("GET", "/things").body, "list::");
  EXPECT_EQ(call("GET", "/things/a b").body, "get:a b:");
  EXPECT_EQ(call("DELETE", "/things/x").body, "delete:x:");
  EXPECT_EQ(call("GET", "/things/x/part").body, "part:x:");
  EXPECT_EQ(call("HEAD", "/things/x").body, "get:x:");
}

TEST_F(RouterTest, ReadsABodyOnlyForRoutesThatTakeOne) {
  EXPECT_EQ(call("POST", "/things").body, "post::body");
  EXPECT_EQ(bodies_read, 1);
  call("POST", "/nowhere");
  call("GET", "/things");
  call("POST", "/things/x");
  EXPECT_EQ(bodies_read, 1);
}

TEST_F(RouterTest, UnknownPathsAreNotFound) {
  const std::string long_id = "/things/" + std::string(129, 'a');
  for (const char* path :
       {"", "/x", "/things/", "/things//part", "/things/x/", "/things/x/part/", "/things/x/y", "//", "/part", long_id.c_str()}) {
    const HttpResponse response = call("GET", path);
    EXPECT_EQ(response.status, 404) << path;
    EXPECT_EQ(api::from_text<api::Problem>(response.body).code, api::Code::not_found);
  }
}

TEST_F(RouterTest, WrongMethodsNameTheRightOnes) {
  const auto allow = [&](const std::string& method, const std::string& path) {
    const HttpResponse response = call(method, path);
    EXPECT_EQ(response.status, 405);
    return response.headers.empty() ? std::string() : response.headers.front().first + ": " + response.headers.front().second;
  };
  EXPECT_EQ(allow("PUT", "/things"), "Allow: POST, GET, HEAD");
  EXPECT_EQ(allow("POST", "/things/x"), "Allow: GET, HEAD, DELETE");
  EXPECT_EQ(allow("OPTIONS", "/"), "Allow: GET, HEAD");
}

TEST_F(RouterTest, WhatAHandlerThrowsBecomesAProblem) {
  const HttpResponse response = call("GET", "/broken");
  EXPECT_EQ(response.status, 500);
  EXPECT_EQ(api::from_text<api::Problem>(response.body).request_id, "r1");
}

TEST_F(RouterTest, PatternsForLogs) {
  EXPECT_EQ(router.pattern_of("/things/secret/part"), "/things/{id}/part");
  EXPECT_EQ(router.pattern_of("/nowhere"), "-");
}

TEST_F(RouterTest, BodiesOfRoutes) {
  EXPECT_EQ(router.body_of("POST", "/things"), Body::upload);
  EXPECT_EQ(router.body_of("GET", "/things"), Body::none);
  EXPECT_EQ(router.body_of("POST", "/things/x"), Body::none);
  EXPECT_EQ(router.body_of("POST", "/nowhere"), Body::none);
}

}  // namespace
}  // namespace spherematch
