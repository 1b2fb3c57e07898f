#include "bench/experiments/pair_list.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/experiments/shape_classes.h"

namespace spherematch::bench {

namespace {

namespace fs = std::filesystem;

constexpr int drawn_points = 500;

ListedPair pair_of(const nlohmann::json& entry, const fs::path& folder) {
  const auto mesh = [&](const char* member) { return folder / (entry.at(member).get<std::string>() + ".off"); };
  const std::string truth = entry.at("truth");
  if (truth != "identity" && truth != "vts") throw std::runtime_error("truth is '" + truth + "', neither identity nor vts");
  return {mesh("src"), mesh("tgt"), truth == "identity"};
}

}  // namespace

std::vector<PairSet> read_pair_list(const PairListSettings& settings) {
  const fs::path file = settings.pairs;
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  std::vector<PairSet> sets;
  try {
    const nlohmann::json list = nlohmann::json::parse(in);
    for (const nlohmann::json& entry : list.at("pairs")) {
      const std::string name = entry.at("set");
      auto set = std::find_if(sets.begin(), sets.end(), [&](const PairSet& known) { return known.name == name; });
      if (set == sets.end()) set = sets.insert(sets.end(), PairSet{name, {}});
      if (settings.most_pairs == 0 || set->pairs.size() < static_cast<std::size_t>(settings.most_pairs))
        set->pairs.push_back(pair_of(entry, fs::path(settings.data) / name));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return sets;
}

GroundTruth truth_of(const ListedPair& pair, const Surface& source, const Surface& target) {
  if (pair.identity) {
    GroundTruth truth;
    for (const std::int32_t vertex : vertices_drawn_by_area(source, drawn_points)) truth.direct.push_back({vertex, vertex});
    return truth;
  }
  const auto truth = truth_between(pair.source, pair.target, source, target);
  if (!truth || truth->dense) {
    throw std::runtime_error("landmarks beside " + pair.source.string() + " and " + pair.target.string() + " are missing");
  }
  return *truth;
}

}  // namespace spherematch::bench
