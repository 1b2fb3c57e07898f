// What all experiments are told.
#pragma once

#include <string>
#include <vector>

#include "engine/data/parameters.h"

namespace spherematch::bench {

struct ExperimentSettings {
  std::vector<std::string> places;  ///< folders and OFF files
  bool whole_folders = false;
  std::vector<std::string> variants{"rotation", "flow", "default"};
  int most_pairs = 0;              ///< of a class, taken evenly from all; 0 for all
  bool paper_preparation = false;  ///< PreprocessParameters::paper(), which takes its time
  int threads = 2;
  std::string out = ".";  ///< an existing folder for NAME.json and NAME*.svg

  [[nodiscard]] PreprocessParameters preparation() const {
    return paper_preparation ? PreprocessParameters::paper() : PreprocessParameters{};
  }
};

}  // namespace spherematch::bench
