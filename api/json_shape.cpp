// SPDX-License-Identifier: MIT
#include <array>
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::array<std::string_view, 4> state_names{"queued", "processing", "ready", "failed"};

/// One list for both directions, so that they cannot disagree.
constexpr std::array<std::pair<std::string_view, std::int32_t Repair::*>, 9> repair_counts{{
    {"filled_loops", &Repair::filled_loops},
    {"added_vertices", &Repair::added_vertices},
    {"added_faces", &Repair::added_faces},
    {"dropped_vertices", &Repair::dropped_vertices},
    {"welded_vertices", &Repair::welded_vertices},
    {"split_vertices", &Repair::split_vertices},
    {"flipped_faces", &Repair::flipped_faces},
    {"removed_faces", &Repair::removed_faces},
    {"dropped_components", &Repair::dropped_components},
}};

Json to_json(const Repair& value) {
  Json json{{"mode", value.mode}};
  for (const auto& [name, member] : repair_counts) json[std::string(name)] = value.*member;
  return json;
}

Json to_json(const Sphere& value) {
  return {{"flipped", value.flipped}, {"solid_angle_defect", value.solid_angle_defect}, {"area_distortion", value.area_distortion}};
}

Repair read_repair(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  Repair repair;
  repair.mode = reader.text("mode");
  if (repair.mode != "fill" && repair.mode != "none") throw JsonError(reader.path_of("mode") + ": must be fill or none");
  for (const auto& [name, member] : repair_counts) repair.*member = reader.count(name);
  reader.finish();
  return repair;
}

Sphere read_sphere(const Json& value, const std::string& path) {
  constexpr double most = std::numeric_limits<double>::max();
  ObjectReader reader(value, path);
  const Sphere sphere{.flipped = reader.count("flipped"),
                      .solid_angle_defect = reader.number("solid_angle_defect", 0, most),
                      .area_distortion = reader.number("area_distortion", 0, most)};
  reader.finish();
  return sphere;
}

ShapeState read_state(ObjectReader& reader) {
  const std::string text = reader.text("state");
  for (std::size_t i = 0; i < state_names.size(); ++i) {
    if (text == state_names.at(i)) return static_cast<ShapeState>(i);
  }
  throw JsonError(reader.path_of("state") + ": must be queued, processing, ready or failed");
}

Shape read_shape(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  Shape shape;
  shape.id = reader.text("id");
  shape.name = reader.text("name");
  shape.tags = reader.texts("tags");
  shape.state = read_state(reader);
  if (!reader.is_null("stage")) shape.stage = reader.text("stage");
  shape.progress = reader.number("progress", 0, 1);
  shape.vertices = reader.count("vertices");
  shape.faces = reader.count("faces");
  shape.sha256 = reader.text("sha256");
  shape.repair = read_repair(reader.member("repair"), reader.path_of("repair"));
  if (!reader.is_null("simplified")) shape.simplified = reader.count("simplified");
  if (!reader.is_null("sphere")) shape.sphere = read_sphere(reader.member("sphere"), reader.path_of("sphere"));
  shape.seconds = reader.named_numbers("seconds");
  if (!reader.is_null("engine")) shape.engine = reader.text("engine");
  if (!reader.is_null("error")) shape.error = read_problem(reader.member("error"), reader.path_of("error"));
  shape.created_at = reader.text("created_at");
  reader.finish();
  return shape;
}

}  // namespace

Json to_json(const Shape& value) {
  return {{"id", value.id},
          {"name", value.name},
          {"tags", value.tags},
          {"state", state_names.at(static_cast<std::size_t>(value.state))},
          {"stage", text_or_null(value.stage)},
          {"progress", value.progress},
          {"vertices", value.vertices},
          {"faces", value.faces},
          {"sha256", value.sha256},
          {"repair", to_json(value.repair)},
          {"simplified", value.simplified ? Json(*value.simplified) : Json(nullptr)},
          {"sphere", value.sphere ? to_json(*value.sphere) : Json(nullptr)},
          {"seconds", named_numbers_json(value.seconds)},
          {"engine", text_or_null(value.engine)},
          {"error", value.error ? to_json(*value.error) : Json(nullptr)},
          {"created_at", value.created_at}};
}

Json to_json(const ShapePage& value) {
  Json items = Json::array();
  for (const Shape& shape : value.items) items.push_back(to_json(shape));
  return {{"items", std::move(items)}, {"next_cursor", value.next_cursor ? Json(*value.next_cursor) : Json(nullptr)}};
}

Json to_json(const ShapePatch& value) {
  Json json = Json::object();
  if (value.name) json["name"] = *value.name;
  if (value.tags) json["tags"] = *value.tags;
  return json;
}

template <>
ShapePatch from_text<ShapePatch>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  ShapePatch patch;
  if (reader.has("name")) patch.name = reader.is_null("name") ? "" : reader.text("name");
  if (reader.has("tags")) patch.tags = reader.is_null("tags") ? std::vector<std::string>() : reader.texts("tags");
  reader.finish();
  return patch;
}

template <>
Shape from_text<Shape>(std::string_view text) {
  return read_shape(parse(text), "");
}

template <>
ShapePage from_text<ShapePage>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  ShapePage page;
  const Json& items = array_at(reader.member("items"), "items");
  for (std::size_t i = 0; i < items.size(); ++i) page.items.push_back(read_shape(items[i], element_path("items", i)));
  if (!reader.is_null("next_cursor")) page.next_cursor = reader.text("next_cursor");
  reader.finish();
  return page;
}

}  // namespace spherematch::api
