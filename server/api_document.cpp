#include "server/api_document.h"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <optional>
#include <stdexcept>

namespace spherematch {

namespace {

template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The types of YAML's core schema that the document uses.
api::Json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted, or a block of text
  if (text == "true") return true;
  if (text == "false") return false;
  if (text == "null") return nullptr;
  if (const auto value = number_of<std::int64_t>(text)) return *value;
  if (const auto value = number_of<double>(text)) return *value;
  return text;
}

api::Json convert(const YAML::Node& node) {
  if (node.IsNull()) return nullptr;
  if (node.IsScalar()) return scalar(node);
  api::Json json = node.IsMap() ? api::Json::object() : api::Json::array();
  if (node.IsMap()) {
    for (const auto& member : node) json[member.first.Scalar()] = convert(member.second);
  } else {
    for (const auto& element : node) json.push_back(convert(element));
  }
  return json;
}

}  // namespace

api::Json json_of_yaml(std::string_view yaml) {
  try {
    return convert(YAML::Load(std::string(yaml)));
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace spherematch
