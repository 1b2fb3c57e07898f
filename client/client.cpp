// SPDX-License-Identifier: MIT
#include "client/client.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "api/json.h"
#include "client/transport.h"

namespace spherematch::client {

namespace {

using Query = std::vector<std::pair<std::string, std::string>>;

constexpr std::chrono::milliseconds longest_wait{60'000};      // of one request
constexpr std::chrono::milliseconds between_lines{3'600'000};  // of a stream of results: one long match

template <typename T>
T parse(const std::string& text) {
  try {
    return api::from_text<T>(text);
  } catch (const api::JsonError& error) {
    throw FormatError(std::string("the server's answer is not what it should be: ") + error.what());
  }
}

std::string seconds(std::chrono::milliseconds time) { return std::to_string(static_cast<double>(time.count()) / 1000); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : ",").append(word);
  return text;
}

void add_given(Query& query, const std::string& name, const std::optional<std::string>& value) {
  if (value) query.emplace_back(name, *value);
}

Query symmetry_query(const MatchOptions& options) {
  Query query{{"wait", seconds(longest_wait)}, {"method", options.method}, {"refine", options.refine}};
  std::string hints;
  for (const auto& [source, target] : options.hints) {
    hints.append(hints.empty() ? "" : ",").append(std::to_string(source)).append(":").append(std::to_string(target));
  }
  if (!hints.empty()) query.emplace_back("hints", hints);
  if (!options.cache) query.emplace_back("cache", "no");
  return query;
}

Query match_query(const std::string& src, const std::string& tgt, const MatchOptions& options) {
  Query query = symmetry_query(options);
  query.insert(query.end(), {{"src", src}, {"tgt", tgt}, {"orientation", options.orientation}});
  return query;
}

void add_candidate(Query& query, const MatchOptions& options) {
  if (options.candidate != 0) query.emplace_back("candidate", std::to_string(options.candidate));
}

void add_fields(Query& query, const MatchOptions& options) {
  if (!options.fields.empty()) query.emplace_back("fields", options.fields);
}

Request get(std::string path, Query query = {}, std::chrono::milliseconds wait = {}) {
  return {.method = "GET", .path = std::move(path), .query = std::move(query), .body = {}, .content_type = {}, .wait = wait};
}

Request send_json(std::string method, std::string path, std::string_view body, bool repeatable) {
  return {.method = std::move(method),
          .path = std::move(path),
          .query = {},
          .body = body,
          .content_type = "application/json",
          .wait = {},
          .repeatable = repeatable};
}

/// `npy` must live until the request is sent.
Request post_array(std::string path, Query query, std::string_view npy) {
  return {.method = "POST",
          .path = std::move(path),
          .query = std::move(query),
          .body = npy,
          .content_type = "application/x-npy",
          .wait = longest_wait};
}

}  // namespace

Client::Client(const std::string& url, Settings settings) : transport_(std::make_shared<const Transport>(url, std::move(settings))) {}

api::Shape Client::upload(std::string_view bytes, const UploadOptions& options) const {
  const auto wait = std::min(options.wait, longest_wait);
  Query query{{"name", options.name}, {"repair", options.repair ? "fill" : "none"}, {"wait", seconds(wait)}};
  if (!options.tags.empty()) query.emplace_back("tags", joined(options.tags));
  if (options.simplify > 0) query.emplace_back("simplify", std::to_string(options.simplify));
  return parse<api::Shape>(transport_->send({.method = "POST",
                                             .path = "/shapes",
                                             .query = std::move(query),
                                             .body = bytes,
                                             .content_type = "application/octet-stream",
                                             .wait = wait}));
}

api::Shape Client::upload_file(const std::filesystem::path& file, UploadOptions options) const {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw TransportError("cannot read " + file.string());
  if (options.name.empty()) options.name = file.filename().string();
  return upload(bytes, options);
}

api::Shape Client::shape(const std::string& id) const { return parse<api::Shape>(transport_->send(get("/shapes/" + id))); }

api::Shape Client::wait(const std::string& id, std::chrono::milliseconds timeout) const {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (true) {
    api::Shape found = shape(id);
    const bool active = found.state == api::ShapeState::queued || found.state == api::ShapeState::processing;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (!active || left.count() <= 0) return found;
    (void)job("p" + id, std::min(left, longest_wait));
  }
}

api::ShapePage Client::shapes(const ShapeFilter& filter, int limit, const std::optional<std::string>& cursor) const {
  Query query{{"limit", std::to_string(limit)}};
  add_given(query, "cursor", cursor);
  add_given(query, "state", filter.state);
  add_given(query, "tag", filter.tag);
  add_given(query, "q", filter.q);
  add_given(query, "sha256", filter.sha256);
  return parse<api::ShapePage>(transport_->send(get("/shapes", std::move(query))));
}

api::Shape Client::rename(const std::string& id, const std::string& name) const {
  const std::string body = api::to_text(api::Json{{"name", name}});
  return parse<api::Shape>(transport_->send(send_json("PATCH", "/shapes/" + id, body, true)));
}

api::Shape Client::tag(const std::string& id, const std::vector<std::string>& tags) const {
  const std::string body = api::to_text(api::Json{{"tags", tags}});
  return parse<api::Shape>(transport_->send(send_json("PATCH", "/shapes/" + id, body, true)));
}

void Client::remove(const std::string& id) const {
  (void)transport_->send({.method = "DELETE", .path = "/shapes/" + id, .query = {}, .body = {}, .content_type = {}, .repeatable = false});
}

std::string Client::mesh(const std::string& id, const std::string& format) const {
  return transport_->send(get("/shapes/" + id + "/mesh", {{"format", format}}));
}

std::string Client::thumbnail(const std::string& id, int size) const {
  return transport_->send(get("/shapes/" + id + "/thumbnail.png", {{"size", std::to_string(size)}}));
}

Map Client::match(const std::string& src, const std::string& tgt, const MatchOptions& options) const {
  return decode_map(match_file(src, tgt, "npz", options));
}

api::Match Client::match_info(const std::string& src, const std::string& tgt, const MatchOptions& options) const {
  Query query = match_query(src, tgt, options);
  add_candidate(query, options);
  query.emplace_back("format", "json");
  query.emplace_back("fields", "");
  return parse<api::Match>(transport_->send(get("/match", std::move(query), longest_wait)));
}

std::string Client::match_file(const std::string& src, const std::string& tgt, const std::string& format,
                               const MatchOptions& options) const {
  Query query = match_query(src, tgt, options);
  add_candidate(query, options);
  query.emplace_back("format", format);
  add_fields(query, options);
  if (options.both) query.emplace_back("both", "yes");
  return transport_->send(get("/match", std::move(query), longest_wait));
}

Map Client::symmetry(const std::string& id, const MatchOptions& options) const { return decode_map(symmetry_file(id, "npz", options)); }

api::Match Client::symmetry_info(const std::string& id, const MatchOptions& options) const {
  Query query = symmetry_query(options);
  add_candidate(query, options);
  query.emplace_back("format", "json");
  query.emplace_back("fields", "");
  return parse<api::Match>(transport_->send(get("/shapes/" + id + "/symmetry", std::move(query), longest_wait)));
}

std::string Client::symmetry_file(const std::string& id, const std::string& format, const MatchOptions& options) const {
  Query query = symmetry_query(options);
  add_candidate(query, options);
  query.emplace_back("format", format);
  add_fields(query, options);
  return transport_->send(get("/shapes/" + id + "/symmetry", std::move(query), longest_wait));
}

api::PointMatch Client::match_points(const api::MatchRequest& request) const {
  const std::string body = api::to_text(api::to_json(request));
  Request post = send_json("POST", "/match", body, true);
  post.query = {{"wait", seconds(longest_wait)}};
  post.wait = longest_wait;
  return parse<api::PointMatch>(transport_->send(post));
}

api::Evaluation Client::evaluate(const api::EvaluationRequest& request) const {
  const std::string body = api::to_text(api::to_json(request));
  Request post = send_json("POST", "/evaluations", body, true);
  post.query = {{"wait", seconds(longest_wait)}};
  post.wait = longest_wait;
  return parse<api::Evaluation>(transport_->send(post));
}

std::vector<double> Client::transfer(const std::string& src, const std::string& tgt, std::span<const double> values, std::size_t columns,
                                     const std::string& interpolation, const MatchOptions& options) const {
  Query query = match_query(src, tgt, options);
  query.emplace_back("interp", interpolation);
  return decode_npy(transport_->send(post_array("/transfer", std::move(query), encode_npy(values, columns))));
}

std::string Client::transfer_file(const std::string& src, const std::string& tgt, std::span<const double> values, std::size_t columns,
                                  const std::string& format, const std::string& meaning, const MatchOptions& options) const {
  Query query = match_query(src, tgt, options);
  query.emplace_back("format", format);
  query.emplace_back("as", meaning);
  return transport_->send(post_array("/transfer", std::move(query), encode_npy(values, columns)));
}

std::string Client::scene(const std::string& src, const std::string& tgt, const MatchOptions& options) const {
  return transport_->send(get("/scene", match_query(src, tgt, options), longest_wait));
}

api::Job Client::start(const api::MatchRequest& request) const {
  const std::string body = api::to_text(api::to_json(request));
  return parse<api::Job>(transport_->send(send_json("POST", "/match", body, false)));
}

api::Job Client::job(const std::string& id, std::chrono::milliseconds wait) const {
  const auto asked = std::min(wait, longest_wait);
  return parse<api::Job>(transport_->send(get("/jobs/" + id, {{"wait", seconds(asked)}}, asked)));
}

api::JobPage Client::jobs(int limit, const std::optional<std::string>& cursor) const {
  Query query{{"limit", std::to_string(limit)}};
  add_given(query, "cursor", cursor);
  return parse<api::JobPage>(transport_->send(get("/jobs", std::move(query))));
}

void Client::cancel(const std::string& id) const {
  (void)transport_->send({.method = "DELETE", .path = "/jobs/" + id, .query = {}, .body = {}, .content_type = {}, .repeatable = false});
}

void Client::results(const std::string& id, const std::function<bool(const api::PairResult&)>& take, std::int32_t after) const {
  for (int failures = 0;;) {
    const std::string state = job(id).state;  // before the lines are read, so that the last ones are not missed
    std::string rest;
    const auto lines = [&](std::string_view piece) {
      rest.append(piece);
      for (auto end = rest.find('\n'); end != std::string::npos; end = rest.find('\n')) {
        const auto result = parse<api::PairResult>(rest.substr(0, end));
        rest.erase(0, end + 1);
        ++after;
        failures = 0;
        if (!take(result)) return false;
      }
      return true;
    };
    try {
      if (!transport_->stream(get("/jobs/" + id + "/results", {{"after", std::to_string(after)}}, between_lines), lines)) return;
      if (state != "queued" && state != "processing") return;
    } catch (const TransportError&) {
      if (failures == transport_->retries()) throw;
      transport_->pause(failures++);
    }
  }
}

api::Health Client::health() const { return parse<api::Health>(transport_->send(get("/healthz"))); }

api::Version Client::version() const { return parse<api::Version>(transport_->send(get("/version"))); }

}  // namespace spherematch::client
