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

/// Of experiments on a list of pairs.
struct PairListSettings {
  std::string pairs = "samples/pairs.json";
  std::string data = "samples";            ///< folder of the sets' folders
  std::string store = "data/ablation.db";  ///< of prepared shapes
  std::string json{};                      ///< empty for none
  int most_pairs = 0;                      ///< the first ones of each set; 0 for all
  int threads = 2;
};

struct AblationSettings : PairListSettings {
  int runs = 1;        ///< of each match, of which the median time is taken
  bool paper = false;  ///< also the paper's method
};

}  // namespace spherematch::bench
