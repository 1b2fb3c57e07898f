#include <cmath>
#include <cstring>

#include "engine/io/array_reader.h"
#include "engine/io/array_writer.h"
#include "tests/server/test_service.h"

namespace spherematch {
namespace {

/// The stub's shapes have five uploaded vertices, the last of them dropped. It maps vertex i to the point of weights 0.5, 0.3, 0.2 in
/// the vertices (i + 1) % 4, 0 and 1.
class RoutesTransfer : public testing::TestService {
 protected:
  void SetUp() override {
    src = ready("sphere 1");
    tgt = ready("sphere 2");
  }
  HttpResponse transfer(const std::string& body, std::multimap<std::string, std::string> query = {}) {
    query.emplace("src", src);
    query.emplace("tgt", tgt);
    return call({.method = "POST", .path = "/transfer", .query = std::move(query), .body = body, .file_name = {}, .headers = {}});
  }
  template <typename Number>
  static std::string npy(const std::string& dtype, std::vector<std::int64_t> shape, const std::vector<Number>& numbers) {
    return encode_npy(dtype, shape, std::as_bytes(std::span(numbers)));
  }
  template <typename Number>
  static std::vector<Number> numbers(const HttpResponse& response) {
    EXPECT_EQ(response.status, 200) << response.body;
    const Array array = decode_npy(response.body);
    std::vector<Number> result(array.bytes.size() / sizeof(Number));
    std::memcpy(result.data(), array.bytes.data(), array.bytes.size());
    return result;
  }

