#include "engine/io/curve_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace spherematch {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(LinePicture, HasALineAndANameForEachEntry) {
  const std::vector<PictureLine> lines{{"first", {{0, 0}, {5, 1}, {10, 2}}}, {"second", {{0, 2}, {10, 2}}}};
  const std::string svg = encode_svg({.title = "cats", .x_axis = "steps", .y_axis = "error", .x_end = 10, .y_end = 2}, lines);
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  for (const char* text : {">first<", ">second<", ">cats<", ">steps<", ">error<", ">10<", ">0.4<"}) EXPECT_EQ(count(svg, text), 1U) << text;
  // From the left end at the bottom through the middle to the right end at the top; and all along the top.
  EXPECT_NE(svg.find("points=\"64.00,424.00 342.00,234.00 620.00,44.00\""), std::string::npos);
  EXPECT_NE(svg.find("points=\"64.00,44.00 620.00,44.00\""), std::string::npos);
}

TEST(LinePicture, EscapesWhatIsNotItsOwn) {
  const std::vector<PictureLine> lines{{"a<b>&\"c\"\n", {{0, 1}}}};
  const std::string svg = encode_svg({.title = "<script>", .x_axis = {}, .y_axis = {}}, lines);
  EXPECT_NE(svg.find(">a&lt;b&gt;&amp;&quot;c&quot; <"), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

TEST(LinePicture, CumulativeCurvesStandOverTheirThresholds) {
  std::vector<double> curve(curve_steps + 1, 0.5);
  curve.back() = 1;
  const PictureLine line = cumulative_line("error", curve);
  ASSERT_EQ(line.points.size(), curve.size());
  EXPECT_EQ(line.points.front(), (std::array<double, 2>{0, 0.5}));
  EXPECT_EQ(line.points.back(), (std::array<double, 2>{curve_end, 1}));
  EXPECT_EQ(count(encode_svg(cumulative_picture("", ""), std::vector<PictureLine>{line}), ">100%<"), 1U);
}

TEST(LinePicture, DrawsWhatAnEvaluationHas) {
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
