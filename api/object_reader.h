// SPDX-License-Identifier: MIT
// Reads one JSON object member by member; what is not asked for is an error. Internal to api/.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "api/json.h"

namespace spherematch::api {

/// Text -> JSON with a bound on the nesting. @throws JsonError
[[nodiscard]] Json parse(std::string_view text);

class ObjectReader {
 public:
  /// `path` is where the object stands in the document; empty for the document itself. The value must outlive the reader.
  ObjectReader(const Json& value, std::string path);

  /// The member; it must be there.
  [[nodiscard]] const Json& member(std::string_view name);
  [[nodiscard]] std::string path_of(std::string_view name) const;

  [[nodiscard]] std::string text(std::string_view name);
  [[nodiscard]] bool boolean(std::string_view name);
  [[nodiscard]] std::int64_t integer(std::string_view name, std::int64_t least, std::int64_t most);
  [[nodiscard]] std::int32_t count(std::string_view name);  ///< 0 .. 2^31 - 1
  [[nodiscard]] double number(std::string_view name, double least, double most);
  [[nodiscard]] NamedNumbers named_numbers(std::string_view name);
  [[nodiscard]] bool is_null(std::string_view name);
  /// Whether there is such a member; one that is there still has to be read.
  [[nodiscard]] bool has(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view name);

  /// @throws JsonError when the object has a member that nothing asked for
  void finish() const;

 private:
  const Json& value_;
  std::string path_;
  std::set<std::string, std::less<>> seen_;
};

/// The elements of values inside arrays, for example "bary[7][2]".
[[nodiscard]] std::int64_t integer_at(const Json& value, const std::string& path, std::int64_t least, std::int64_t most);
[[nodiscard]] double number_at(const Json& value, const std::string& path);
/// `size` 0 accepts any. @throws JsonError
const Json& array_at(const Json& value, const std::string& path, std::size_t size = 0);
[[nodiscard]] std::string element_path(const std::string& path, std::size_t index);

/// The nested readers that more than one file needs.
[[nodiscard]] Problem read_problem(const Json& value, const std::string& path);
[[nodiscard]] Match read_match(const Json& value, const std::string& path);
/// Pairs of vertices, as many as a match takes.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> read_hints(const Json& value, const std::string& path);
[[nodiscard]] Json text_or_null(const std::string& text);
/// The array in the member "checks".
[[nodiscard]] std::vector<ReadinessCheck> read_checks(ObjectReader& reader);
[[nodiscard]] Json checks_json(const std::vector<ReadinessCheck>& checks);
[[nodiscard]] Json named_numbers_json(const NamedNumbers& values);

}  // namespace spherematch::api
