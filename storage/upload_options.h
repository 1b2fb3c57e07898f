// The options of an upload that change what a shape is made of, as the canonical text that goes into its id.
#pragma once

#include <string>

#include "engine/data/surface.h"

namespace spherematch {

/// Server and command line use the same text, so that they find each other's shapes. It is stored: never change it.
[[nodiscard]] inline std::string upload_options(const ReadOptions& options) {
  std::string text = options.repair == RepairMode::fill ? "repair=fill" : "repair=none";
  if (options.simplify > 0) text += ";simplify=" + std::to_string(options.simplify);
  return text;
}

}  // namespace spherematch
