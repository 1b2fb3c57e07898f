// What is known at the vertices of one shape, carried along a map to the vertices of another.
#pragma once

#include "engine/data/correspondence.h"
#include "engine/io/array.h"

namespace spherematch {

enum class Interpolation {
  linear,   ///< the mean of the rows of the three corners, with the weights of the image
  nearest,  ///< the row of the corner nearest to the image, byte for byte
};

/// Whether linear interpolation is possible, and the better choice: floating-point numbers.
[[nodiscard]] inline bool is_floating(const Array& values) { return values.kind == 'f'; }

/// @throws EngineError(invalid_parameter) for linear interpolation of what is not floating-point
void check_interpolation(const Array& values, Interpolation interpolation);

/// `values` has a row for each uploaded target vertex; the result has one for each uploaded source vertex, of the same dtype, byte order
/// and trailing shape. Sums are made in double, corner by corner; a corner of weight zero has no part in them, not even where its value
/// is not finite. The row of a dropped source vertex is NaN in floating-point arrays, else zero bytes. Linear time. Thread-safe.
/// @throws EngineError as check_interpolation(), std::invalid_argument when the map goes to a row that the values do not have
[[nodiscard]] Array transfer(const Array& values, const Correspondence& map, Interpolation interpolation);

}  // namespace spherematch
