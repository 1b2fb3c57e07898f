#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesThumbnail : public testing::TestService {
 protected:
  static std::string path(const std::string& id) { return "/shapes/" + id + "/thumbnail.png"; }
  HttpResponse with_header(const std::string& id, const std::string& name, const std::string& value) {
    return call({.method = "GET", .path = path(id), .query = {}, .body = {}, .file_name = {}, .headers = {{name, value}}});
  }
  /// The width and the height that a PNG file names.
  static std::pair<int, int> size_of(const std::string& png) {
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + static_cast<unsigned char>(png.at(i));
      return value;
    };
    EXPECT_TRUE(png.starts_with("\x89PNG\r\n"));
    return {number(16), number(20)};
  }
};

TEST_F(RoutesThumbnail, IsASquareOfTheAskedSize) {
  const std::string id = ready("sphere 1");
  const HttpResponse plain = get(path(id));
  EXPECT_EQ(plain.status, 200) << plain.body;
  EXPECT_EQ(plain.content_type, "image/png");
  EXPECT_EQ(size_of(plain.body), std::pair(256, 256));
  for (const int size : {16, 100, 1024}) EXPECT_EQ(size_of(get(path(id), {{"size", std::to_string(size)}}).body), std::pair(size, size));
  EXPECT_EQ(get(path(id), {{"size", "256"}}).body, plain.body);
}

TEST_F(RoutesThumbnail, OtherSizesAndParametersAreRefused) {
  const std::string id = ready("sphere 1");
  for (const char* size : {"15", "1025", "-64", "64.5", "big", ""})
    EXPECT_EQ(problem_code(get(path(id), {{"size", size}})), api::Code::invalid_parameter) << size;
  EXPECT_EQ(problem_code(get(path(id), {{"format", "png"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(with_header(id, "accept", "application/json")), api::Code::not_acceptable);
  EXPECT_EQ(with_header(id, "accept", "image/avif,image/webp,*/*;q=0.8").status, 200);
}

TEST_F(RoutesThumbnail, UpAndFrontSayFromWhere) {
  const std::string id = ready("sphere 1");
  std::set<std::string> tags{header(get(path(id)), "ETag")};
  EXPECT_EQ(get(path(id), {{"up", "auto"}, {"front", "auto"}}).body, get(path(id)).body);
  for (const auto& [up, front] : {std::pair("y", "z"), std::pair("-y", "z"), std::pair("z", "-x"), std::pair("x", "-y")}) {
    const HttpResponse response = get(path(id), {{"up", up}, {"front", front}});
    EXPECT_EQ(response.status, 200) << response.body;
    EXPECT_TRUE(tags.insert(header(response, "ETag")).second);
  }
  for (const auto& [up, front] :
       {std::pair("y", "-y"), std::pair("z", "z"), std::pair("auto", "x"), std::pair("x", "auto"), std::pair("w", "x")})
    EXPECT_EQ(problem_code(get(path(id), {{"up", up}, {"front", front}})), api::Code::invalid_parameter) << up << front;
}

TEST_F(RoutesThumbnail, IsThereBeforeThePreparationAndAfterItFailed) {
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  const HttpResponse before = get(path(id));
  EXPECT_EQ(before.status, 200) << before.body;
  engine.hold_preparation = false;
  EXPECT_EQ(ready("sphere 1"), id);
  const HttpResponse after = get(path(id));
  EXPECT_EQ(before.body, after.body);
  EXPECT_EQ(header(before, "ETag"), header(after, "ETag"));
  EXPECT_EQ(get(path(shape(post("sphere hopeless")).id)).status, 200);
}

TEST_F(RoutesThumbnail, ATagSparesTheBodyAndNamesTheSize) {
  const std::string id = ready("sphere 1");
  const std::string tag = header(get(path(id)), "ETag");
  EXPECT_NE(tag, header(get(path(id), {{"size", "64"}}), "ETag"));
  const HttpResponse spared = with_header(id, "if-none-match", tag);
  EXPECT_EQ(spared.status, 304);
  EXPECT_TRUE(spared.body.empty());
  EXPECT_EQ(header(spared, "ETag"), tag);
}

TEST_F(RoutesThumbnail, IsDrawnOnce) {
  const std::string id = ready("sphere 1");
  const std::string first = get(path(id)).body;
  const int reads = engine.reads;
  EXPECT_EQ(get(path(id)).body, first);
  EXPECT_EQ(engine.reads, reads);
  EXPECT_NE(get(path(id), {{"size", "64"}}).body, first);
  EXPECT_EQ(engine.reads, reads + 1);
}

TEST_F(RoutesThumbnail, AShapeThatIsGoneHasNone) {
  const std::string id = ready("sphere 1");
  EXPECT_EQ(get(path(id)).status, 200);  // so that it is kept
  EXPECT_EQ(remove(id).status, 204);
  EXPECT_EQ(problem_code(get(path(id))), api::Code::not_found);
  EXPECT_EQ(problem_code(get(path(std::string(32, '0')))), api::Code::not_found);
  EXPECT_EQ(problem_code(get(path("x"))), api::Code::not_found);
}

}  // namespace
}  // namespace spherematch
