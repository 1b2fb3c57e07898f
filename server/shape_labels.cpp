#include "server/shape_labels.h"

#include <algorithm>

#include "server/problem.h"

namespace spherematch {

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool is_tag_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == ':' || c == '-';
}

[[noreturn]] void refuse(const std::string& detail) { throw ProblemError(api::Code::invalid_parameter, detail); }

}  // namespace

void check_name(std::string_view name) {
  if (name.size() > max_name_bytes || std::any_of(name.begin(), name.end(), is_control)) {
    refuse("name: must have at most " + std::to_string(max_name_bytes) + " bytes and no control characters");
  }
}

std::string name_of_file(std::string_view file_name) {
  std::string name(file_name.substr(file_name.find_last_of("/\\") + 1));
  std::erase_if(name, is_control);
  return name.substr(0, max_name_bytes);
}

void check_tags(const std::vector<std::string>& tags) {
  if (tags.size() > max_tags) refuse("tags: at most " + std::to_string(max_tags) + " are kept");
  for (const std::string& tag : tags) {
    if (tag.empty() || tag.size() > max_tag_bytes || !std::all_of(tag.begin(), tag.end(), is_tag_character)) {
      refuse("tags: '" + tag.substr(0, 64) + "' is not 1 to " + std::to_string(max_tag_bytes) + " letters, digits, '.', '_', ':' and '-'");
    }
  }
}

std::vector<std::string> parse_tags(std::string_view text) {
  std::vector<std::string> tags;
  if (text.empty()) return tags;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    tags.emplace_back(text.substr(from, comma - from));
    from = comma + 1;
  }
  check_tags(tags);
  return tags;
}

}  // namespace spherematch
