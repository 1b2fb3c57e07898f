// SPDX-License-Identifier: MIT
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::string_view type_prefix = "/problems/";
constexpr std::string_view instance_prefix = "/requests/";

Json to_json(const Element& element) {
  if (const auto* vertex = std::get_if<VertexElement>(&element)) return {{"vertex", vertex->vertex}};
  if (const auto* face = std::get_if<FaceElement>(&element)) return {{"face", face->face}};
  return {{"edge", std::get<EdgeElement>(element).edge}};
}

Element read_element(const Json& value, const std::string& path) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  ObjectReader reader(value, path);
  Element element;
  if (value.contains("vertex")) {
    element = VertexElement{reader.count("vertex")};
  } else if (value.contains("face")) {
    element = FaceElement{reader.count("face")};
  } else {
    EdgeElement edge;
    const Json& ends = array_at(reader.member("edge"), reader.path_of("edge"), 2);
    for (std::size_t i = 0; i < 2; ++i) {
      edge.edge.at(i) = static_cast<std::int32_t>(integer_at(ends[i], element_path(reader.path_of("edge"), i), 0, most));
    }
    element = edge;
  }
  reader.finish();
  return element;
}

std::optional<std::int64_t> optional_integer(ObjectReader& reader, std::string_view name) {
  if (reader.is_null(name)) return std::nullopt;
  return reader.integer(name, 0, std::numeric_limits<std::int64_t>::max());
}

void expect(bool condition, const std::string& path) {
  if (!condition) throw JsonError(path + ": does not agree with the code");
}

}  // namespace

Json to_json(const Problem& value) {
  const ErrorEntry& entry = entry_of(value.code);
  Json json{{"type", std::string(type_prefix) + std::string(entry.wire)},
            {"title", entry.title},
            {"status", entry.status},
            {"detail", value.detail},
            {"instance", nullptr},
            {"code", entry.wire},
            {"request_id", nullptr},
            {"retryable", entry.retryable},
            {"limit", nullptr},
            {"actual", nullptr},
            {"elements", Json::array()}};
  if (!value.request_id.empty()) {
    json["instance"] = std::string(instance_prefix) + value.request_id;
    json["request_id"] = value.request_id;
  }
  if (value.limit) json["limit"] = *value.limit;
  if (value.actual) json["actual"] = *value.actual;
  for (const Element& element : value.elements) {
    if (json["elements"].size() == max_elements) break;
    json["elements"].push_back(to_json(element));
  }
  if (!value.checks.empty()) json["checks"] = checks_json(value.checks);
  return json;
}

Problem read_problem(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const std::string wire = reader.text("code");
  const auto code = code_from_wire(wire);
  if (!code) throw JsonError(reader.path_of("code") + ": '" + wire + "' is not a known code");
  const ErrorEntry& entry = entry_of(*code);
  expect(reader.text("type") == std::string(type_prefix) + wire, reader.path_of("type"));
  expect(reader.text("title") == entry.title, reader.path_of("title"));
  expect(reader.integer("status", 100, 599) == entry.status, reader.path_of("status"));
  expect(reader.boolean("retryable") == entry.retryable, reader.path_of("retryable"));

  Problem problem;
  problem.code = *code;
  problem.detail = reader.text("detail");
  if (!reader.is_null("request_id")) problem.request_id = reader.text("request_id");
  const bool has_instance = !reader.is_null("instance");
  expect(has_instance == !problem.request_id.empty() &&
             (!has_instance || reader.text("instance") == std::string(instance_prefix) + problem.request_id),
         reader.path_of("instance"));
  problem.limit = optional_integer(reader, "limit");
  problem.actual = optional_integer(reader, "actual");
  const std::string elements_path = reader.path_of("elements");
  const Json& elements = array_at(reader.member("elements"), elements_path);
  if (elements.size() > max_elements) throw JsonError(elements_path + ": more than " + std::to_string(max_elements) + " elements");
  for (std::size_t i = 0; i < elements.size(); ++i) problem.elements.push_back(read_element(elements[i], element_path(elements_path, i)));
  if (value.contains("checks")) problem.checks = read_checks(reader);
  reader.finish();
  return problem;
}

template <>
Problem from_text<Problem>(std::string_view text) {
  return read_problem(parse(text), "");
}

std::string to_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace spherematch::api
