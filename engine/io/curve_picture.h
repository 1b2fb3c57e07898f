// Lines in a diagram: cumulative error curves, and what else is drawn over an axis.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/data/evaluation.h"

namespace spherematch {

struct PictureLine {
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< (x, y), joined in their order
};

/// Both axes begin at zero.
struct LinePicture {
  std::string title;
  std::string x_axis;
  std::string y_axis;
  double x_end = 1;  ///< positive, as y_end
  double y_end = 1;
  bool percent = false;        ///< y is labelled as a share
  bool legend_at_top = false;  ///< else at the bottom, both on the right
};

/// SVG of 640 x 480 with axes, a legend and one line for each entry; colours repeat after eight. The bytes depend on the arguments alone.
/// Text is escaped.
[[nodiscard]] std::string encode_svg(const LinePicture& picture, std::span<const PictureLine> lines);

/// A cumulative curve as MapError has it, over the thresholds.
[[nodiscard]] PictureLine cumulative_line(const std::string& name, const std::vector<double>& curve);

/// The frame that cumulative curves are drawn in.
[[nodiscard]] LinePicture cumulative_picture(const std::string& title, const std::string& error_axis);

/// The curves that an evaluation has, with the means in the legend: geodesic, biharmonic, there and back.
[[nodiscard]] std::string encode_svg(const Evaluation& evaluation, const std::string& title);

}  // namespace spherematch
