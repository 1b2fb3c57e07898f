#include "engine/io/vertex_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "engine/data/error.h"
#include "engine/io/array_numbers.h"

namespace spherematch {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::pair<std::string_view, Meaning>, 5> meanings{{{"color", Meaning::color},
                                                                        {"texture", Meaning::texture},
                                                                        {"label", Meaning::label},
                                                                        {"value", Meaning::value},
                                                                        {"weights", Meaning::weights}}};

/// Told apart also by most who see few colours; neighbours in the list differ in brightness too.
const Eigen::Matrix<double, 12, 3> palette = (Eigen::Matrix<double, 12, 3>() << 0.12, 0.47, 0.71,  //
                                              0.99, 0.75, 0.44,                                    //
                                              0.20, 0.63, 0.17,                                    //
                                              0.98, 0.60, 0.60,                                    //
                                              0.42, 0.24, 0.60,                                    //
                                              0.95, 0.90, 0.40,                                    //
                                              0.89, 0.10, 0.11,                                    //
                                              0.65, 0.81, 0.89,                                    //
                                              0.69, 0.35, 0.16,                                    //
                                              0.70, 0.87, 0.54,                                    //
                                              0.80, 0.30, 0.65,                                    //
                                              0.35, 0.75, 0.75)
                                                 .finished();

auto palette_color(Eigen::Index number) { return palette.row(number % palette.rows()); }

/// From dark violet by green to yellow, of steadily rising brightness.
Eigen::RowVector3d scale_color(double share) {
  const Eigen::Matrix<double, 5, 3> stops = (Eigen::Matrix<double, 5, 3>() << 0.27, 0.00, 0.33,  //
                                             0.23, 0.32, 0.55,                                   //
                                             0.13, 0.57, 0.55,                                   //
                                             0.37, 0.79, 0.38,                                   //
                                             0.99, 0.91, 0.14)
                                                .finished();
  const double place = std::clamp(share, 0.0, 1.0) * 4;
  const auto first = std::min<Eigen::Index>(static_cast<Eigen::Index>(place), 3);
  const double rest = place - static_cast<double>(first);
  return (1 - rest) * stops.row(first) + rest * stops.row(first + 1);
}

[[noreturn]] void refuse(const Array& array, const std::string& what) {
  std::string shape;
  for (const std::int64_t length : array.shape) shape += (shape.empty() ? "" : ", ") + std::to_string(length);
  throw EngineError(ErrorCode::invalid_parameter, "as: " + what + "; the array has dtype " + array.dtype + " and shape (" + shape + ")");
}

bool is_whole(const Array& array) { return array.kind == 'b' || array.kind == 'i' || array.kind == 'u'; }

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Of what is finite.
Range range_of(const Eigen::MatrixXd& numbers) {
  Range range;
  for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
    if (!std::isfinite(numbers(i, 0))) continue;
    range.low = std::min(range.low, numbers(i, 0));
    range.high = std::max(range.high, numbers(i, 0));
  }
  return range;
}

Eigen::RowVector3d mean_color(const Eigen::RowVectorXd& weights) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double total = 0;
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const double weight = std::max(0.0, weights(k));
    sum += weight * palette_color(k);
    total += weight;
  }
  return total > 0 && std::isfinite(total) ? Eigen::RowVector3d(sum / total) : Eigen::RowVector3d::Constant(not_a_number);
}

Eigen::RowVector3d paint_of(Meaning meaning, const Eigen::RowVectorXd& row, double unit, const Range& range) {
  if (!row.allFinite()) return Eigen::RowVector3d::Constant(not_a_number);
  switch (meaning) {
    case Meaning::color:
      return (row.head<3>() / unit).cwiseMax(0).cwiseMin(1);
    case Meaning::texture:
      return {row(0), row(1), 0};
    case Meaning::label:
      return row(0) < 0 ? Eigen::RowVector3d::Constant(not_a_number) : Eigen::RowVector3d(palette_color(static_cast<Eigen::Index>(row(0))));
    case Meaning::value:
      return scale_color(range.high > range.low ? (row(0) - range.low) / (range.high - range.low) : 0.5);
    case Meaning::weights:
      return mean_color(row);
  }
  return Eigen::RowVector3d::Constant(not_a_number);
}

