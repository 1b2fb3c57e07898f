#include "engine/data/surface.h"

#include <string>

#include "engine/data/error.h"

namespace spherematch {

void ReadOptions::validate() const {
  if (simplify != 0 && simplify < least_simplify)
    throw EngineError(ErrorCode::invalid_parameter, "simplify must be 0 or at least " + std::to_string(least_simplify));
}

}  // namespace spherematch
