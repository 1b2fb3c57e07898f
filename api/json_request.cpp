// SPDX-License-Identifier: MIT
// The body of POST /match.
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::int64_t last_index = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t max_hints = 64;

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

Json to_json(const SurfacePoint& point) {
  return std::visit(Overloaded{[](std::int32_t vertex) { return Json(vertex); },
                               [](const CornersPoint& p) {
                                 return Json{{"corners", p.corners}, {"bary", p.bary}};
                               },
                               [](const PositionPoint& p) {
                                 return Json{{"position", p.position}};
                               }},
                    point);
}

std::array<double, 3> three_numbers(ObjectReader& reader, std::string_view name) {
  const std::string path = reader.path_of(name);
  const Json& array = array_at(reader.member(name), path, 3);
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result.at(k) = number_at(array[k], element_path(path, k));
  return result;
}

CornersPoint read_corners_point(ObjectReader& reader) {
  CornersPoint point;
  const std::string path = reader.path_of("corners");
  const Json& corners = array_at(reader.member("corners"), path, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    point.corners.at(k) = static_cast<std::int32_t>(integer_at(corners[k], element_path(path, k), 0, last_index));
  }
  point.bary = three_numbers(reader, "bary");
  const double sum = point.bary[0] + point.bary[1] + point.bary[2];
  const bool negative = point.bary[0] < 0 || point.bary[1] < 0 || point.bary[2] < 0;
  if (negative || !(sum > 0.999 && sum < 1.001)) {
    throw JsonError(reader.path_of("bary") + ": must be three weights that are not negative and sum to 1");
  }
  return point;
}

SurfacePoint read_point(const Json& value, const std::string& path) {
  if (value.is_number_integer()) return static_cast<std::int32_t>(integer_at(value, path, 0, last_index));
  if (!value.is_object()) throw JsonError(path + ": must be a vertex number, {\"corners\", \"bary\"} or {\"position\"}");
  ObjectReader reader(value, path);
  SurfacePoint point;
  if (reader.has("position")) {
    point = PositionPoint{three_numbers(reader, "position")};
  } else {
    point = read_corners_point(reader);
  }
  reader.finish();
  return point;
}

std::vector<SurfacePoint> read_points(const Json& value, const std::string& path) {
  const Json& array = array_at(value, path);
  if (array.size() > max_points) throw JsonError(path + ": must have at most " + std::to_string(max_points) + " elements");
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < array.size(); ++i) points.push_back(read_point(array[i], element_path(path, i)));
  return points;
}

Landmarks read_landmarks(const Json& value, const std::string& path) {
  if (!value.is_object()) throw JsonError(path + ": must be an object of points by name");
  Landmarks landmarks;
  for (const auto& [name, point] : value.items()) landmarks.emplace_back(name, read_point(point, path + "." + name));
  return landmarks;
}

std::vector<std::array<std::string, 2>> read_pairs(const Json& value, const std::string& path) {
  const Json& array = array_at(value, path);
  if (array.empty() || array.size() > max_pairs) {
    throw JsonError(path + ": must have 1 to " + std::to_string(max_pairs) + " elements");
  }
  std::vector<std::array<std::string, 2>> pairs;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string pair_path = element_path(path, i);
    const Json& pair = array_at(array[i], pair_path, 2);
    if (!pair[0].is_string() || !pair[1].is_string()) throw JsonError(pair_path + ": must be two shape ids");
    pairs.push_back({pair[0].get<std::string>(), pair[1].get<std::string>()});
  }
  return pairs;
}

Json pairs_json(const MatchRequest& value) {
  return {{"pairs", value.pairs},   {"fields", value.fields}, {"both", value.both},
          {"method", value.method}, {"refine", value.refine}, {"orientation", value.orientation}};
}

}  // namespace

std::vector<std::array<std::int32_t, 2>> read_hints(const Json& value, const std::string& path) {
  const Json& array = array_at(value, path);
  if (array.size() > max_hints) throw JsonError(path + ": must have at most " + std::to_string(max_hints) + " elements");
  std::vector<std::array<std::int32_t, 2>> hints;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string hint_path = element_path(path, i);
    const Json& hint = array_at(array[i], hint_path, 2);
    hints.push_back({static_cast<std::int32_t>(integer_at(hint[0], element_path(hint_path, 0), 0, last_index)),
                     static_cast<std::int32_t>(integer_at(hint[1], element_path(hint_path, 1), 0, last_index))});
  }
  return hints;
}

Json to_json(const MatchRequest& value) {
  if (!value.pairs.empty()) return pairs_json(value);
  Json json{{"src", value.src}, {"tgt", value.tgt}};
  if (value.points) {
    Json& points = json["points"] = Json::array();
    for (const SurfacePoint& point : *value.points) points.push_back(to_json(point));
  }
  if (value.landmarks) {
    Json& landmarks = json["landmarks"] = Json::object();
    for (const auto& [name, point] : *value.landmarks) landmarks[name] = to_json(point);
  }
  if (!value.hints.empty()) json["hints"] = value.hints;
  json["method"] = value.method;
  json["refine"] = value.refine;
  json["orientation"] = value.orientation;
  return json;
}

template <>
MatchRequest from_text<MatchRequest>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  MatchRequest request;
  if (reader.has("pairs")) {
    request.pairs = read_pairs(reader.member("pairs"), "pairs");
    if (reader.has("fields")) request.fields = reader.text("fields");
    if (reader.has("both")) request.both = reader.boolean("both");
  } else {
    request.src = reader.text("src");
    request.tgt = reader.text("tgt");
    if (reader.has("points")) request.points = read_points(reader.member("points"), "points");
    if (reader.has("landmarks")) request.landmarks = read_landmarks(reader.member("landmarks"), "landmarks");
    if (reader.has("hints")) request.hints = read_hints(reader.member("hints"), "hints");
    if (!request.points && !request.landmarks) throw JsonError("the document: must have points, landmarks or pairs");
  }
  if (reader.has("method")) request.method = reader.text("method");
  if (reader.has("refine")) request.refine = reader.text("refine");
  if (reader.has("orientation")) request.orientation = reader.text("orientation");
  reader.finish();
  return request;
}

}  // namespace spherematch::api
