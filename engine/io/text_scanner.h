// Words and numbers of a text file with their line numbers, for the readers of text formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace spherematch {

/// Splits at blanks, tabs, line ends and other control bytes that count as space; '#' hides the rest of a line. Never reads beyond
/// the text, never allocates but for error messages. Numbers do not depend on the locale. Not thread-safe; copies are independent.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : text_(text) {}

  /// The next word, over line ends; empty at the end of the text.
  std::string_view word();

  /// The next word as a number. `what` names it in messages, such as "a vertex index".
  /// @throws EngineError(malformed_mesh) with the line when it is missing, not a number, or out of range
  std::int64_t integer(std::string_view what);

  /// As integer(), and the number must be finite. What is too small for a double reads as zero.
  double real(std::string_view what);

  /// Skips to the start of the next line.
  void skip_line();

  /// Moves back by `count` characters of the word just read.
  void unread(std::size_t count) { position_ -= count; }

  [[nodiscard]] std::size_t remaining() const { return text_.size() - position_; }
  [[nodiscard]] std::int64_t line() const { return line_; }

  /// @throws EngineError(malformed_mesh) always: "line N: " and the message
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_space();
  std::string_view number_word(std::string_view what);

  std::string_view text_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;  ///< of position_, from 1
};

/// The word in quotes, cut to a few printable ASCII characters, fit for an error message.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace spherematch
