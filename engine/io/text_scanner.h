// Words and numbers of a text file with their line numbers, for the readers of text formats.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace spherematch {

/// What a line end is to a scanner. Where it ends statements, a backslash before it joins the next line to this one.
enum class LineEnds { are_space, end_statements };

/// Splits at blanks, tabs, line ends and other control bytes that count as space; '#' hides the rest of a line. Never reads beyond
/// the text, never allocates but for error messages. Numbers do not depend on the locale. Not thread-safe; copies are independent.
class TextScanner {
 public:
  /// `first_line` is the number of the text's first line, where the text is a part of a file.
  explicit TextScanner(std::string_view text, LineEnds line_ends = LineEnds::are_space, std::int64_t first_line = 1)
      : text_(text), statements_(line_ends == LineEnds::end_statements), line_(first_line) {}

  /// The next word. Empty at the end of the text, and of the statement where line ends end statements.
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

  /// "line N: "
  [[nodiscard]] std::string place() const;

  /// @throws EngineError(malformed_mesh) always: place() and the message
  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_space();
  [[nodiscard]] std::size_t joint_length() const;
  std::string_view number_word(std::string_view what);

  std::string_view text_;
  bool statements_;
  std::size_t position_ = 0;
  std::int64_t line_;  ///< of position_
};

/// The word in quotes, cut to a few printable ASCII characters, fit for an error message.
[[nodiscard]] std::string quoted(std::string_view word, std::size_t longest = 24);

[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

}  // namespace spherematch
