// SPDX-License-Identifier: MIT
// The answer to POST /match for points and landmarks.
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

using Image = std::optional<PointImage>;

Json to_json(const Image& image) {
  if (!image) return nullptr;
  return {{"vertex", image->vertex}, {"corners", image->corners}, {"bary", image->bary}, {"position", image->position}};
}

Image read_image(const Json& value, const std::string& path) {
  if (value.is_null()) return std::nullopt;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  ObjectReader reader(value, path);
  PointImage image;
  image.vertex = reader.count("vertex");
  const auto three = [&](const char* name) -> const Json& { return array_at(reader.member(name), reader.path_of(name), 3); };
  const Json &corners = three("corners"), &bary = three("bary"), &position = three("position");
  for (std::size_t k = 0; k < 3; ++k) {
    image.corners.at(k) = static_cast<std::int32_t>(integer_at(corners[k], element_path(reader.path_of("corners"), k), 0, most));
    image.bary.at(k) = number_at(bary[k], element_path(reader.path_of("bary"), k));
    image.position.at(k) = number_at(position[k], element_path(reader.path_of("position"), k));
  }
  reader.finish();
  return image;
}

}  // namespace

Json to_json(const PointMatch& value) {
  Json json{{"src", value.src}, {"tgt", value.tgt}};
  if (value.points) {
    Json& points = json["points"] = Json::array();
    for (const Image& image : *value.points) points.push_back(to_json(image));
  }
  if (value.landmarks) {
    Json& landmarks = json["landmarks"] = Json::object();
    for (const auto& [name, image] : *value.landmarks) landmarks[name] = to_json(image);
  }
  json["orientation"] = value.orientation;
  json["quality"] = named_numbers_json(value.quality);
  json["seconds"] = named_numbers_json(value.seconds);
  json["cached"] = value.cached;
  json["engine"] = value.engine;
  return json;
}

template <>
PointMatch from_text<PointMatch>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  PointMatch match;
  match.src = reader.text("src");
  match.tgt = reader.text("tgt");
  if (reader.has("points")) {
    const Json& points = array_at(reader.member("points"), "points");
    match.points.emplace();
    for (std::size_t i = 0; i < points.size(); ++i) match.points->push_back(read_image(points[i], element_path("points", i)));
  }
  if (reader.has("landmarks")) {
    const Json& landmarks = reader.member("landmarks");
    if (!landmarks.is_object()) throw JsonError("landmarks: must be an object");
    match.landmarks.emplace();
    for (const auto& [name, image] : landmarks.items()) match.landmarks->emplace_back(name, read_image(image, "landmarks." + name));
  }
  match.orientation = reader.text("orientation");
  match.quality = reader.named_numbers("quality");
  match.seconds = reader.named_numbers("seconds");
  match.cached = reader.boolean("cached");
  match.engine = reader.text("engine");
  reader.finish();
  return match;
}

}  // namespace spherematch::api
