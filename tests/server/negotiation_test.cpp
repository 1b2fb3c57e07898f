#include "server/negotiation.h"

#include <gtest/gtest.h>

#include <array>

#include "server/problem.h"

namespace spherematch {
namespace {

constexpr std::array<Representation, 3> offers{{{"json", "application/json"}, {"npz", "application/x-npz"}, {"txt", "text/plain"}}};

std::string_view chosen(std::string_view accept) {
  const Representation* offer = negotiate(accept, offers);
  return offer == nullptr ? "none" : offer->format;
}

TEST(Negotiation, FollowsTheWeights) {
  EXPECT_EQ(chosen(""), "json");
  EXPECT_EQ(chosen("*/*"), "json");
  EXPECT_EQ(chosen("text/plain"), "txt");
  EXPECT_EQ(chosen("text/*"), "txt");
  EXPECT_EQ(chosen("TEXT/Plain"), "txt");
  EXPECT_EQ(chosen("application/*"), "json");
  EXPECT_EQ(chosen("application/x-npz, application/json;q=0.9"), "npz");
  EXPECT_EQ(chosen("application/json;q=0.1, text/plain; q=0.2"), "txt");
  EXPECT_EQ(chosen("text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8"), "json");
}

TEST(Negotiation, TheMostSpecificRangeDecides) {
  EXPECT_EQ(chosen("*/*;q=0.1, application/json;q=0"), "npz");
  EXPECT_EQ(chosen("application/*;q=0.2, application/x-npz;q=0.9, text/plain;q=0.5"), "npz");
  EXPECT_EQ(chosen("application/x-npz;q=0, */*;q=0"), "none");
}

TEST(Negotiation, NothingFits) {
  EXPECT_EQ(chosen("image/png"), "none");
  EXPECT_EQ(chosen("application/json;q=0"), "none");
  EXPECT_EQ(chosen("application/json;q=x"), "none");
  EXPECT_EQ(chosen("application/json;q=2"), "none");
  EXPECT_EQ(chosen(",,;"), "none");
}

TEST(Negotiation, TheParameterOverridesTheHeader) {
  EXPECT_EQ(choose_representation("npz", "image/png", offers).format, "npz");
  EXPECT_EQ(choose_representation(std::nullopt, "text/plain", offers).format, "txt");
}

TEST(Negotiation, RefusalsListWhatExists) {
  const auto refusal = [](const std::optional<std::string>& format) -> api::Problem {
    try {
      (void)choose_representation(format, "image/png", offers);
    } catch (const ProblemError& error) {
      return error.problem();
    }
    return {};
  };
  EXPECT_EQ(refusal("exe").code, api::Code::invalid_parameter);
  EXPECT_EQ(refusal("exe").detail, "format: 'exe' is not one of json, npz, txt");
  EXPECT_EQ(refusal(std::nullopt).code, api::Code::not_acceptable);
  EXPECT_EQ(refusal(std::nullopt).detail, "available are application/json, application/x-npz, text/plain");
}

}  // namespace
}  // namespace spherematch
