#include "cli/evaluation_json.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/engine.h"
#include "engine/io/json_text.h"

namespace spherematch {

namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text.append(text.size() > 1 ? ", " : "").append(number(value));
  return text + "]";
}

/// An object, member by member.
class Object {
 public:
  void add(std::string_view name, const std::string& value) {
    text_.append(text_.size() > 1 ? ", " : "").append(json_text(name)).append(": ").append(value);
  }
  void add(std::string_view name, double value) { add(name, number(value)); }
  void add(std::string_view name, std::int32_t value) { add(name, std::to_string(value)); }
  [[nodiscard]] std::string text() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

std::string json_of(const std::optional<MapError>& error) {
  if (!error) return "null";
  Object object;
  object.add("mean", error->mean);
  object.add("median", error->median);
  object.add("p95", error->p95);
  object.add("max", error->max);
  object.add("auc", error->auc);
  object.add("area_mean", error->area_mean ? number(*error->area_mean) : "null");
  object.add("scored", error->scored);
  object.add("unscored", error->unscored);
  object.add("curve", list(error->curve));
  return object.text();
}

std::string json_of(const Continuity& continuity) {
  Object object;
  object.add("edges", continuity.edges);
  object.add("torn", continuity.torn);
  object.add("edge_distortion", continuity.edge_distortion);
  object.add("stretch_median", continuity.stretch_median);
  object.add("stretch_p95", continuity.stretch_p95);
  object.add("stretch_max", continuity.stretch_max);
  object.add("dirichlet", continuity.dirichlet);
  object.add("turned", continuity.turned);
  return object.text();
}

std::string json_of(const Coverage& coverage) {
  Object object;
  object.add("area", coverage.area);
  object.add("vertices", coverage.vertices);
  return object.text();
}

std::string json_of(const StageSeconds& seconds) {
  Object object;
  for (const auto& [stage, value] : seconds) object.add(stage, value);
  return object.text();
}

}  // namespace

std::string evaluation_json(const Evaluation& evaluation, std::string_view source, std::string_view target) {
  Object object;
  object.add("src", json_text(source));
  object.add("tgt", json_text(target));
  object.add("geodesic", json_of(evaluation.geodesic));
  object.add("mirrored", json_of(evaluation.mirrored));
  object.add("flipped", evaluation.flipped ? (*evaluation.flipped ? "true" : "false") : "null");
  object.add("biharmonic", json_of(evaluation.biharmonic));
  object.add("symmetric_integral", evaluation.symmetric_integral ? number(*evaluation.symmetric_integral) : "null");
  object.add("continuity", json_of(evaluation.continuity));
  object.add("coverage", json_of(evaluation.coverage));
  object.add("bijectivity", json_of(evaluation.bijectivity));
  object.add("bijectivity_biharmonic", json_of(evaluation.bijectivity_biharmonic));
  object.add("thresholds", list(curve_thresholds()));
  object.add("seconds", json_of(evaluation.seconds));
  object.add("engine", json_text(engine_version()));
  return object.text() + "\n";
}

}  // namespace spherematch
