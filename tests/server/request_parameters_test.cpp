#include "server/request_parameters.h"

#include <gtest/gtest.h>

#include <array>

#include "server/problem.h"

namespace spherematch {
namespace {

HttpRequest with_query(std::multimap<std::string, std::string> query) {
  HttpRequest request;
  request.query = std::move(query);
  return request;
}

template <typename Use>
std::string refusal(std::multimap<std::string, std::string> query, Use use) {
  const HttpRequest request = with_query(std::move(query));
  try {
    const RequestParameters parameters(request, {"a", "b"});
    use(parameters);
  } catch (const ProblemError& error) {
    EXPECT_EQ(error.problem().code, api::Code::invalid_parameter);
    return error.what();
  }
  return "accepted";
}

const auto nothing = [](const RequestParameters&) {};

TEST(RequestParameters, UnknownOnesAreNamedWithTheAllowedOnes) {
  EXPECT_EQ(refusal({{"c", "1"}}, nothing), "unknown parameter 'c'; allowed are a, b");
  EXPECT_EQ(refusal({{"", ""}}, nothing), "unknown parameter ''; allowed are a, b");
  EXPECT_EQ(refusal({{"a", "1"}, {"a", "1"}}, nothing), "a: given more than once");
  EXPECT_EQ(refusal({{std::string(1000, 'x'), ""}}, nothing).size(), std::string("unknown parameter ''; allowed are a, b").size() + 67);
  EXPECT_THROW(RequestParameters(with_query({{"a", ""}}), {}), ProblemError);
}

TEST(RequestParameters, Text) {
  const HttpRequest request = with_query({{"a", "x y"}});
  const RequestParameters parameters(request, {"a", "b"});
  EXPECT_EQ(parameters.text("a"), "x y");
  EXPECT_EQ(parameters.text("b"), std::nullopt);
  EXPECT_EQ(parameters.required("a"), "x y");
  EXPECT_EQ(refusal({}, [](const auto& p) { (void)p.required("b"); }), "b: is missing");
  EXPECT_EQ(refusal({{"b", ""}}, [](const auto& p) { (void)p.required("b"); }), "b: is missing");
}

TEST(RequestParameters, Choices) {
  constexpr std::array<std::string_view, 2> choices{"fill", "none"};
  const HttpRequest request = with_query({{"a", "none"}});
  const RequestParameters parameters(request, {"a", "b"});
  EXPECT_EQ(parameters.choice("a", choices), "none");
  EXPECT_EQ(parameters.choice("b", choices), "fill");
  EXPECT_EQ(refusal({{"a", "safe"}}, [&](const auto& p) { (void)p.choice("a", choices); }), "a: 'safe' is not one of fill, none");
}

TEST(RequestParameters, Integers) {
  const auto read = [](const auto& p) { (void)p.integer("a", 5, 1, 10); };
  const HttpRequest request = with_query({{"a", "10"}});
  const RequestParameters parameters(request, {"a", "b"});
  EXPECT_EQ(parameters.integer("a", 5, 1, 10), 10);
  EXPECT_EQ(parameters.integer("b", 5, 1, 10), 5);
  for (const char* text : {"0", "11", "", " 1", "1 ", "1.0", "+1", "0x1", "99999999999999999999"}) {
    EXPECT_EQ(refusal({{"a", text}}, read), "a: '" + std::string(text) + "' is not an integer from 1 to 10");
  }
}

TEST(RequestParameters, Seconds) {
  using std::chrono::milliseconds;
  const auto read = [](const auto& p) { (void)p.seconds("a", 0, 60); };
  const HttpRequest request = with_query({{"a", "1.5"}, {"b", "60"}});
  const RequestParameters parameters(request, {"a", "b", "c"});
  EXPECT_EQ(parameters.seconds("a", 0, 60), milliseconds(1500));
  EXPECT_EQ(parameters.seconds("b", 0, 60), milliseconds(60'000));
  EXPECT_EQ(parameters.seconds("c", 30, 60), milliseconds(30'000));
  for (const char* text : {"-1", "60.1", "nan", "inf", "", "1s", "1e9"}) {
    EXPECT_EQ(refusal({{"a", text}}, read), "a: '" + std::string(text) + "' is not a number of seconds from 0 to 60");
  }
}

TEST(RequestParameters, TextIsEncodedForAQuery) {
  EXPECT_EQ(percent_encoded("aZ09-._~"), "aZ09-._~");
  EXPECT_EQ(percent_encoded("a b&c=d>%\xC3\xA4"), "a%20b%26c%3Dd%3E%25%C3%A4");
}

}  // namespace
}  // namespace spherematch
