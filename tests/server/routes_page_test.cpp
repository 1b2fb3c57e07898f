#include <algorithm>

#include "tests/server/test_service.h"
#include "web/page_files.h"

namespace spherematch {
namespace {

class RoutesPage : public testing::TestService {
 protected:
  void SetUp() override {
    if (page_files().empty()) GTEST_SKIP() << "built without the page";
  }

  /// The address of a file as the document names it.
  static std::string version() {
    const std::string_view document = page_files().front().bytes;
    const auto at = document.find("page.js?v=") + 10;
    return std::string(document.substr(at, document.find('"', at) - at));
  }

  HttpResponse call(const std::string& path, const std::map<std::string, std::string>& headers, const std::string& version = {}) {
    HttpRequest request;
    request.method = "GET";
    request.path = path;
    request.headers = headers;
    if (!version.empty()) request.query.emplace("v", version);
    return router->handle(request, [](HttpRequest&, Body) {});
  }
};

TEST_F(RoutesPage, TheDocumentIsBundledAndLetsNothingFromElsewhereIn) {
  const HttpResponse page = call("/", {});
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.content_type, "text/html; charset=utf-8");
  EXPECT_NE(page.body.find("/page/page.js?v="), std::string::npos);
  EXPECT_EQ(page.body.find("@VERSION@"), std::string::npos);
  EXPECT_NE(header(page, "Content-Security-Policy").find("default-src 'none'; script-src 'self'"), std::string::npos);
  EXPECT_EQ(header(page, "Cache-Control"), "no-cache");
  EXPECT_EQ(problem_code(get("/", {{"bogus", "1"}})), api::Code::invalid_parameter);
}

TEST_F(RoutesPage, FilesAreCompressedForThoseWhoTakeIt) {
  const HttpResponse plain = call("/page/page.js", {});
  const HttpResponse packed = call("/page/page.js", {{"accept-encoding", "br, gzip"}});
  EXPECT_EQ(header(plain, "Content-Encoding"), "");
  EXPECT_EQ(header(packed, "Content-Encoding"), "gzip");
  EXPECT_EQ(packed.body.substr(0, 2), "\x1f\x8b");
  EXPECT_LT(packed.body.size() * 2, plain.body.size());
  EXPECT_EQ(header(packed, "Vary"), "Accept-Encoding");
}

TEST_F(RoutesPage, ScriptsAndStylesStayBelowOneMegabyteCompressed) {
  std::size_t bytes = 0;
  for (const PageFile& file : page_files()) bytes += file.gzip.size();
  EXPECT_GT(bytes, 20'000U);
  EXPECT_LT(bytes, 1'000'000U);
}

TEST_F(RoutesPage, OnlyTheCurrentVersionIsKeptForGood) {
  EXPECT_EQ(header(call("/page/page.css", {}, version()), "Cache-Control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(header(call("/page/page.css", {}, "0123456789abcdef"), "Cache-Control"), "no-cache");
  EXPECT_EQ(header(call("/page/page.css", {}), "Cache-Control"), "no-cache");
}

TEST_F(RoutesPage, AKnownFileIsNotSentAgain) {
  const std::string etag = header(call("/page/page.js", {}), "ETag");
  const HttpResponse known = call("/page/page.js", {{"if-none-match", etag}, {"accept-encoding", "gzip"}});
  EXPECT_EQ(known.status, 304);
  EXPECT_EQ(known.body, "");
  EXPECT_EQ(header(known, "Content-Encoding"), "");
}

TEST_F(RoutesPage, UnknownFilesAreNotFound) {
  for (const char* name : {"/page/none.js", "/page/index.html", "/page/.."})
    EXPECT_EQ(problem_code(get(name)), api::Code::not_found) << name;
  EXPECT_EQ(problem_code(get("/page/page.js", {{"w", "1"}})), api::Code::invalid_parameter);
}

TEST_F(RoutesPage, LicencesNameWhatIsBundled) {
  const std::string text = call("/page/licences.txt", {}).body;
  for (const char* name : {"three ", "three-mesh-bvh ", "MIT"}) EXPECT_NE(text.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace spherematch
