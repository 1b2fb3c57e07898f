// The items of an array as numbers. Internal to engine/io.
#pragma once

#include <Eigen/Core>

#include "engine/io/array.h"

namespace spherematch {

/// (rows, items of a row), as double: integers beyond 2^53 are rounded. Booleans are 0 and 1.
/// @throws EngineError(invalid_parameter) for what is neither boolean nor integer nor floating-point
[[nodiscard]] Eigen::MatrixXd numbers_of(const Array& array);

}  // namespace spherematch
