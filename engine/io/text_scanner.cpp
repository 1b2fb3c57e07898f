#include "engine/io/text_scanner.h"

#include <charconv>
#include <cmath>
#include <system_error>

#include "engine/data/error.h"

namespace spherematch {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// from_chars reports what is too small for a double as out of range, like what is too large.
bool is_tiny(std::string_view word) {
  const std::size_t exponent = word.find_first_of("eE");
  if (exponent != std::string_view::npos) return exponent + 1 < word.size() && word[exponent + 1] == '-';
  return word.find_first_of("123456789") > word.find('.');
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 24;
  std::string text = "'";
  for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

void TextScanner::fail(const std::string& message) const {
  throw EngineError(ErrorCode::malformed_mesh, "line " + std::to_string(line_) + ": " + message);
}

void TextScanner::skip_line() {
  while (position_ < text_.size() && text_[position_] != '\n') ++position_;
  if (position_ < text_.size()) {
    ++position_;
    ++line_;
  }
}

void TextScanner::skip_space() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '#') {
      skip_line();
    } else if (is_space(c)) {
      if (c == '\n') ++line_;
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view TextScanner::word() {
  skip_space();
  const std::size_t first = position_;
  while (position_ < text_.size() && !is_space(text_[position_]) && text_[position_] != '#') ++position_;
  return text_.substr(first, position_ - first);
}

std::string_view TextScanner::number_word(std::string_view what) {
  std::string_view digits = word();
  if (digits.empty()) fail("the file ends where " + std::string(what) + " should be");
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
