#include "engine/io/curve_picture.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace spherematch {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(CurvePicture, HasALineAndANameForEachCurve) {
  const std::vector<ErrorCurve> curves{{"first", {0, 0.5, 1}}, {"second", {1, 1, 1}}};
  const std::string svg = encode_svg({.title = "cats", .error_axis = "error", .end = 0.25}, curves);
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  for (const char* text : {">first<", ">second<", ">cats<", ">error<", ">0.250<", ">100%<"}) EXPECT_EQ(count(svg, text), 1U) << text;
  // From the left end at the bottom through the middle to the right end at the top; and all along the top.
  EXPECT_NE(svg.find("points=\"64.00,424.00 342.00,234.00 620.00,44.00\""), std::string::npos);
  EXPECT_NE(svg.find("points=\"64.00,44.00 342.00,44.00 620.00,44.00\""), std::string::npos);
}

TEST(CurvePicture, EscapesWhatIsNotItsOwn) {
  const std::vector<ErrorCurve> curves{{"a<b>&\"c\"\n", {0, 1}}};
  const std::string svg = encode_svg({.title = "<script>", .error_axis = "", .end = 1}, curves);
  EXPECT_NE(svg.find(">a&lt;b&gt;&amp;&quot;c&quot; <"), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

TEST(CurvePicture, DrawsWhatAnEvaluationHas) {
  Evaluation evaluation;
  EXPECT_EQ(count(encode_svg(evaluation, "nothing"), "<polyline"), 0U);
  evaluation.geodesic = MapError{.mean = 0.0125, .curve = std::vector<double>(curve_steps + 1, 0.5), .scored = 2};
  evaluation.bijectivity = MapError{};  // nothing was scored
  const std::string svg = encode_svg(evaluation, "a to b");
  EXPECT_EQ(count(svg, "<polyline"), 1U);
  EXPECT_NE(svg.find(">geodesic, mean 0.0125<"), std::string::npos);
}

}  // namespace
}  // namespace spherematch
