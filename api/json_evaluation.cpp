// SPDX-License-Identifier: MIT
// Body and answer of POST /evaluations.
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::int64_t last_index = std::numeric_limits<std::int32_t>::max();
constexpr double most = std::numeric_limits<double>::max();

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// The request

/// Vertex numbers that count from `base`; with `may_miss`, -1 stands for none.
std::vector<std::int32_t> read_vertices(const Json& value, const std::string& path, std::int32_t base, bool may_miss) {
  const Json& array = array_at(value, path);
  std::vector<std::int32_t> vertices;
  vertices.reserve(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) {
    const bool missing = may_miss && array[i].is_number_integer() && array[i] == -1;
    vertices.push_back(missing ? -1 : static_cast<std::int32_t>(integer_at(array[i], element_path(path, i), base, last_index)));
  }
  return vertices;
}

LandmarkTruth read_landmark_truth(const Json& value, std::int32_t base) {
  ObjectReader reader(value, "truth");
  const auto list = [&](const char* name) { return read_vertices(reader.member(name), reader.path_of(name), base, false); };
  LandmarkTruth truth{list("source"), list("target"), std::nullopt};
  if (reader.has("mirrored")) truth.mirrored = list("mirrored");
  reader.finish();
  const auto require_length = [&](const char* name, const std::vector<std::int32_t>& vertices) {
    if (vertices.size() != truth.source.size()) throw JsonError(reader.path_of(name) + ": must have as many elements as truth.source");
  };
  require_length("target", truth.target);
  if (truth.mirrored) require_length("mirrored", *truth.mirrored);
  return truth;
}

Truth read_truth(const Json& value, std::int32_t base) {
  if (value.is_null()) return std::monostate{};
  if (value.is_array()) return IndexTruth{read_vertices(value, "truth", base, true)};
  if (value.is_object()) return read_landmark_truth(value, base);
  if (value.is_string() && value.get<std::string>() == "identity") return IdentityTruth{};
  throw JsonError("truth: must be null, \"identity\", an array of vertex numbers, or {\"source\", \"target\", \"mirrored\"}");
}

Json to_json(const Truth& truth) {
  return std::visit(Overloaded{[](std::monostate) { return Json(nullptr); }, [](const IdentityTruth&) { return Json("identity"); },
                               [](const IndexTruth& list) { return Json(list.targets); },
                               [](const LandmarkTruth& lists) {
                                 Json json{{"source", lists.source}, {"target", lists.target}};
                                 if (lists.mirrored) json["mirrored"] = *lists.mirrored;
                                 return json;
                               }},
                    truth);
}

// The answer

Json to_json(const std::optional<MapError>& error) {
  if (!error) return nullptr;
  return {
      {"mean", error->mean},     {"median", error->median},     {"p95", error->p95},
      {"max", error->max},       {"auc", error->auc},           {"area_mean", error->area_mean ? Json(*error->area_mean) : Json(nullptr)},
      {"scored", error->scored}, {"unscored", error->unscored}, {"curve", error->curve}};
}

Json to_json(const Continuity& continuity) {
  return {{"edges", continuity.edges},
          {"torn", continuity.torn},
          {"edge_distortion", continuity.edge_distortion},
          {"stretch_median", continuity.stretch_median},
          {"stretch_p95", continuity.stretch_p95},
          {"stretch_max", continuity.stretch_max},
          {"dirichlet", continuity.dirichlet},
          {"turned", continuity.turned}};
}

std::vector<double> read_numbers(ObjectReader& reader, const char* name) {
  const std::string path = reader.path_of(name);
  const Json& array = array_at(reader.member(name), path);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < array.size(); ++i) numbers.push_back(number_at(array[i], element_path(path, i)));
  return numbers;
}

std::optional<MapError> read_error(ObjectReader& parent, const char* name) {
  const Json& value = parent.member(name);
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, parent.path_of(name));
  MapError error;
  error.mean = reader.number("mean", 0, most);
  error.median = reader.number("median", 0, most);
  error.p95 = reader.number("p95", 0, most);
  error.max = reader.number("max", 0, most);
  error.auc = reader.number("auc", 0, 1.001);
  if (!reader.is_null("area_mean")) error.area_mean = reader.number("area_mean", 0, most);
  error.scored = reader.count("scored");
  error.unscored = reader.count("unscored");
  error.curve = read_numbers(reader, "curve");
  reader.finish();
  return error;
}