VertexData painted(Meaning meaning, Eigen::MatrixXd numbers, double unit, const Range& range) {
  VertexData data{.meaning = meaning, .numbers = std::move(numbers), .paint = {}};
  data.paint.resize(data.numbers.rows(), 3);
  for (Eigen::Index i = 0; i < data.paint.rows(); ++i) data.paint.row(i) = paint_of(meaning, data.numbers.row(i), unit, range);
  return data;
}

void check_labels(const Array& array, const Eigen::MatrixXd& numbers) {
  const auto fits = [](double label) {
    return label >= std::numeric_limits<std::int32_t>::min() && label <= std::numeric_limits<std::int32_t>::max();
  };
  if (!std::all_of(numbers.data(), numbers.data() + numbers.size(), fits)) refuse(array, "labels are numbers of 32 bits");
}

}  // namespace

std::optional<Meaning> meaning_named(std::string_view name) {
  for (const auto& [known, meaning] : meanings) {
    if (known == name) return meaning;
  }
  return std::nullopt;
}

Meaning likely_meaning(const Array& array) {
  const std::size_t columns = array.row_bytes() / array.item_bytes;
  if (is_whole(array) && columns == 1) return Meaning::label;
  if (array.kind == 'u' && array.item_bytes == 1 && (columns == 3 || columns == 4)) return Meaning::color;
  if (array.kind != 'f' || columns == 0) refuse(array, "nothing can be shown of this");
  return columns == 1 ? Meaning::value : columns == 2 ? Meaning::texture : columns == 3 ? Meaning::color : Meaning::weights;
}

void check_meaning(Meaning meaning, const Array& array) {
  const auto columns = static_cast<Eigen::Index>(array.row_bytes() / array.item_bytes);
  const bool real = array.kind == 'f';
  const bool bytes = array.kind == 'u' && array.item_bytes == 1;
  if (meaning == Meaning::color && !((columns == 3 || columns == 4) && (real || bytes)))
    refuse(array, "color takes three or four columns of uint8, or of floating-point numbers from 0 to 1");
  if (meaning == Meaning::texture && !(columns == 2 && real)) refuse(array, "texture takes two columns of floating-point numbers");
  if (meaning == Meaning::label && !(columns == 1 && is_whole(array))) refuse(array, "label takes one column of integers or booleans");
  if (meaning == Meaning::value && !(columns == 1 && (real || is_whole(array)))) refuse(array, "value takes one column of numbers");
  if (meaning == Meaning::weights && !(columns >= 1 && columns <= most_weights && real))
    refuse(array, "weights takes one to " + std::to_string(most_weights) + " columns of floating-point numbers");
}

Colors VertexData::colors() const {
  return paint
      .unaryExpr([](double share) { return std::isnan(share) ? neutral_gray : static_cast<std::uint8_t>(std::lround(255 * share)); })
      .eval();
}

VertexDataPair vertex_data(Meaning meaning, const Array& carried, const Array& original, const Correspondence& map) {
  if (carried.rows() != static_cast<std::int64_t>(map.vertex.size())) throw std::invalid_argument("the array is of another map");
  check_meaning(meaning, original);
  Eigen::MatrixXd numbers = numbers_of(original);
  if (meaning == Meaning::label) check_labels(original, numbers);
  const double unit = original.kind == 'f' ? 1 : 255;
  const Range range = range_of(numbers);
  VertexDataPair pair{.source = painted(meaning, numbers_of(carried), unit, range), .target = {}};
  pair.target = painted(meaning, std::move(numbers), unit, range);
  for (std::size_t i = 0; i < map.vertex.size(); ++i) {
    if (map.vertex[i] < 0) pair.source.paint.row(static_cast<Eigen::Index>(i)).setConstant(not_a_number);
  }
  return pair;
}

}  // namespace spherematch
