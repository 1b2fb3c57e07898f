#include "server/event_log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace spherematch {

namespace {

/// The name of the default logger says how it writes, so that nothing beside it has to be remembered.
constexpr const char* json_logger = "json";

std::string quoted(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', /*ensure_ascii=*/false, nlohmann::json::error_handler_t::replace);
}

bool is_plain(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < '\x7f' && c != '"' && c != '=' && c != '\\'; });
}

void log(spdlog::level::level_enum level, std::string_view event, const std::vector<LogField>& fields) {
  spdlog::logger& logger = *spdlog::default_logger_raw();
  if (!logger.should_log(level)) return;
  logger.log(level, event_line(logger.name() == json_logger ? LogFormat::json : LogFormat::text, event, fields));
}

}  // namespace

std::string LogField::json() const {
  if (const auto* text = std::get_if<std::string_view>(&value_)) return quoted(*text);
  if (const auto* number = std::get_if<double>(&value_)) return std::isfinite(*number) ? fmt::format("{:.3f}", *number) : "null";
  if (const auto* flag = std::get_if<bool>(&value_)) return *flag ? "true" : "false";
  return std::to_string(std::get<std::int64_t>(value_));
}

std::string LogField::text() const {
  const auto* text = std::get_if<std::string_view>(&value_);
  return text != nullptr && is_plain(*text) ? std::string(*text) : json();
}

std::string event_line(LogFormat format, std::string_view event, const std::vector<LogField>& fields) {
  std::string line = format == LogFormat::json ? "\"event\":" + quoted(event) : "event=" + std::string(event);
  for (const LogField& field : fields) {
    if (format == LogFormat::json) {
      line.append(",").append(quoted(field.key())).append(":").append(field.json());
    } else {
      line.append(" ").append(field.key()).append("=").append(field.text());
    }
  }
  return line;
}

void set_up_log(const std::string& level, LogFormat format) {
  const bool as_json = format == LogFormat::json;
  auto logger = spdlog::stderr_logger_mt(as_json ? json_logger : "text");
  logger->set_pattern(as_json ? R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l",%v})" : "%Y-%m-%dT%H:%M:%S.%eZ level=%l %v",
                      spdlog::pattern_time_type::utc);
  logger->set_level(spdlog::level::from_str(level));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(logger);
}

void log_info(std::string_view event, const std::vector<LogField>& fields) { log(spdlog::level::info, event, fields); }
void log_warning(std::string_view event, const std::vector<LogField>& fields) { log(spdlog::level::warn, event, fields); }
void log_error(std::string_view event, const std::vector<LogField>& fields) { log(spdlog::level::err, event, fields); }

}  // namespace spherematch