Continuity read_continuity(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  Continuity continuity;
  continuity.edges = reader.count("edges");
  continuity.torn = reader.count("torn");
  continuity.edge_distortion = reader.number("edge_distortion", 0, most);
  continuity.stretch_median = reader.number("stretch_median", 0, most);
  continuity.stretch_p95 = reader.number("stretch_p95", 0, most);
  continuity.stretch_max = reader.number("stretch_max", 0, most);
  continuity.dirichlet = reader.number("dirichlet", 0, most);
  continuity.turned = reader.number("turned", 0, 1);
  reader.finish();
  return continuity;
}

Coverage read_coverage(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  Coverage coverage;
  coverage.area = reader.number("area", 0, 1.001);
  coverage.vertices = reader.number("vertices", 0, 1);
  reader.finish();
  return coverage;
}

}  // namespace

Json to_json(const EvaluationRequest& value) {
  Json json{{"src", value.src},   {"tgt", value.tgt},   {"truth", to_json(value.truth)},
            {"base", value.base}, {"both", value.both}, {"biharmonic", value.biharmonic}};
  if (!value.hints.empty()) json["hints"] = value.hints;
  json["method"] = value.method;
  json["refine"] = value.refine;
  json["orientation"] = value.orientation;
  json["candidate"] = value.candidate;
  return json;
}

Json to_json(const Evaluation& value) {
  Json json{{"src", value.src}, {"tgt", value.tgt}, {"geodesic", to_json(value.geodesic)}, {"mirrored", to_json(value.mirrored)}};
  json["flipped"] = value.flipped ? Json(*value.flipped) : Json(nullptr);
  json["biharmonic"] = to_json(value.biharmonic);
  json["symmetric_integral"] = value.symmetric_integral ? Json(*value.symmetric_integral) : Json(nullptr);
  json["continuity"] = to_json(value.continuity);
  json["coverage"] = {{"area", value.coverage.area}, {"vertices", value.coverage.vertices}};
  json["bijectivity"] = to_json(value.bijectivity);
  json["bijectivity_biharmonic"] = to_json(value.bijectivity_biharmonic);
  json["thresholds"] = value.thresholds;
  json["orientation"] = value.orientation;
  json["seconds"] = named_numbers_json(value.seconds);
  json["cached"] = value.cached;
  json["engine"] = value.engine;
  return json;
}

template <>
EvaluationRequest from_text<EvaluationRequest>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  EvaluationRequest request;
  request.src = reader.text("src");
  request.tgt = reader.text("tgt");
  if (reader.has("base")) request.base = static_cast<std::int32_t>(reader.integer("base", 0, 1));
  if (reader.has("truth")) request.truth = read_truth(reader.member("truth"), request.base);
  if (reader.has("both")) request.both = reader.boolean("both");
  if (reader.has("biharmonic")) request.biharmonic = reader.boolean("biharmonic");
  if (reader.has("hints")) request.hints = read_hints(reader.member("hints"), "hints");
  if (reader.has("method")) request.method = reader.text("method");
  if (reader.has("refine")) request.refine = reader.text("refine");
  if (reader.has("orientation")) request.orientation = reader.text("orientation");
  if (reader.has("candidate")) request.candidate = reader.count("candidate");
  reader.finish();
  return request;
}

template <>
Evaluation from_text<Evaluation>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  Evaluation evaluation;
  evaluation.src = reader.text("src");
  evaluation.tgt = reader.text("tgt");
  evaluation.geodesic = read_error(reader, "geodesic");
  evaluation.mirrored = read_error(reader, "mirrored");
  if (!reader.is_null("flipped")) evaluation.flipped = reader.boolean("flipped");
  evaluation.biharmonic = read_error(reader, "biharmonic");
  if (!reader.is_null("symmetric_integral")) evaluation.symmetric_integral = reader.number("symmetric_integral", 0, most);
  evaluation.continuity = read_continuity(reader.member("continuity"), "continuity");
  evaluation.coverage = read_coverage(reader.member("coverage"), "coverage");
  evaluation.bijectivity = read_error(reader, "bijectivity");
  evaluation.bijectivity_biharmonic = read_error(reader, "bijectivity_biharmonic");
  evaluation.thresholds = read_numbers(reader, "thresholds");
  evaluation.orientation = reader.text("orientation");
  evaluation.seconds = reader.named_numbers("seconds");
  evaluation.cached = reader.boolean("cached");
  evaluation.engine = reader.text("engine");
  reader.finish();
  return evaluation;
}

}  // namespace spherematch::api
