// Cumulative error curves as a picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/data/evaluation.h"

namespace spherematch {

/// Fraction of the points, from 0 to 1, whose error is at most each of evenly spaced thresholds from 0 to the picture's end.
struct ErrorCurve {
  std::string name;
  std::vector<double> fractions;  ///< at least two
};

struct CurvePicture {
  std::string title;
  std::string error_axis;  ///< what the errors are and their unit
  double end = 0.25;       ///< the last threshold; positive
};

/// SVG of 640 x 480 with axes, a legend and one line for each curve; colours repeat after eight. The bytes depend on the arguments alone.
/// Text is escaped.
[[nodiscard]] std::string encode_svg(const CurvePicture& picture, std::span<const ErrorCurve> curves);

/// The curves that an evaluation has, with the means in the legend: geodesic, biharmonic, there and back.
[[nodiscard]] std::string encode_svg(const Evaluation& evaluation, const std::string& title);

}  // namespace spherematch
