// SPDX-License-Identifier: MIT
// Jobs and the lines of their results.
#include <algorithm>
#include <array>
#include <limits>

#include "api/object_reader.h"

namespace spherematch::api {

namespace {

constexpr std::array<std::string_view, 2> kinds{"preprocess", "match"};
constexpr std::array<std::string_view, 5> states{"queued", "processing", "succeeded", "failed", "cancelled"};

template <std::size_t Size>
std::string one_of(ObjectReader& reader, std::string_view name, const std::array<std::string_view, Size>& values) {
  std::string text = reader.text(name);
  if (std::find(values.begin(), values.end(), text) == values.end()) throw JsonError(reader.path_of(name) + ": is not a known value");
  return text;
}

std::string text_unless_null(ObjectReader& reader, std::string_view name) {
  return reader.is_null(name) ? std::string() : reader.text(name);
}

PairCounts read_counts(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const PairCounts counts{reader.count("total"), reader.count("succeeded"), reader.count("failed")};
  reader.finish();
  return counts;
}

Job read_job(const Json& value, const std::string& path) {
  ObjectReader reader(value, path);
  Job job;
  job.id = reader.text("id");
  job.kind = one_of(reader, "kind", kinds);
  job.state = one_of(reader, "state", states);
  job.stage = text_unless_null(reader, "stage");
  job.progress = reader.number("progress", 0, 1);
  job.position = reader.count("position");
  job.created_at = reader.text("created_at");
  job.started_at = text_unless_null(reader, "started_at");
  job.finished_at = text_unless_null(reader, "finished_at");
  if (!reader.is_null("error")) job.error = read_problem(reader.member("error"), reader.path_of("error"));
  job.shape = text_unless_null(reader, "shape");
  if (!reader.is_null("pairs")) job.pairs = read_counts(reader.member("pairs"), reader.path_of("pairs"));
  job.results = text_unless_null(reader, "results");
  reader.finish();
  return job;
}

}  // namespace

Json to_json(const Job& value) {
  Json pairs = nullptr;
  if (value.pairs) pairs = {{"total", value.pairs->total}, {"succeeded", value.pairs->succeeded}, {"failed", value.pairs->failed}};
  return {{"id", value.id},
          {"kind", value.kind},
          {"state", value.state},
          {"stage", text_or_null(value.stage)},
          {"progress", value.progress},
          {"position", value.position},
          {"created_at", value.created_at},
          {"started_at", text_or_null(value.started_at)},
          {"finished_at", text_or_null(value.finished_at)},
          {"error", value.error ? to_json(*value.error) : Json(nullptr)},
          {"shape", text_or_null(value.shape)},
          {"pairs", std::move(pairs)},
          {"results", text_or_null(value.results)}};
}

Json to_json(const JobPage& value) {
  Json items = Json::array();
  for (const Job& job : value.items) items.push_back(to_json(job));
  return {{"items", std::move(items)}, {"next_cursor", value.next_cursor ? Json(*value.next_cursor) : Json(nullptr)}};
}

Json to_json(const PairResult& value) {
  Json json{{"index", value.index}, {"src", value.src}, {"tgt", value.tgt}};
  if (value.match) json["match"] = to_json(*value.match);
  if (value.error) json["error"] = to_json(*value.error);
  return json;
}

template <>
Job from_text<Job>(std::string_view text) {
  return read_job(parse(text), "");
}

template <>
JobPage from_text<JobPage>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  JobPage page;
  const Json& items = array_at(reader.member("items"), "items");
  for (std::size_t i = 0; i < items.size(); ++i) page.items.push_back(read_job(items[i], element_path("items", i)));
  if (!reader.is_null("next_cursor")) page.next_cursor = reader.text("next_cursor");
  reader.finish();
  return page;
}

template <>
PairResult from_text<PairResult>(std::string_view text) {
  const Json json = parse(text);
  ObjectReader reader(json, "");
  PairResult result;
  result.index = reader.count("index");
  result.src = reader.text("src");
  result.tgt = reader.text("tgt");
  if (reader.has("match")) result.match = read_match(reader.member("match"), "match");
  if (reader.has("error")) result.error = read_problem(reader.member("error"), "error");
  if (result.match.has_value() == result.error.has_value()) throw JsonError("the document: must have a match or an error");
  reader.finish();
  return result;
}

}  // namespace spherematch::api
