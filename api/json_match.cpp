// SPDX-License-Identifier: MIT
#include <charconv>
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

/// The double whose shortest decimal is the float's shortest decimal: half the digits in the text, the same float when read.
double shortest(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
  double result = value;
  std::from_chars(text.begin(), end, result);
  return result;
}

Json bary_json(const std::vector<std::array<float, 3>>& rows) {
  Json json = Json::array();
  for (const auto& row : rows) json.push_back(Json::array({shortest(row[0]), shortest(row[1]), shortest(row[2])}));
  return json;
}

Json numbers_json(const std::vector<float>& values) {
  Json json = Json::array();
  for (const float value : values) json.push_back(shortest(value));
  return json;
}

Json to_json(const Candidate& value) {
  return {{"rotation", value.rotation}, {"correlation", value.correlation}, {"score", value.score}, {"chosen", value.chosen}};
}

std::vector<std::int32_t> read_vertex(const Json& value, const std::string& path, std::int64_t n_src, std::int64_t n_tgt) {
  const Json& array = array_at(value, path, static_cast<std::size_t>(n_src));
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < array.size(); ++i) {
    result.push_back(static_cast<std::int32_t>(integer_at(array[i], element_path(path, i), -1, n_tgt - 1)));
  }
  return result;
}

std::vector<std::array<std::int32_t, 3>> read_corners(const Json& value, const std::string& path, std::int64_t n_src, std::int64_t n_tgt) {
  const Json& array = array_at(value, path, static_cast<std::size_t>(n_src));
  std::vector<std::array<std::int32_t, 3>> result(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string row_path = element_path(path, i);
    const Json& row = array_at(array[i], row_path, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      result[i].at(k) = static_cast<std::int32_t>(integer_at(row[k], element_path(row_path, k), -1, n_tgt - 1));
    }
  }
  return result;
}

std::vector<std::array<float, 3>> read_bary(const Json& value, const std::string& path, std::int64_t n_src) {
  const Json& array = array_at(value, path, static_cast<std::size_t>(n_src));
  std::vector<std::array<float, 3>> result(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::string row_path = element_path(path, i);
    const Json& row = array_at(array[i], row_path, 3);
    for (std::size_t k = 0; k < 3; ++k) result[i].at(k) = static_cast<float>(number_at(row[k], element_path(row_path, k)));
  }
  return result;
}

std::vector<float> read_numbers(const Json& value, const std::string& path, std::int64_t n_src) {
  const Json& array = array_at(value, path, static_cast<std::size_t>(n_src));
  std::vector<float> result(array.size());
  for (std::size_t i = 0; i < array.size(); ++i) result[i] = static_cast<float>(number_at(array[i], element_path(path, i)));
  return result;
}

/// The arrays that a map, forward or reverse, has been asked for.
template <typename Map>
void write_arrays(Json& json, const Map& map) {
  if (map.vertex) json["vertex"] = *map.vertex;
  if (map.corners) json["corners"] = *map.corners;
  if (map.bary) json["bary"] = bary_json(*map.bary);
  if (map.confidence) json["confidence"] = numbers_json(*map.confidence);
  if (map.distortion) json["distortion"] = numbers_json(*map.distortion);
}

template <typename Map>
void read_arrays(ObjectReader& reader, Map& map) {
  if (reader.has("vertex")) map.vertex = read_vertex(reader.member("vertex"), reader.path_of("vertex"), map.n_src, map.n_tgt);
  if (reader.has("corners")) map.corners = read_corners(reader.member("corners"), reader.path_of("corners"), map.n_src, map.n_tgt);
  if (reader.has("bary")) map.bary = read_bary(reader.member("bary"), reader.path_of("bary"), map.n_src);
  if (reader.has("confidence")) map.confidence = read_numbers(reader.member("confidence"), reader.path_of("confidence"), map.n_src);
  if (reader.has("distortion")) map.distortion = read_numbers(reader.member("distortion"), reader.path_of("distortion"), map.n_src);
}

ReverseMap read_reverse(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  ReverseMap reverse;
  reverse.n_src = reader.count("n_src");
  reverse.n_tgt = reader.count("n_tgt");
  read_arrays(reader, reverse);
  reader.finish();
  return reverse;
}

Candidate read_candidate(const Json& value, const std::string& path) {
  constexpr double most = std::numeric_limits<double>::max();
  ObjectReader reader(value, path);
  Candidate candidate;
  const std::string rotation_path = reader.path_of("rotation");
  const Json& rotation = array_at(reader.member("rotation"), rotation_path, 9);
  for (std::size_t i = 0; i < 9; ++i) candidate.rotation.at(i) = number_at(rotation[i], element_path(rotation_path, i));
  candidate.correlation = reader.number("correlation", -most, most);
  candidate.score = reader.number("score", -most, most);
  candidate.chosen = reader.boolean("chosen");
  reader.finish();
  return candidate;
}

}  // namespace

Json to_json(const Match& value) {
  Json json{{"src", value.src}, {"tgt", value.tgt}, {"n_src", value.n_src}, {"n_tgt", value.n_tgt}};
  write_arrays(json, value);
  if (value.reverse) {
    Json& reverse = json["reverse"] = {{"n_src", value.reverse->n_src}, {"n_tgt", value.reverse->n_tgt}};
    write_arrays(reverse, *value.reverse);
  }
  json["orientation"] = value.orientation;
  json["candidate"] = value.candidate;
  json["quality"] = named_numbers_json(value.quality);
  json["candidates"] = Json::array();
  for (const Candidate& candidate : value.candidates) json["candidates"].push_back(to_json(candidate));
  json["seconds"] = named_numbers_json(value.seconds);
  json["cached"] = value.cached;
  json["engine"] = value.engine;
  return json;
}

Match read_match(const Json& json, const std::string& path) {
  ObjectReader reader(json, path);
  Match match;
  match.src = reader.text("src");
  match.tgt = reader.text("tgt");
  match.n_src = reader.count("n_src");
  match.n_tgt = reader.count("n_tgt");
  read_arrays(reader, match);
  if (reader.has("reverse")) match.reverse = read_reverse(reader.member("reverse"), reader.path_of("reverse"));
  match.orientation = reader.text("orientation");
  match.candidate = reader.count("candidate");
  match.quality = reader.named_numbers("quality");
  const std::string candidates_path = reader.path_of("candidates");
  const Json& candidates = array_at(reader.member("candidates"), candidates_path);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    match.candidates.push_back(read_candidate(candidates[i], element_path(candidates_path, i)));
  }
  match.seconds = reader.named_numbers("seconds");
  match.cached = reader.boolean("cached");
  match.engine = reader.text("engine");
  reader.finish();
  return match;
}

template <>
Match from_text<Match>(std::string_view text) {
  return read_match(parse(text), "");
}

}  // namespace spherematch::api
