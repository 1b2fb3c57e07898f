// SPDX-License-Identifier: MIT
#include <array>
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();

constexpr std::array<std::pair<std::string_view, std::int64_t Limits::*>, 6> limit_members{{
    {"body_bytes", &Limits::body_bytes},
    {"vertices", &Limits::vertices},
    {"queued_jobs", &Limits::queued_jobs},
    {"concurrent_matches", &Limits::concurrent_matches},
    {"waiting_matches", &Limits::waiting_matches},
    {"wait_seconds", &Limits::wait_seconds},
}};

constexpr std::array<std::pair<std::string_view, std::int64_t Health::*>, 4> health_members{{
    {"jobs_queued", &Health::jobs_queued},
    {"jobs_processing", &Health::jobs_processing},
    {"matches_running", &Health::matches_running},
    {"matches_waiting", &Health::matches_waiting},
}};

}  // namespace

Json to_json(const Health& value) {
  Json json{{"status", value.status}};
  for (const auto& [name, member] : health_members) json[std::string(name)] = value.*member;
  return json;
}

Json to_json(const Version& value) {
  Json limits = Json::object();
  for (const auto& [name, member] : limit_members) limits[std::string(name)] = value.limits.*member;
  return {{"version", value.version}, {"engine", value.engine}, {"limits", std::move(limits)}, {"parameters", value.parameters}};
}

template <>
Health from_text<Health>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  Health health;
  health.status = reader.text("status");
  if (health.status != "ok" && health.status != "draining") throw JsonError("status: must be ok or draining");
  for (const auto& [name, member] : health_members) health.*member = reader.integer(name, 0, most);
  reader.finish();
  return health;
}

template <>
Version from_text<Version>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  Version version;
  version.version = reader.text("version");
  version.engine = reader.text("engine");
  ObjectReader limits(reader.member("limits"), "limits");
  for (const auto& [name, member] : limit_members) version.limits.*member = limits.integer(name, 0, most);
  limits.finish();
  version.parameters = reader.member("parameters");
  if (!version.parameters.is_object()) throw JsonError("parameters: must be an object");
  reader.finish();
  return version;
}

}  // namespace spherematch::api
