#include "engine/io/text_scanner.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "engine/data/error.h"

namespace spherematch {

namespace {

constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Characters that end a word, or may do so, by their code.
constexpr auto ends_word = [] {
  std::array<bool, 256> table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    const auto c = static_cast<char>(code);
    table[code] = is_space(c) || c == '#' || c == '\\';
  }
  return table;
}();

/// from_chars reports what is too small for a double as out of range, like what is too large.
bool is_tiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return exponent + 1 < word.size() && word[exponent + 1] == '-';
  return word.find_first_of("123456789") > word.find('.');
}

}  // namespace

std::string quoted(std::string_view word, std::size_t longest) {
  std::string text = "'";
  for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

std::string_view without_byte_order_mark(std::string_view text) { return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text; }

std::string TextScanner::place() const { return "line " + std::to_string(line_) + ": "; }

void TextScanner::fail(const std::string& message) const { throw EngineError(ErrorCode::malformed_mesh, place() + message); }

void TextScanner::skip_line() {
  while (position_ < text_.size() && text_[position_] != '\n') ++position_;
  if (position_ < text_.size()) {
    ++position_;
    ++line_;
  }
}

/// The length of a backslash with the line end after it, when that comes next and joins lines; else zero.
std::size_t TextScanner::joint_length() const {
  if (!statements_ || text_[position_] != '\\') return 0;
  const std::string_view after = text_.substr(position_ + 1, 2);
  if (after.starts_with('\n')) return 2;
  return after == "\r\n" ? 3 : 0;
}

void TextScanner::skip_space() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '\n' && statements_) return;
    if (c == '#') {
      while (position_ < text_.size() && text_[position_] != '\n') ++position_;
    } else if (is_space(c)) {
      if (c == '\n') ++line_;
      ++position_;
    } else if (const std::size_t joint = joint_length(); joint > 0) {
      ++line_;
      position_ += joint;
    } else {
      return;
    }
  }
}

std::string_view TextScanner::word() {
  skip_space();
  const std::size_t first = position_;
  for (; position_ < text_.size(); ++position_) {
    const char c = text_[position_];
    if (ends_word[static_cast<unsigned char>(c)] && (c != '\\' || joint_length() > 0)) break;
  }
  return text_.substr(first, position_ - first);
}

std::string_view TextScanner::number_word(std::string_view what) {
  std::string_view digits = word();
  if (digits.empty()) fail((remaining() == 0 ? "the file ends where " : "the line ends where ") + std::string(what) + " should be");
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  return digits;
}

std::int64_t TextScanner::integer(std::string_view what) {
  const std::string_view digits = number_word(what);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) fail(quoted(digits) + " is too large for " + std::string(what));
  if (error != std::errc() || end != digits.data() + digits.size()) fail(quoted(digits) + " is not " + std::string(what));
  return value;
}

double TextScanner::real(std::string_view what) {
  const std::string_view digits = number_word(what);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range && end == digits.data() + digits.size() && is_tiny(digits)) return 0;
  if (error == std::errc::result_out_of_range) fail(quoted(digits) + " is too large for " + std::string(what));
  if (error != std::errc() || end != digits.data() + digits.size()) fail(quoted(digits) + " is not " + std::string(what));
  if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
  return value;
}

}  // namespace spherematch
