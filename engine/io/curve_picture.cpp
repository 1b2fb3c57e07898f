#include "engine/io/curve_picture.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>

#include "engine/io/markup.h"

namespace spherematch {

namespace {

constexpr double width = 640, height = 480;
constexpr double left = 64, right = 620, top = 44, bottom = 424;
/// Told apart also by those who do not tell red from green (Okabe & Ito).
constexpr std::array<std::string_view, 8> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"};

std::string number(double value, int decimals = 2) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

double x_of(double share) { return left + share * (right - left); }
double y_of(double fraction) { return bottom - fraction * (bottom - top); }

std::string text_at(double x, double y, std::string_view anchor, std::string_view text, std::string_view more = {}) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + std::string(anchor) + "\"" + std::string(more) + ">" +
         escaped_markup(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, std::string_view colour) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" + number(y2) + "\" stroke=\"" +
         std::string(colour) + "\"/>\n";
}

/// With three digits, and no more zeros than needed.
std::string label(double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

std::string axes(const LinePicture& picture) {
  constexpr int ticks = 5;
  std::string svg;
  for (int i = 0; i <= ticks; ++i) {
    const double share = static_cast<double>(i) / ticks;
    const double y = share * picture.y_end;
    svg += line(left, y_of(share), right, y_of(share), "#dddddd");
    svg += line(x_of(share), top, x_of(share), bottom, "#dddddd");
    svg += text_at(left - 8, y_of(share) + 4, "end", picture.percent ? label(100 * y) + "%" : label(y));
    svg += text_at(x_of(share), bottom + 18, "middle", label(share * picture.x_end));
  }
  svg += line(left, bottom, right, bottom, "#333333") + line(left, top, left, bottom, "#333333");
  svg += text_at((left + right) / 2, bottom + 42, "middle", picture.x_axis);
  const double middle = (top + bottom) / 2;
  svg += text_at(18, middle, "middle", picture.y_axis, " transform=\"rotate(-90 18 " + number(middle) + ")\"");
  return svg + text_at((left + right) / 2, 26, "middle", picture.title, " font-size=\"15\"");
}

std::string polyline(const LinePicture& picture, const PictureLine& drawn, std::string_view colour) {
  std::string svg = "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" + std::string(colour) + "\" points=\"";
  for (std::size_t i = 0; i < drawn.points.size(); ++i) {
    if (i > 0) svg += ' ';
    const auto& [x, y] = drawn.points[i];
    svg.append(number(x_of(x / picture.x_end))).append(",").append(number(y_of(y / picture.y_end)));
  }
  return svg + "\"/>\n";
}

std::string legend_entry(double y, std::string_view name, std::string_view colour) {
  return line(right - 230, y, right - 202, y, colour) + text_at(right - 194, y + 4, "start", name);
}

}  // namespace

std::string encode_svg(const LinePicture& picture, std::span<const PictureLine> lines) {
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width, 0) + "\" height=\"" + number(height, 0) +
                    "\" viewBox=\"0 0 " + number(width, 0) + " " + number(height, 0) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + axes(picture);
  for (std::size_t i = 0; i < lines.size(); ++i) svg += polyline(picture, lines[i], colours[i % colours.size()]);
  constexpr double row = 18;
  double y = picture.legend_at_top ? top + row : bottom + 4 - row * static_cast<double>(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i, y += row) svg += legend_entry(y, lines[i].name, colours[i % colours.size()]);
  return svg + "</svg>\n";
}

PictureLine cumulative_line(const std::string& name, const std::vector<double>& curve) {
  PictureLine line{name, {}};
  const std::vector<double> thresholds = curve_thresholds();
  for (std::size_t i = 0; i < std::min(curve.size(), thresholds.size()); ++i) line.points.push_back({thresholds[i], curve[i]});
  return line;
}

LinePicture cumulative_picture(const std::string& title, const std::string& error_axis) {
  return {.title = title, .x_axis = error_axis, .y_axis = "points", .x_end = curve_end, .y_end = 1, .percent = true};
}

std::string encode_svg(const Evaluation& evaluation, const std::string& title) {
  std::vector<PictureLine> curves;
  const auto add = [&curves](const std::optional<MapError>& error, const char* name) {
    if (error && error->scored > 0) curves.push_back(cumulative_line(std::string(name) + ", mean " + number(error->mean, 4), error->curve));
  };
  add(evaluation.geodesic, "geodesic");
  add(evaluation.biharmonic, "biharmonic");
  add(evaluation.bijectivity, "there and back");
  return encode_svg(cumulative_picture(title, "distance to the truth, at unit area"), curves);
}

}  // namespace spherematch
