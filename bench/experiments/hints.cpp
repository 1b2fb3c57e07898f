// What hints do for a match: errors with a few of them, and with wrong ones among them.
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <random>

#include "bench/experiments/experiments.h"
#include "bench/experiments/pair_list.h"
#include "bench/experiments/prepared_shapes.h"
#include "bench/experiments/report.h"
#include "engine/engine.h"
#include "engine/evaluate/map_error.h"

namespace spherematch::bench {

namespace {

struct Hinting {
  std::size_t hints, wrong;
  const char* name;
};

constexpr Hinting hintings[] = {{0, 0, "none"}, {1, 0, "1"}, {3, 0, "3"}, {5, 0, "5"}, {5, 1, "5, one wrong"}, {10, 2, "10, two wrong"}};

/// The first is the landmark farthest from the mean of all, each further one that farthest from those before, by straight distances.
std::vector<Landmark> far_apart(const std::vector<Landmark>& landmarks, const Surface& source, std::size_t count) {
  const auto place = [&](const Landmark& landmark) -> Eigen::RowVector3d {
    return source.mesh.vertices.row(source.surface_vertex[static_cast<std::size_t>(landmark.source)]);
  };
  std::vector<Landmark> known;  // at vertices that were not dropped
  std::copy_if(landmarks.begin(), landmarks.end(), std::back_inserter(known),
               [&](const Landmark& landmark) { return source.surface_vertex[static_cast<std::size_t>(landmark.source)] >= 0; });
  Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
  for (const Landmark& landmark : known) mean += place(landmark) / static_cast<double>(known.size());
  std::vector<double> distances;
  for (const Landmark& landmark : known) distances.push_back((place(landmark) - mean).norm());
  std::vector<Landmark> chosen;
  while (chosen.size() < std::min(count, known.size())) {
    const auto farthest = std::max_element(distances.begin(), distances.end()) - distances.begin();
    chosen.push_back(known[static_cast<std::size_t>(farthest)]);
    for (std::size_t i = 0; i < known.size(); ++i) {
      const double distance = (place(known[i]) - place(chosen.back())).norm();
      distances[i] = chosen.size() == 1 ? distance : std::min(distances[i], distance);
    }
  }
  return chosen;
}

/// The landmarks as hints, of which the first `wrong` have any landmark's target.
std::vector<Hint> hints_of(const std::vector<Landmark>& chosen, const std::vector<Landmark>& all, std::size_t wrong) {
  std::mt19937 random(1);
  std::vector<Hint> hints;
  for (const Landmark& landmark : chosen) {
    const bool right = hints.size() >= wrong;
    hints.push_back({landmark.source, right ? landmark.target : all[random() % all.size()].target});
  }
  return hints;
}

struct Outcome {
  double error;
  bool flipped;
};

Outcome outcome_with(const Hinting& hinting, const MatchShape& source, const MatchShape& target, const GroundTruth& truth, int threads) {
  MatchParameters parameters;
  parameters.hints = hints_of(far_apart(truth.direct, source.surface(), hinting.hints), truth.direct, hinting.wrong);
  const Correspondence map = match(source, target, parameters, {}, threads).map;
  const auto error_at = [&](const std::vector<Landmark>& landmarks) {
    return geodesic_error(map, target.surface(), landmarks, {}, threads).mean;
  };
  const double error = error_at(truth.direct);
  return {error, !truth.mirrored.empty() && error_at(truth.mirrored) < error};
}

}  // namespace

void run_hints(const PairListSettings& settings) {
  ShapeStore store(settings.store);
  PreparedShapes shapes(store, settings.threads);
  Json json{{"experiment", "hints"}, {"engine", engine_version()}, {"pairs", Json::array()}};
  std::printf("%-40s", "");
  for (const Hinting& hinting : hintings) std::printf(" %14s", hinting.name);
  std::printf("\n");
  for (const PairSet& set : read_pair_list(settings)) {
    for (const ListedPair& pair : set.pairs) {
      const MatchShape &source = shapes(pair.source), &target = shapes(pair.target);
      const GroundTruth truth = truth_of(pair, source.surface(), target.surface());
      const std::string from = pair.source.stem().string(), to = pair.target.stem().string();
      Json found{{"set", set.name}, {"src", from}, {"tgt", to}, {"errors", Json::array()}};
      std::printf("%-40s", (set.name + " " + from + " " + to).c_str());
      for (const Hinting& hinting : hintings) {
        const auto [error, flipped] = outcome_with(hinting, source, target, truth, settings.threads);
        std::printf(" %7.2f %-6s", 100 * error, flipped ? "turned" : "");
        std::fflush(stdout);
        found["errors"].push_back({{"hints", hinting.hints}, {"wrong", hinting.wrong}, {"error", error}, {"flipped", flipped}});
      }
      std::printf("\n");
      json["pairs"].push_back(std::move(found));
    }
    if (!settings.json.empty()) write_text(settings.json, json.dump(1) + "\n");
  }
}

}  // namespace spherematch::bench
