#include "bench/pair_benchmark.h"

#include <chrono>
#include <optional>
#include <span>
#include <utility>

#include "bench/mesh_files.h"
#include "bench/process_usage.h"
#include "bench/results_json.h"
#include "engine/engine.h"

namespace spherematch::bench {

namespace {

PairResult run_here(const std::string& source, const std::string& target, std::int32_t vertices, const BenchmarkSettings& settings) {
  PairResult result;
  result.source = source;
  result.target = target;
  result.vertices = vertices;
  const PreprocessedShape other = preprocess(read_resized(target, vertices), {}, {}, settings.threads);
  const std::string file = resized_off(source, vertices);

  const auto start = std::chrono::steady_clock::now();
  const Surface surface = read_surface(std::as_bytes(std::span(file)), ".off", {}, ReadLimits::none());
  result.read_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  reset_peak_memory();
  std::optional<PreprocessedShape> shape;
  result.preparation = measure(settings.runs, settings.budget_seconds, [&] {
    shape.reset();
    shape = preprocess(surface, {}, {}, settings.threads);
    return shape->seconds;
  });
  result.preparation_mebibytes = peak_mebibytes();

  reset_peak_memory();
  MatchParameters parameters;
  parameters.both = settings.both;
  result.match =
      measure(settings.runs, settings.budget_seconds, [&] { return match(*shape, other, parameters, {}, settings.threads).seconds; });
  result.match_mebibytes = peak_mebibytes();
  return result;
}

}  // namespace

PairResult run_pair(const std::string& source, const std::string& target, std::int32_t vertices, const BenchmarkSettings& settings) {
  return result_from(in_child([&] { return to_text(run_here(source, target, vertices, settings)); }));
}

}  // namespace spherematch::bench
