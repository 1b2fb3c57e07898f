// SPDX-License-Identifier: MIT
#include <array>
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();

constexpr std::array<std::pair<std::string_view, std::int64_t Limits::*>, 12> limit_members{{
    {"body_bytes", &Limits::body_bytes},
    {"vertices", &Limits::vertices},
    {"queued_jobs", &Limits::queued_jobs},
    {"concurrent_matches", &Limits::concurrent_matches},
    {"waiting_matches", &Limits::waiting_matches},
    {"concurrent_uploads", &Limits::concurrent_uploads},
    {"workers", &Limits::workers},
    {"threads", &Limits::threads},
    {"shape_cache_bytes", &Limits::shape_cache_bytes},
    {"match_cache_bytes", &Limits::match_cache_bytes},
    {"match_store_bytes", &Limits::match_store_bytes},
    {"wait_seconds", &Limits::wait_seconds},
}};

constexpr std::array<std::pair<std::string_view, std::int64_t Health::*>, 4> health_members{{
    {"jobs_queued", &Health::jobs_queued},
    {"jobs_processing", &Health::jobs_processing},
    {"matches_running", &Health::matches_running},
    {"matches_waiting", &Health::matches_waiting},
}};

constexpr std::string_view ready = "ready";

std::vector<std::string> read_names(ObjectReader& reader, std::string_view name) {
  const std::string path = reader.path_of(name);
  std::vector<std::string> names;
  for (const Json& value : array_at(reader.member(name), path)) {
    if (!value.is_string()) throw JsonError(element_path(path, names.size()) + ": must be text");
    names.push_back(value.get<std::string>());
  }
  return names;
}

}  // namespace

Json checks_json(const std::vector<ReadinessCheck>& checks) {
  Json json = Json::array();
  for (const ReadinessCheck& check : checks) json.push_back({{"name", check.name}, {"ok", check.ok}, {"detail", check.detail}});
  return json;
}

std::vector<ReadinessCheck> read_checks(ObjectReader& reader) {
  const std::string path = reader.path_of("checks");
  std::vector<ReadinessCheck> checks;
  for (const Json& value : array_at(reader.member("checks"), path)) {
    ObjectReader line(value, element_path(path, checks.size()));
    ReadinessCheck check;
    check.name = line.text("name");
    check.ok = line.boolean("ok");
    check.detail = line.text("detail");
    line.finish();
    checks.push_back(std::move(check));
  }
  return checks;
}

Json to_json(const Readiness& value) { return {{"status", ready}, {"checks", checks_json(value.checks)}}; }

Json to_json(const Health& value) {
  Json json{{"status", value.status}};
  for (const auto& [name, member] : health_members) json[std::string(name)] = value.*member;
  return json;
}

Json to_json(const Version& value) {
  Json limits = Json::object();
  for (const auto& [name, member] : limit_members) limits[std::string(name)] = value.limits.*member;
  return {{"version", value.version},
          {"engine", value.engine},
          {"limits", std::move(limits)},
          {"formats", {{"mesh", value.mesh_formats}, {"match", value.match_formats}}},
          {"parameters", value.parameters}};
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
Readiness from_text<Readiness>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  if (reader.text("status") != ready) throw JsonError("status: must be ready");
  Readiness readiness{read_checks(reader)};
  reader.finish();
  return readiness;
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
  ObjectReader formats(reader.member("formats"), "formats");
  version.mesh_formats = read_names(formats, "mesh");
  version.match_formats = read_names(formats, "match");
  formats.finish();
  version.parameters = reader.member("parameters");
  if (!version.parameters.is_object()) throw JsonError("parameters: must be an object");
  reader.finish();
  return version;
}

}  // namespace spherematch::api
