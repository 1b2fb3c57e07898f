// The server's log: one line on standard error per event, as text or as JSON. Every event of the server goes through here.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spherematch {

enum class LogFormat {
  text,  ///< TIME level=LEVEL event=NAME key=value ...; a value with spaces, quotes or the like is a JSON string
  json,  ///< {"time":...,"level":...,"event":NAME,"key":value,...}
};

/// A named value. Neither text is copied: both must live as long as the field.
class LogField {
 public:
  LogField(std::string_view key, std::string_view value) : key_(key), value_(value) {}
  LogField(std::string_view key, const std::string& value) : key_(key), value_(std::string_view(value)) {}
  LogField(std::string_view key, const char* value) : key_(key), value_(std::string_view(value)) {}
  LogField(std::string_view key, double value) : key_(key), value_(value) {}  ///< written with three decimals
  LogField(std::string_view key, bool value) : key_(key), value_(value) {}
  template <std::integral Integer>
  LogField(std::string_view key, Integer value) : key_(key), value_(static_cast<std::int64_t>(value)) {}

  [[nodiscard]] std::string_view key() const { return key_; }
  /// As JSON; bytes that are not UTF-8 become replacement characters.
  [[nodiscard]] std::string json() const;
  /// Bare where nobody could misread it, else as JSON.
  [[nodiscard]] std::string text() const;

 private:
  std::string_view key_;
  std::variant<std::string_view, double, bool, std::int64_t> value_;
};

/// What stands behind time and level.
[[nodiscard]] std::string event_line(LogFormat format, std::string_view event, const std::vector<LogField>& fields);

/// `level` is one of debug, info, warn, error, off. To be called once, before the threads are started; without it events are text.
void set_up_log(const std::string& level, LogFormat format);

// Thread-safe.
void log_info(std::string_view event, const std::vector<LogField>& fields = {});
void log_warning(std::string_view event, const std::vector<LogField>& fields = {});
void log_error(std::string_view event, const std::vector<LogField>& fields = {});

}  // namespace spherematch
