#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "bench/experiments/experiments.h"
#include "bench/experiments/report.h"
#include "bench/experiments/shape_classes.h"
#include "bench/experiments/variants.h"
#include "engine/engine.h"
#include "engine/io/curve_picture.h"

namespace spherematch::bench {

namespace {

struct Measured {
  int steps = 0;
  double area_distortion = 0;     ///< of the source's parametrisation
  std::vector<double> integrals;  ///< D(S, T) with each variant
};

/// Every measurement prepares both shapes anew, but they are read once.
Measured measure(const Surface& source_surface, const Surface& target_surface, int steps, const ExperimentSettings& settings,
                 const std::vector<Variant>& variants) {
  PreprocessParameters preparation = settings.preparation();
  preparation.authalic_steps = steps;
  const PreprocessedShape source = preprocess(source_surface, preparation, {}, settings.threads);
  const PreprocessedShape target = preprocess(target_surface, preparation, {}, settings.threads);
  const GroundTruth truth = identity_truth(source_surface.uploaded_vertices(), target_surface.uploaded_vertices());
  Measured measured{steps, source.sphere_quality.area_distortion, {}};
  for (const Variant& variant : variants) {
    MatchParameters parameters = variant.parameters;
    parameters.both = true;
    const MatchResult result = match(source, target, parameters, {}, settings.threads);
    const Evaluation evaluation = evaluate(source, target, result.map, &result.reverse, truth, {}, settings.threads);
    measured.integrals.push_back(evaluation.symmetric_integral.value());
  }
  return measured;
}

Json to_json(const std::vector<Measured>& rows, const ExperimentSettings& settings) {
  Json json{{"experiment", "authalic"},     {"engine", engine_version()},   {"paper_preparation", settings.paper_preparation},
            {"src", settings.places.at(0)}, {"tgt", settings.places.at(1)}, {"variants", settings.variants}};
  json["rows"] = Json::array();
  for (const Measured& row : rows) {
    json["rows"].push_back({{"steps", row.steps}, {"area_distortion", row.area_distortion}, {"symmetric_integral", row.integrals}});
  }
  return json;
}

std::string picture(const std::vector<Measured>& rows, const std::vector<Variant>& variants) {
  LinePicture frame{
      .title = "Authalic evolution", .x_axis = "authalic steps", .y_axis = "D(S, T)", .x_end = 1, .y_end = 0, .legend_at_top = true};
  std::vector<PictureLine> lines(variants.size());
  for (std::size_t v = 0; v < lines.size(); ++v) lines[v].name = variants[v].name;
  for (const Measured& row : rows) {
    frame.x_end = std::max(frame.x_end, static_cast<double>(row.steps));
    for (std::size_t v = 0; v < lines.size(); ++v) {
      frame.y_end = std::max(frame.y_end, row.integrals[v]);
      lines[v].points.push_back({static_cast<double>(row.steps), row.integrals[v]});
    }
  }
  constexpr double tick = 0.05;  // of the whole axis, which leaves room for the legend
  frame.y_end = tick * (1 + std::ceil(frame.y_end / tick));
  return encode_svg(frame, lines);
}

}  // namespace

void run_authalic(const ExperimentSettings& settings, const std::vector<int>& steps) {
  if (settings.places.size() != 2) throw std::runtime_error("this experiment takes two meshes");
  const std::vector<Variant> variants = variants_named(settings.variants);
  const Surface source = read_shape(settings.places[0]), target = read_shape(settings.places[1]);
  std::vector<Measured> rows;
  for (const int count : steps) {
    rows.push_back(measure(source, target, count, settings, variants));
    std::printf("%4d steps: area distortion %.3f, D(S, T)", count, rows.back().area_distortion);
    for (std::size_t v = 0; v < variants.size(); ++v) std::printf("  %s %.4f", variants[v].name.c_str(), rows.back().integrals[v]);
    std::printf("\n");
    std::fflush(stdout);
  }
  write_text(settings.out + "/authalic.json", to_json(rows, settings).dump(1) + "\n");
  write_text(settings.out + "/authalic.svg", picture(rows, variants));
}

}  // namespace spherematch::bench
