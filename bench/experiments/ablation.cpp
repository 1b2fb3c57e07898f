// What each part of a match contributes: errors and times with the part changed or left out.
#include <algorithm>
#include <cstdio>

#include "bench/experiments/experiments.h"
#include "bench/experiments/pair_list.h"
#include "bench/experiments/prepared_shapes.h"
#include "bench/experiments/report.h"
#include "bench/experiments/variants.h"
#include "bench/stage_times.h"
#include "engine/engine.h"
#include "engine/evaluate/map_error.h"

namespace spherematch::bench {

namespace {

struct ScoredMap {
  double error = 0;
  bool flipped = false;
  double seconds = 0;
};

/// The maps of one set with one variant, in the order of the pairs.
struct Row {
  std::string name;
  std::vector<ScoredMap> maps;
};

struct Summary {
  double error = 0;
  double worst = 0;
  int flipped = 0;
  double seconds = 0;
};

Summary summary_of(const Row& row) {
  Summary summary;
  const auto count = static_cast<double>(row.maps.size());
  for (const ScoredMap& map : row.maps) {
    summary.error += map.error / count;
    summary.worst = std::max(summary.worst, map.error);
    summary.flipped += map.flipped ? 1 : 0;
    summary.seconds += map.seconds / count;
  }
  return summary;
}

ScoredMap score(const MatchShape& source, const MatchShape& target, const MatchParameters& parameters, const GroundTruth& truth,
                const AblationSettings& settings) {
  ScoredMap scored;
  MatchResult result;
  std::vector<double> seconds;
  for (int run = 0; run < settings.runs; ++run) {
    result = match(source, target, parameters, {}, settings.threads);
    seconds.push_back(total_of(result.seconds));
  }
  scored.seconds = median(std::move(seconds));
  scored.error = geodesic_error(result.map, target.surface(), truth.direct, {}, settings.threads).mean;
  if (truth.mirrored.empty()) return scored;
  scored.flipped = geodesic_error(result.map, target.surface(), truth.mirrored, {}, settings.threads).mean < scored.error;
  return scored;
}

/// Every variant of a pair before the next pair, so that what else the machine does falls on all alike.
std::vector<Row> run_set(const PairSet& set, ShapeStore& store, const std::vector<Variant>& variants, const AblationSettings& settings) {
  PreparedShapes shapes(store, settings.threads);
  std::vector<Row> rows;
  for (const Variant& variant : variants) rows.push_back({variant.name, {}});
  for (const ListedPair& pair : set.pairs) {
    const MatchShape &source = shapes(pair.source), &target = shapes(pair.target);
    const GroundTruth truth = truth_of(pair, source.surface(), target.surface());
    for (std::size_t v = 0; v < variants.size(); ++v)
      rows[v].maps.push_back(score(source, target, variants[v].parameters, truth, settings));
  }
  return rows;
}

void print(const PairSet& set, const std::vector<Row>& rows) {
  std::printf("%s, %zu maps\n%-28s %7s %7s %8s %9s\n", set.name.c_str(), set.pairs.size(), "", "error", "worst", "flipped", "ms");
  for (const Row& row : rows) {
    const Summary summary = summary_of(row);
    std::printf("%-28s %7.2f %7.2f %8d %9.0f\n", row.name.c_str(), 100 * summary.error, 100 * summary.worst, summary.flipped,
                1000 * summary.seconds);
  }
  std::printf("\n");
  std::fflush(stdout);
}

Json to_json(const PairSet& set, const std::vector<Row>& rows) {
  Json json{{"name", set.name}, {"variants", Json::array()}};
  for (const Row& row : rows) {
    const Summary summary = summary_of(row);
    Json pairs = Json::array();
    for (std::size_t i = 0; i < set.pairs.size(); ++i) {
      pairs.push_back({{"src", set.pairs[i].source.stem().string()},
                       {"tgt", set.pairs[i].target.stem().string()},
                       {"error", row.maps[i].error},
                       {"flipped", row.maps[i].flipped},
                       {"seconds", row.maps[i].seconds}});
    }
    json["variants"].push_back({{"name", row.name},
                                {"error", summary.error},
                                {"worst", summary.worst},
                                {"flipped", summary.flipped},
                                {"seconds", summary.seconds},
                                {"pairs", std::move(pairs)}});
  }
  return json;
}

}  // namespace

void run_ablation(const AblationSettings& settings) {
  const std::vector<Variant> variants = ablation_variants(settings.paper);
  ShapeStore store(settings.store);
  Json json{{"experiment", "ablation"}, {"engine", engine_version()}, {"runs", settings.runs}, {"sets", Json::array()}};
  for (const PairSet& set : read_pair_list(settings)) {
    const std::vector<Row> rows = run_set(set, store, variants, settings);
    print(set, rows);
    json["sets"].push_back(to_json(set, rows));
    if (!settings.json.empty()) write_text(settings.json, json.dump(1) + "\n");
  }
}

}  // namespace spherematch::bench
