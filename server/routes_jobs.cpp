// Jobs: preparations of shapes, and matches of many pairs with their results.
#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include "api/json.h"
#include "server/job_json.h"
#include "server/problem.h"
#include "server/request_parameters.h"
#include "server/server_context.h"

namespace spherematch {

namespace {

constexpr double max_stream_seconds = 3600;
constexpr int max_streams = 16;  // each takes a thread
constexpr std::chrono::milliseconds stream_pause{500};
constexpr std::array<std::string_view, 2> kinds{"preprocess", "match"};                                        // as JobKind
constexpr std::array<std::string_view, 5> states{"queued", "processing", "succeeded", "failed", "cancelled"};  // as JobState

JobRecord record_of(const ServerContext& context, const std::string& id) {
  auto record = context.jobs.find(id);
  if (!record) throw ProblemError(api::Code::not_found, "there is no job '" + id.substr(0, 64) + "'");
  return *std::move(record);
}

api::Job job_of(const ServerContext& context, const JobRecord& record) {
  if (record.kind == JobKind::preprocess) return spherematch::job_of(record, context.shapes.preparation(record.shape));
  return spherematch::job_of(record, context.match_jobs.position(record.id));
}

HttpResponse json_response(int status, const api::Json& json) {
  return {.status = status,
          .content_type = "application/json",
          .body = api::to_text(json) + "\n",
          .headers = {{"Cache-Control", "private, no-cache"}}};
}

template <typename Enum, std::size_t Size>
std::optional<Enum> chosen(const RequestParameters& parameters, std::string_view name, const std::array<std::string_view, Size>& choices) {
  if (!parameters.text(name)) return std::nullopt;
  const std::string choice = parameters.choice(name, choices);
  return static_cast<Enum>(std::find(choices.begin(), choices.end(), choice) - choices.begin());
}

HttpResponse list_jobs(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"limit", "cursor", "state", "kind"});
  const auto limit = static_cast<std::size_t>(parameters.integer("limit", 50, 1, 200));
  const JobFilter filter{.kind = chosen<JobKind>(parameters, "kind", kinds), .state = chosen<JobState>(parameters, "state", states)};
  const JobPage page = context.jobs.list(limit, parameters.text("cursor"), filter);
  api::JobPage result;
  for (const JobRecord& record : page.jobs) result.items.push_back(job_of(context, record));
  result.next_cursor = page.next_cursor;
  HttpResponse response = json_response(200, api::to_json(result));
  if (page.next_cursor) {
    std::string link = "/jobs?limit=" + std::to_string(limit) + "&cursor=" + *page.next_cursor;
    for (const char* name : {"state", "kind"}) {
      if (const auto value = parameters.text(name)) link.append("&").append(name).append("=").append(*value);
    }
    response.headers.emplace_back("Link", "<" + link + ">; rel=\"next\"");
  }
  return response;
}

HttpResponse get_job(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {"wait"});
  const auto deadline = std::chrono::steady_clock::now() + parameters.seconds("wait", 0, max_wait_seconds);
  const JobRecord record = record_of(context, request.id);
  if (record.kind == JobKind::preprocess) {
    context.shapes.wait_until_finished(record.shape, deadline);
  } else {
    context.match_jobs.wait(record.id, deadline);
  }
  const api::Job job = job_of(context, record_of(context, request.id));
  HttpResponse response = json_response(200, api::to_json(job));
  if (job.state == "queued" || job.state == "processing") response.headers.emplace_back("Retry-After", "1");
  return response;
}

HttpResponse delete_job(const ServerContext& context, const HttpRequest& request) {
  const RequestParameters parameters(request, {});
  const JobRecord record = record_of(context, request.id);
  if (record.kind == JobKind::preprocess) {
    context.shapes.cancel_preparation(record.shape);
  } else if (!context.match_jobs.cancel(record.id)) {
    if (!context.jobs.remove(record.id)) throw ProblemError(api::Code::not_found, "there is no job '" + record.id + "'");
    return {.status = 204, .content_type = {}, .body = {}, .headers = {}};
  }
  return json_response(202, api::to_json(job_of(context, record_of(context, request.id))));
}

/// The lines of a job's results as they come to be.
class ResultStream {
 public:
  ResultStream(const ServerContext& context, std::string id, const MatchJobOptions& options, std::int32_t after,
               std::chrono::steady_clock::time_point deadline, std::shared_ptr<void> place)
      : context_(context), id_(std::move(id)), options_(options), line_(after), deadline_(deadline), place_(std::move(place)) {}

  std::optional<std::string> operator()() {
    if (context_.stop.stop_requested()) return std::nullopt;
    const auto pairs = context_.jobs.lines(id_, line_, 1);
    if (!pairs.empty()) {
      ++line_;
      return api::to_text(api::to_json(context_.match_jobs.result_of(pairs.front(), options_))) + "\n";
    }
    if (ended_ || std::chrono::steady_clock::now() >= deadline_) return std::nullopt;
    // Asked before the lines are read once more, so that the last ones are not missed.
    ended_ = context_.match_jobs.wait(id_, std::chrono::steady_clock::now());
    if (!ended_) context_.match_jobs.wait_for_line(id_, line_, std::min(deadline_, std::chrono::steady_clock::now() + stream_pause));
    return std::string();
  }

 private:
  const ServerContext& context_;
  const std::string id_;
  const MatchJobOptions options_;
  std::int32_t line_;
  const std::chrono::steady_clock::time_point deadline_;
  const std::shared_ptr<void> place_;  ///< among the streams, until this one ends
  bool ended_ = false;
};

/// One of the places for streams, given back when the pointer dies.
std::shared_ptr<void> take_place(const std::shared_ptr<std::atomic<int>>& streams) {
  if (streams->fetch_add(1) >= max_streams) {
    streams->fetch_sub(1);
    throw ProblemError(api::Code::overloaded, "too many result streams at once; try again");
  }
  return {nullptr, [streams](void*) { streams->fetch_sub(1); }};
}

HttpResponse get_results(const ServerContext& context, const HttpRequest& request, const std::shared_ptr<std::atomic<int>>& streams) {
  const RequestParameters parameters(request, {"after", "wait"});
  const auto after = static_cast<std::int32_t>(parameters.integer("after", 0, 0, static_cast<std::int64_t>(api::max_pairs)));
  const auto deadline = std::chrono::steady_clock::now() + parameters.seconds("wait", max_stream_seconds, max_stream_seconds);
  const JobRecord record = record_of(context, request.id);
  if (record.kind != JobKind::match) throw ProblemError(api::Code::not_found, "the preparation of a shape has no results; see /shapes");
  HttpResponse response{
      .status = 200, .content_type = "application/x-ndjson", .body = {}, .headers = {{"Cache-Control", "private, no-cache"}}};
  response.stream = ResultStream(context, record.id, MatchJobs::options_of(record.options), after, deadline, take_place(streams));
  return response;
}

}  // namespace

void add_job_routes(Router& router, const ServerContext& context) {
  const auto bind = [&context](auto handler) { return [&context, handler](HttpRequest& request) { return handler(context, request); }; };
  router.add("GET", "/jobs", bind(list_jobs));
  router.add("GET", "/jobs/{id}", bind(get_job));
  router.add("DELETE", "/jobs/{id}", bind(delete_job));
  const auto streams = std::make_shared<std::atomic<int>>(0);
  router.add("GET", "/jobs/{id}/results", [&context, streams](HttpRequest& request) { return get_results(context, request, streams); });
}

}  // namespace spherematch
