#include "engine/data/preprocessed_shape.h"

#include <cstdio>

namespace spherematch {

std::string hks_name(double time) {
  char name[40];
  std::snprintf(name, sizeof name, "hks_%g", time);
  return name;
}

}  // namespace spherematch
