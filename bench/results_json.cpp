#include "bench/results_json.h"

#include <nlohmann/json.hpp>

#include "engine/engine.h"

namespace spherematch::bench {

using Json = nlohmann::ordered_json;

namespace {

// Stages are a list of pairs rather than an object: their order is the order in which they started.
Json to_json(const Timing& timing, double mebibytes) {
  return {{"seconds", timing.seconds}, {"cpu_seconds", timing.cpu_seconds}, {"runs", timing.runs}, {"peak_mib", mebibytes}};
}

Timing timing_from(const Json& json) {
  return {.seconds = json.at("seconds").get<StageSeconds>(), .cpu_seconds = json.at("cpu_seconds"), .runs = json.at("runs")};
}

Json to_json(const PairResult& result) {
  return {{"source", result.source},
          {"target", result.target},
          {"vertices", result.vertices},
          {"read_seconds", result.read_seconds},
          {"preparation", to_json(result.preparation, result.preparation_mebibytes)},
          {"match", to_json(result.match, result.match_mebibytes)}};
}

}  // namespace

std::string to_text(const PairResult& result) { return to_json(result).dump(); }

PairResult result_from(std::string_view text) {
  const Json json = Json::parse(text);
  return {.source = json.at("source"),
          .target = json.at("target"),
          .vertices = json.at("vertices"),
          .read_seconds = json.at("read_seconds"),
          .preparation = timing_from(json.at("preparation")),
          .preparation_mebibytes = json.at("preparation").at("peak_mib"),
          .match = timing_from(json.at("match")),
          .match_mebibytes = json.at("match").at("peak_mib")};
}

std::string file_text(const BenchmarkSettings& settings, const std::vector<PairResult>& results) {
  Json file = {{"engine", engine_version()}, {"threads", settings.threads}, {"both", settings.both}, {"results", Json::array()}};
  for (const PairResult& result : results) file["results"].push_back(to_json(result));
  return file.dump(1) + "\n";
}

}  // namespace spherematch::bench
