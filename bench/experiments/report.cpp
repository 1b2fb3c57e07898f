#include "bench/experiments/report.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "engine/engine.h"
#include "engine/io/curve_picture.h"

namespace spherematch::bench {

namespace {

Json error_json(const MapError& error) {
  return {{"mean", error.mean}, {"median", error.median}, {"p95", error.p95}, {"auc", error.auc}, {"curve", error.curve}};
}

Json pair_json(const PairEvaluation& pair) {
  const Evaluation& evaluation = pair.evaluation;
  Json json{{"src", pair.source}, {"tgt", pair.target}};
  if (evaluation.geodesic) json["geodesic"] = evaluation.geodesic->mean;
  if (evaluation.biharmonic) json["biharmonic"] = evaluation.biharmonic->mean;
  if (evaluation.symmetric_integral) json["symmetric_integral"] = *evaluation.symmetric_integral;
  if (evaluation.flipped) json["flipped"] = *evaluation.flipped;
  json["coverage"] = evaluation.coverage.area;
  json["edge_distortion"] = evaluation.continuity.edge_distortion;
  if (evaluation.bijectivity) json["bijectivity"] = evaluation.bijectivity->mean;
  return json;
}

/// How many maps are flipped.
std::size_t flips(const VariantResults& results) {
  std::size_t count = 0;
  for (const PairEvaluation& pair : results.pairs) count += pair.evaluation.flipped.value_or(false) ? 1 : 0;
  return count;
}

Json variant_json(const VariantResults& results) {
  Json json{{"name", results.name}, {"maps", results.pairs.size()}, {"flipped", flips(results)}};
  json["biharmonic"] = error_json(average(results, &Evaluation::biharmonic));
  json["geodesic"] = error_json(average(results, &Evaluation::geodesic));
  json["pairs"] = Json::array();
  for (const PairEvaluation& pair : results.pairs) json["pairs"].push_back(pair_json(pair));
  return json;
}

}  // namespace

std::vector<VariantResults> no_results(const std::vector<Variant>& variants) {
  std::vector<VariantResults> results(variants.size());
  for (std::size_t v = 0; v < variants.size(); ++v) results[v].name = variants[v].name;
  return results;
}

MapError average(const VariantResults& results, ErrorMember error) {
  MapError mean;
  for (const PairEvaluation& pair : results.pairs) mean.scored += pair.evaluation.*error ? 1 : 0;
  if (mean.scored == 0) return mean;
  mean.curve.assign(curve_steps + 1, 0.0);
  const double share = 1.0 / mean.scored;
  for (const PairEvaluation& pair : results.pairs) {
    const std::optional<MapError>& one = pair.evaluation.*error;
    if (!one) continue;
    mean.mean += share * one->mean;
    mean.median += share * one->median;
    mean.p95 += share * one->p95;
    mean.max += share * one->max;
    mean.auc += share * one->auc;
    for (std::size_t i = 0; i < one->curve.size(); ++i) mean.curve[i] += share * one->curve[i];
  }
  return mean;
}

Json to_json(const std::string& experiment, const ExperimentSettings& settings, const std::vector<VariantResults>& results) {
  Json json{{"experiment", experiment},
            {"engine", engine_version()},
            {"paper_preparation", settings.paper_preparation},
            {"thresholds", curve_thresholds()}};
  json["variants"] = Json::array();
  for (const VariantResults& variant : results) json["variants"].push_back(variant_json(variant));
  return json;
}

std::string curves_svg(const std::string& title, const std::string& axis, const std::vector<VariantResults>& results, ErrorMember error) {
  std::vector<PictureLine> lines;
  for (const VariantResults& variant : results) {
    const MapError mean = average(variant, error);
    if (mean.scored > 0) lines.push_back(cumulative_line(variant.name, mean.curve));
  }
  return encode_svg(cumulative_picture(title, axis), lines);
}

void print(const std::vector<VariantResults>& results) {
  for (const VariantResults& variant : results) {
    const MapError geodesic = average(variant, &Evaluation::geodesic), biharmonic = average(variant, &Evaluation::biharmonic);
    std::printf("%-16s %4zu maps, %3zu flipped; mean errors times 100: geodesic %6.2f, biharmonic %6.2f\n", variant.name.c_str(),
                variant.pairs.size(), flips(variant), 100 * geodesic.mean, 100 * biharmonic.mean);
  }
}

void write_text(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace spherematch::bench
