// Arrays in: NPY files of versions 1 to 3. Safe on untrusted bytes.
#pragma once

#include <string>

#include "engine/io/array.h"

namespace spherematch {

/// Reads an array of a plain dtype: booleans, integers, floating-point and complex numbers, byte and text strings of fixed length, raw
/// records, dates and times. Fortran order becomes C order. The file must end with its last item. The array keeps the memory of the
/// file; Fortran order takes as much again for the time of the call. Nothing in the file is executed. Thread-safe.
/// @throws EngineError(malformed_array) with the reason; also for objects, for structured dtypes, for floating-point numbers of more
/// than eight bytes, which differ between machines, and for an array without dimensions
[[nodiscard]] Array decode_npy(std::string file);

}  // namespace spherematch
