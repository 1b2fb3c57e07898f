// Names and tags of shapes as clients may give them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spherematch {

inline constexpr std::size_t max_name_bytes = 200;
inline constexpr std::size_t max_tags = 20;
inline constexpr std::size_t max_tag_bytes = 50;

/// @throws ProblemError(invalid_parameter) unless the name has at most max_name_bytes and no control characters
void check_name(std::string_view name);

/// The name of an uploaded file without its folders, made to fit.
[[nodiscard]] std::string name_of_file(std::string_view file_name);

/// @throws ProblemError(invalid_parameter) unless there are at most max_tags, each of 1 to max_tag_bytes of [A-Za-z0-9._:-]
void check_tags(const std::vector<std::string>& tags);

/// "a,b" as tags; none for an empty text. @throws ProblemError(invalid_parameter) as check_tags()
[[nodiscard]] std::vector<std::string> parse_tags(std::string_view text);

}  // namespace spherematch