  std::string src;
  std::string tgt;
};

TEST_F(RoutesTransfer, FloatsAreInterpolatedUnlessTheNearestAreAskedFor) {
  const std::string body = npy<double>("<f8", {5, 1}, {0, 10, 20, 30, 40});
  const HttpResponse response = transfer(body);
  EXPECT_EQ(response.content_type, "application/x-npy");
  EXPECT_EQ(header(response, "Cache-Control"), "no-store");
  EXPECT_NE(header(response, "Server-Timing").find("cache"), std::string::npos);
  EXPECT_EQ(decode_npy(response.body).shape, (std::vector<std::int64_t>{5, 1}));
  const std::vector<double> linear = numbers<double>(response);
  for (std::size_t i = 0; i < 4; ++i) {
    const double first = 10.0 * static_cast<double>((i + 1) % 4);
    EXPECT_NEAR(linear[i], 0.5 * first + 0.2 * 10, 1e-6);
  }
  EXPECT_TRUE(std::isnan(linear[4]));
  const std::vector<double> nearest = numbers<double>(transfer(body, {{"interp", "nearest"}}));
  EXPECT_EQ(nearest[0], 10);
  EXPECT_EQ(nearest[3], 0);
  EXPECT_TRUE(std::isnan(nearest[4]));
}

TEST_F(RoutesTransfer, OtherDtypesMoveToTheNearest) {
  const std::vector<std::uint8_t> labels{5, 6, 7, 8, 9};
  EXPECT_EQ(numbers<std::uint8_t>(transfer(npy("|u1", {5}, labels))), (std::vector<std::uint8_t>{6, 7, 8, 5, 0}));
  const HttpResponse refused = transfer(npy("|u1", {5}, labels), {{"interp", "linear"}});
  EXPECT_EQ(problem_code(refused), api::Code::invalid_parameter);
  EXPECT_NE(refused.body.find("nearest works"), std::string::npos);
}

TEST_F(RoutesTransfer, AnotherNumberOfRowsIsAMismatch) {
  for (const std::int64_t rows : {0, 4, 6}) {
    const HttpResponse response = transfer(npy("<f4", {rows}, std::vector<float>(static_cast<std::size_t>(rows))));
    EXPECT_EQ(problem_code(response), api::Code::length_mismatch);
    const auto problem = api::from_text<api::Problem>(response.body);
    EXPECT_EQ(problem.limit, 5);
    EXPECT_EQ(problem.actual, rows);
  }
  EXPECT_EQ(engine.matches, 0);
}

TEST_F(RoutesTransfer, WhatIsNoArrayIsRefused) {
  for (const std::string& body : {std::string(), std::string("1 2 3"), npy("<f4", {5}, std::vector<float>(4)),
                                  npy("<f4", {5}, std::vector<float>(6)), npy("|O", {5}, std::vector<std::int64_t>(5))}) {
    EXPECT_EQ(problem_code(transfer(body)), api::Code::malformed_array);
  }
  EXPECT_EQ(engine.matches, 0);
}

TEST_F(RoutesTransfer, AnAnswerThatGrowsTooLargeIsRefused) {
  options.max_body_mib = 1;
  // Within the limits of a body, but five times its bytes are more than the fourfold.
  EXPECT_EQ(numbers<std::uint8_t>(transfer(npy("|u1", {5, 100'000}, std::vector<std::uint8_t>(500'000)))).size(), 500'000U);
  const HttpResponse response = transfer(npy("|u1", {5, 1'000'000}, std::vector<std::uint8_t>(5'000'000)));
  EXPECT_EQ(problem_code(response), api::Code::payload_too_large);
  EXPECT_EQ(api::from_text<api::Problem>(response.body).limit, 4 << 20);
}

TEST_F(RoutesTransfer, TheMatchIsComputedOnceAndItsParametersCount) {
  const std::string body = npy<float>("<f4", {5}, {1, 2, 3, 4, 5});
  transfer(body);
  transfer(body, {{"interp", "nearest"}});
  EXPECT_EQ(engine.matches, 1);
  transfer(body, {{"cache", "no"}});
  transfer(body, {{"method", "paper"}});
  transfer(body, {{"refine", "none"}});
  transfer(body, {{"orientation", "any"}});
  transfer(body, {{"hints", "0:1"}});
  EXPECT_EQ(engine.matches, 6);
  for (const auto& [name, value] : {std::pair("interp", "cubic"), std::pair("method", "x"), std::pair("refine", "x"),
                                    std::pair("orientation", "x"), std::pair("cache", "x"), std::pair("hints", "x"), std::pair("wait", "x"),
                                    std::pair("both", "yes"), std::pair("format", "json"), std::pair("as", "value")}) {
    EXPECT_EQ(problem_code(transfer(body, {{name, value}})), api::Code::invalid_parameter) << name;
  }
}

TEST_F(RoutesTransfer, AMeshOrAPictureShowsWhatWasCarried) {
  const std::string body = npy<std::int32_t>("<i4", {5}, {5, 6, 7, 8, 9});
  for (const auto& [format, type, beginning] :
       {std::tuple("ply", "application/x-ply", "ply\n"), std::tuple("glb", "model/gltf-binary", "glTF"),
        std::tuple("png", "image/png", "\x89PNG")}) {
    const HttpResponse response = transfer(body, {{"format", format}});
    EXPECT_EQ(response.status, 200) << response.body;
    EXPECT_EQ(response.content_type, type);
    EXPECT_TRUE(response.body.starts_with(beginning)) << format;
    const HttpResponse by_header = call({.method = "POST",
                                         .path = "/transfer",
                                         .query = {{"src", src}, {"tgt", tgt}},
                                         .body = body,
                                         .file_name = {},
                                         .headers = {{"accept", type}}});
    EXPECT_EQ(by_header.body, response.body);
    EXPECT_EQ(transfer(body, {{"format", format}, {"as", "label"}}).body, response.body);
    EXPECT_NE(transfer(body, {{"format", format}, {"as", "value"}}).body, response.body);
  }
  EXPECT_NE(transfer(body, {{"format", "ply"}}).body.find("property int label\n"), std::string::npos);
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesTransfer, WhatCannotBeShownIsRefusedBeforeTheMatch) {
  const std::string numbers = npy<std::int32_t>("<i4", {5}, {5, 6, 7, 8, 9});
  for (const char* meaning : {"color", "texture", "weights", "colour", ""})
    EXPECT_EQ(problem_code(transfer(numbers, {{"format", "png"}, {"as", meaning}})), api::Code::invalid_parameter) << meaning;
  const std::string wide = npy<std::int32_t>("<i4", {5, 2}, std::vector<std::int32_t>(10));
  const HttpResponse refused = transfer(wide, {{"format", "ply"}});
  EXPECT_EQ(problem_code(refused), api::Code::invalid_parameter);
  EXPECT_NE(refused.body.find("(5, 2)"), std::string::npos) << refused.body;
  EXPECT_EQ(engine.matches, 0);
}

TEST_F(RoutesTransfer, ShapesMustBeThereAndReady) {
  const std::string body = npy<float>("<f4", {5}, {1, 2, 3, 4, 5});
  tgt = std::string(32, '0');
  EXPECT_EQ(problem_code(transfer(body)), api::Code::not_found);
  engine.hold_preparation = true;
  tgt = shape(post("sphere 3", {})).id;
  EXPECT_EQ(problem_code(transfer(body, {{"wait", "0"}})), api::Code::shape_not_ready);
  engine.hold_preparation = false;
  EXPECT_EQ(transfer(body, {{"wait", "10"}}).status, 200);
}

}  // namespace
}  // namespace spherematch
