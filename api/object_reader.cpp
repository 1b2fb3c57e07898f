// SPDX-License-Identifier: MIT
#include "api/object_reader.h"

#include <array>
#include <cmath>
#include <limits>

namespace spherematch::api {

namespace {

constexpr int max_depth = 16;
/// Of one object. An ordered object is searched from its front at every member, so many would take their square in time.
constexpr std::size_t max_members = 2000;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw JsonError((path.empty() ? std::string("the document") : path) + ": " + reason);
}

}  // namespace

Json parse(std::string_view text) {
  try {
    // The callback sees the depth before the parser goes deeper, so hostile nesting costs nothing.
    std::array<std::size_t, max_depth + 2> members{};
    return Json::parse(text, [&members](int depth, Json::parse_event_t event, const Json&) {
      if (depth > max_depth) throw JsonError("the document: nested deeper than " + std::to_string(max_depth));
      std::size_t& count = members.at(static_cast<std::size_t>(depth));
      if (event == Json::parse_event_t::object_start) members.at(static_cast<std::size_t>(depth) + 1) = 0;
      if (event == Json::parse_event_t::key && ++count > max_members) {
        throw JsonError("the document: an object has more than " + std::to_string(max_members) + " members");
      }
      return true;
    });
  } catch (const Json::exception& error) {
    throw JsonError(std::string("the document: not JSON: ") + error.what());
  }
}

ObjectReader::ObjectReader(const Json& value, std::string path) : value_(value), path_(std::move(path)) {
  if (!value_.is_object()) fail(path_, "must be an object");
}

std::string ObjectReader::path_of(std::string_view name) const {
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

const Json& ObjectReader::member(std::string_view name) {
  const auto found = value_.find(std::string(name));
  if (found == value_.end()) fail(path_of(name), "is missing");
  seen_.emplace(name);
  return *found;
}

std::string ObjectReader::text(std::string_view name) {
  const Json& value = member(name);
  if (!value.is_string()) fail(path_of(name), "must be a string");
  return value.get<std::string>();
}

bool ObjectReader::boolean(std::string_view name) {
  const Json& value = member(name);
  if (!value.is_boolean()) fail(path_of(name), "must be true or false");
  return value.get<bool>();
}

std::int64_t ObjectReader::integer(std::string_view name, std::int64_t least, std::int64_t most) {
  return integer_at(member(name), path_of(name), least, most);
}

std::int32_t ObjectReader::count(std::string_view name) {
  return static_cast<std::int32_t>(integer(name, 0, std::numeric_limits<std::int32_t>::max()));
}

double ObjectReader::number(std::string_view name, double least, double most) {
  const double value = number_at(member(name), path_of(name));
  if (!(value >= least && value <= most)) fail(path_of(name), "must be in [" + Json(least).dump() + ", " + Json(most).dump() + "]");
  return value;
}

NamedNumbers ObjectReader::named_numbers(std::string_view name) {
  const Json& object = member(name);
  if (!object.is_object()) fail(path_of(name), "must be an object");
  NamedNumbers result;
  for (const auto& [key, value] : object.items()) {
    result.emplace_back(key, value.is_null() ? std::numeric_limits<double>::quiet_NaN() : number_at(value, path_of(name) + "." + key));
  }
  return result;
}

bool ObjectReader::is_null(std::string_view name) { return member(name).is_null(); }

bool ObjectReader::has(std::string_view name) const { return value_.contains(std::string(name)); }

std::vector<std::string> ObjectReader::texts(std::string_view name) {
  const Json& array = array_at(member(name), path_of(name));
  std::vector<std::string> result;
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!array[i].is_string()) fail(element_path(path_of(name), i), "must be a string");
    result.push_back(array[i].get<std::string>());
  }
  return result;
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : value_.items()) {
    if (!seen_.contains(key)) fail(path_of(key), "is not a known member");
  }
}

std::int64_t integer_at(const Json& value, const std::string& path, std::int64_t least, std::int64_t most) {
  const bool fits = !value.is_number_unsigned() || value.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<std::int64_t>::max()};
  if (!value.is_number_integer()) fail(path, "must be an integer");
  if (!fits || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most) {
    fail(path, "must be in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
  }
  return value.get<std::int64_t>();
}

double number_at(const Json& value, const std::string& path) {
  if (!value.is_number()) fail(path, "must be a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) fail(path, "must be finite");
  return number;
}

const Json& array_at(const Json& value, const std::string& path, std::size_t size) {
  if (!value.is_array()) fail(path, "must be an array");
  if (size != 0 && value.size() != size) fail(path, "must have " + std::to_string(size) + " elements");
  return value;
}

std::string element_path(const std::string& path, std::size_t index) { return path + "[" + std::to_string(index) + "]"; }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json named_numbers_json(const NamedNumbers& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values) object[name] = value;  // the library writes null where it is not finite
  return object;
}

}  // namespace spherematch::api
