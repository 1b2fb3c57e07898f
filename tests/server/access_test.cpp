#include "server/access.h"

#include <gtest/gtest.h>

#include <fstream>

#include "api/error_table.h"
#include "server/problem.h"
#include "server/router.h"
#include "tests/server/temporary_directory.h"

namespace spherematch {
namespace {

class AccessTest : public ::testing::Test {
 protected:
  AccessTest() {
    reader = add_key(file, "reader", Scope::read);
    writer = add_key(file, "writer", Scope::write);
    admin = add_key(file, "admin", Scope::admin);
  }

  static HttpRequest request(const std::string& method, const std::string& key, const std::string& header = "authorization") {
    HttpRequest request;
    request.method = method;
    request.request_id = "r1";
    if (!key.empty()) request.headers.emplace(header, header == "authorization" ? "Bearer " + key : key);
    return request;
  }
  /// 200, 401 or 403.
  int status(Access& access, const HttpRequest& request, std::string_view pattern) {
    try {
      access.check(request, pattern);
      return 200;
    } catch (const ProblemError& error) {
      challenge = error.headers().at(0).second;
      detail = error.problem().detail;
      return api::entry_of(error.problem().code).status;
    }
  }

  const testing::TemporaryDirectory place;
  const std::filesystem::path file = place.path() / "keys";
  std::string reader;
  std::string writer;
  std::string admin;
  std::string challenge;
  std::string detail;
};

TEST_F(AccessTest, WithoutAFileEverybodyMayDoEverything) {
  Access open(std::nullopt);
  EXPECT_EQ(status(open, request("DELETE", ""), "/shapes/{id}"), 200);
  EXPECT_EQ(status(open, request("GET", "whatever"), "/metrics"), 200);
  EXPECT_EQ(open.caller("Bearer whatever", ""), "");
}

TEST_F(AccessTest, EveryScopeAllowsWhatItShould) {
  Access access(file);
  struct Case {
    const char* method;
    const char* pattern;
    int without, read, write, admin;
  };
  for (const Case& c : {
           Case{"GET", "/", 200, 200, 200, 200},
           Case{"GET", "/healthz", 200, 200, 200, 200},
           Case{"HEAD", "/readyz", 200, 200, 200, 200},
           Case{"GET", "/version", 200, 200, 200, 200},
           Case{"GET", "/openapi.json", 200, 200, 200, 200},
           Case{"GET", "/docs", 200, 200, 200, 200},
           Case{"GET", "/page/{id}", 200, 200, 200, 200},
           Case{"POST", "/page/{id}", 401, 403, 200, 200},
           Case{"GET", "/shapes", 401, 200, 200, 200},
           Case{"HEAD", "/shapes/{id}", 401, 200, 200, 200},
           Case{"GET", "/match", 401, 200, 200, 200},
           Case{"GET", "/a/later/route", 401, 200, 200, 200},
           Case{"GET", "-", 401, 200, 200, 200},
           Case{"POST", "/match", 401, 200, 200, 200},
           Case{"POST", "/transfer", 401, 200, 200, 200},
           Case{"POST", "/evaluations", 401, 200, 200, 200},
           Case{"POST", "/shapes", 401, 403, 200, 200},
           Case{"PATCH", "/shapes/{id}", 401, 403, 200, 200},
           Case{"DELETE", "/shapes/{id}", 401, 403, 200, 200},
           Case{"DELETE", "/jobs/{id}", 401, 403, 200, 200},
           Case{"POST", "/", 401, 403, 200, 200},
           Case{"POST", "-", 401, 403, 200, 200},
           Case{"GET", "/metrics", 401, 403, 403, 200},
           Case{"HEAD", "/metrics", 401, 403, 403, 200},
       }) {
    EXPECT_EQ(status(access, request(c.method, ""), c.pattern), c.without) << c.method << c.pattern;
    EXPECT_EQ(status(access, request(c.method, reader), c.pattern), c.read) << c.method << c.pattern;
    EXPECT_EQ(status(access, request(c.method, writer), c.pattern), c.write) << c.method << c.pattern;
    EXPECT_EQ(status(access, request(c.method, admin), c.pattern), c.admin) << c.method << c.pattern;
  }
}

TEST_F(AccessTest, TheKeyComesInEitherHeaderAndNamesTheCaller) {
  Access access(file);
  EXPECT_EQ(status(access, request("GET", reader, "x-api-key"), "/shapes"), 200);
  EXPECT_EQ(access.caller("Bearer " + reader, ""), "reader");
  EXPECT_EQ(access.caller("bEARER   " + writer, ""), "writer");
  EXPECT_EQ(access.caller("", admin), "admin");
  EXPECT_EQ(access.caller("Basic " + reader, ""), "");
  EXPECT_EQ(access.caller("Bearer " + reader + "x", ""), "");
  EXPECT_EQ(access.caller("Bearer ", ""), "");
  EXPECT_EQ(access.caller("Bearer " + sha256_of(reader), ""), "");  // the file's content opens nothing
}

TEST_F(AccessTest, RefusalsSayWhatIsMissing) {
  Access access(file);
  EXPECT_EQ(status(access, request("GET", ""), "/shapes"), 401);
  EXPECT_EQ(challenge, "Bearer realm=\"spherematch\"");
  EXPECT_EQ(status(access, request("GET", "sm_wrong"), "/shapes"), 401);
  EXPECT_NE(challenge.find("error=\"invalid_token\""), std::string::npos);
  EXPECT_EQ(detail.find("sm_wrong"), std::string::npos);
  EXPECT_EQ(status(access, request("GET", reader), "/metrics"), 403);
  EXPECT_NE(challenge.find("scope=\"admin\""), std::string::npos);
  EXPECT_NE(detail.find("'reader'"), std::string::npos);
}

TEST_F(AccessTest, AChangedFileIsTakenUpAtOnce) {
  Access access(file);
  remove_key(file, "reader");
  EXPECT_EQ(status(access, request("GET", reader), "/shapes"), 401);
  const std::string fresh = add_key(file, "fresh", Scope::read);
  EXPECT_EQ(status(access, request("GET", fresh), "/shapes"), 200);
}

TEST_F(AccessTest, ABrokenFileStopsTheStartButNotARunningServer) {
  Access access(file);
  std::ofstream(file, std::ios::app) << "nonsense\n";
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(status(access, request("GET", reader), "/shapes"), 200);
  EXPECT_EQ(status(access, request("GET", "sm_wrong"), "/shapes"), 401);
  const std::string log = ::testing::internal::GetCapturedStdout();
  EXPECT_NE(log.find("event=keys_not_read"), std::string::npos);
  EXPECT_NE(log.find("line 5"), std::string::npos);
  EXPECT_EQ(log.find("keys_not_read"), log.rfind("keys_not_read"));  // once, not with every request
  EXPECT_THROW(Access{file}, KeyFileError);
  std::filesystem::remove(file);
  EXPECT_EQ(status(access, request("GET", reader), "/shapes"), 200);
  EXPECT_THROW(Access{file}, KeyFileError);
}

TEST_F(AccessTest, TheRouterAsksBeforeTheBodyAndBeforeTheResource) {
  Access access(file);
  Router router;
  int handled = 0;
  int bodies = 0;
  router.add(
      "POST", "/shapes", [&](HttpRequest&) { return ++handled, HttpResponse{}; }, Body::upload);
  router.add("GET", "/shapes/{id}", [&](HttpRequest&) { return ++handled, HttpResponse{404, {}, {}, {}}; });
  router.set_guard([&access](const HttpRequest& r, std::string_view pattern) { access.check(r, pattern); });
  const auto call = [&](const std::string& method, const std::string& path, const std::string& key) {
    HttpRequest r = request(method, key);
    r.path = path;
    return router.handle(r, [&](HttpRequest&, Body) { ++bodies; }).status;
  };
  EXPECT_EQ(call("POST", "/shapes", ""), 401);
  EXPECT_EQ(call("POST", "/shapes", reader), 403);
  EXPECT_EQ(call("GET", "/shapes/0", ""), 401);
  EXPECT_EQ(call("GET", "/nowhere", ""), 401);
  EXPECT_EQ(call("PUT", "/shapes", ""), 401);
  EXPECT_EQ(handled, 0);
  EXPECT_EQ(bodies, 0);
  EXPECT_EQ(call("POST", "/shapes", writer), 200);
  EXPECT_EQ(bodies, 1);
  EXPECT_EQ(call("GET", "/shapes/0", reader), 404);
  EXPECT_EQ(call("GET", "/nowhere", reader), 404);
  EXPECT_EQ(call("PUT", "/shapes", writer), 405);
}

}  // namespace
}  // namespace spherematch
