#include "server/match_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "api/json.h"
#include "server/event_log.h"
#include "server/match_query.h"
#include "server/problem.h"

namespace spherematch {

namespace {

std::string random_id() {
  std::random_device device;
  std::string id;
  for (int i = 0; i < 4; ++i) id += fmt::format("{:08x}", device());
  return id;
}

std::string options_text(const api::MatchRequest& request) {
  return api::to_text(api::Json{{"fields", request.fields},
                                {"both", request.both},
                                {"method", request.method},
                                {"refine", request.refine},
                                {"orientation", request.orientation}});
}

/// Problems of the moment: the pair is tried again.
bool passes(api::Code code) {
  return code == api::Code::shape_not_ready || code == api::Code::overloaded || code == api::Code::insufficient_storage;
}

}  // namespace

MatchJobs::MatchJobs(JobStore& store, ShapeService& shapes, MatchService& matches, const MatchJobsSettings& settings)
    : store_(store), shapes_(shapes), matches_(matches), settings_(settings) {
  for (const std::string& id : store_.unfinished()) {
    const auto record = store_.find(id);
    if (record) add(id, record->options, record->finished_pairs);
  }
  for (std::size_t i = 0; i < settings_.workers; ++i) workers_.emplace_back([this] { work_loop(); });
}

MatchJobs::~MatchJobs() { stop(); }

std::string MatchJobs::create(const api::MatchRequest& request) {
  const std::string options = options_text(request);
  (void)options_of(options);  // refuses what is no option
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& [source, target] : request.pairs) {
    shapes_.require_known(source);
    shapes_.require_known(target);
    pairs.emplace_back(source, target);
  }
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) throw ProblemError(api::Code::draining, "the server is stopping");
    if (active_.size() >= settings_.max_active) throw ProblemError(api::Code::overloaded, "too many jobs at once; try again");
  }
  const std::string id = random_id();
  store_.create(id, options, pairs, settings_.keep_finished);
  add(id, options, 0);
  log_info("match_job_created", {{"job", id}, {"pairs", pairs.size()}});
  return id;
}

void MatchJobs::add(const std::string& id, std::string_view options, std::int32_t finished) {
  auto job = std::make_shared<Active>();
  job->id = id;
  job->options = options_of(options);
  job->finished = finished;
  for (JobPair& pair : store_.open_pairs(id)) job->open.push_back(std::move(pair));
  {
    const std::lock_guard lock(mutex_);
    active_.push_back(std::move(job));
  }
  work_.notify_all();
}

MatchJobOptions MatchJobs::options_of(std::string_view stored) {
  const api::Json json = api::Json::parse(stored);
  const std::string refine = json.value("refine", "default");  // jobs of older servers do not say it
  MatchJobOptions options{match_parameters_of(json.at("method").get<std::string>(), refine, json.at("orientation").get<std::string>()),
                          parse_fields(json.at("fields").get<std::string>())};
  options.parameters.both = json.at("both").get<bool>();
  return options;
}

MatchJobs::ActivePointer MatchJobs::find_locked(std::string_view id) const {
  const auto found = std::find_if(active_.begin(), active_.end(), [id](const ActivePointer& job) { return job->id == id; });
  return found == active_.end() ? nullptr : *found;
}

std::int32_t MatchJobs::position(std::string_view id) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(active_.begin(), active_.end(), [id](const ActivePointer& job) { return job->id == id; });
  return found == active_.end() ? 0 : static_cast<std::int32_t>(std::distance(active_.begin(), found));
}

bool MatchJobs::wait(std::string_view id, Clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [&] { return stopping_ || find_locked(id) == nullptr; });
  return find_locked(id) == nullptr;
}

bool MatchJobs::wait_for_line(std::string_view id, std::int32_t lines, Clock::time_point deadline) const {
  std::unique_lock lock(mutex_);
  const auto has_more = [&] {
    const ActivePointer job = find_locked(id);
    return job == nullptr || job->finished > lines;
  };
  changed_.wait_until(lock, deadline, [&] { return stopping_ || has_more(); });
  return has_more();
}

bool MatchJobs::cancel(std::string_view id) {
  if (!store_.cancel(id)) return false;
  ActivePointer job;
  {
    const std::lock_guard lock(mutex_);
    job = find_locked(id);
    std::erase(active_, job);
  }
  if (job) job->cancelled.request_stop();
  changed_.notify_all();
  log_info("match_job_cancelled", {{"job", id}});
  return true;
}

MatchJobs::Counts MatchJobs::counts() const {
  const std::lock_guard lock(mutex_);
  const auto started =
      static_cast<std::size_t>(std::count_if(active_.begin(), active_.end(), [](const auto& job) { return job->started; }));
  return {active_.size() - started, started};
}

void MatchJobs::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_all();
  changed_.notify_all();
  workers_.clear();  // joins
}

/// The oldest job with a pair to work on. Where there is none, `wake` becomes the time at which there may be one.
MatchJobs::ActivePointer MatchJobs::next_locked(Clock::time_point& wake) const {
  const auto now = Clock::now();
  wake = now + std::chrono::hours(1);
  for (const ActivePointer& job : active_) {
    if (job->open.empty()) continue;
    if (job->not_before <= now) return job;
    wake = std::min(wake, job->not_before);
  }
  return nullptr;
}

void MatchJobs::work_loop() {
  while (true) {
    ActivePointer job;
    JobPair pair;
    bool first = false;
    {
      std::unique_lock lock(mutex_);
      Clock::time_point wake;
      while (!stopping_ && (job = next_locked(wake)) == nullptr) work_.wait_until(lock, wake);
      if (stopping_) return;
      pair = std::move(job->open.front());
      job->open.pop_front();
      ++job->running;
      first = !std::exchange(job->started, true);
    }
    Outcome outcome = Outcome::later;
    try {
      if (first) store_.mark_started(job->id);
      outcome = run(*job, pair);
    } catch (const std::exception& error) {
      log_error("match_job_pair_not_stored", {{"job", job->id}, {"detail", error.what()}});
    }
    settle(job, pair, outcome);
  }
}

MatchJobs::Outcome MatchJobs::run(const Active& job, const JobPair& pair) {
  try {
    const MatchQuery query{pair.source, pair.target, job.options.parameters};
    await_shapes(shapes_, query, std::chrono::milliseconds(0));
    (void)matches_.get(query, MatchService::Cache::use, MatchService::Urgency::background, job.cancelled.get_token());
  } catch (...) {
    const api::Problem problem = problem_of(std::current_exception()).problem();
    // The server stops, and the pair stays open in the store; or the job was cancelled.
    if (problem.code == api::Code::draining || problem.code == api::Code::cancelled) return Outcome::stopped;
    if (passes(problem.code)) return Outcome::later;
    store_.finish_pair(job.id, pair.position, api::entry_of(problem.code).wire, problem.detail);
    return Outcome::finished;
  }
  store_.finish_pair(job.id, pair.position);
  return Outcome::finished;
}

void MatchJobs::settle(const ActivePointer& job, const JobPair& pair, Outcome outcome) {
  bool ended = false;
  {
    const std::lock_guard lock(mutex_);
    --job->running;
    if (outcome == Outcome::finished) {
      ++job->finished;
      job->put_off = 0;
    } else {
      job->open.push_back(pair);
      if (++job->put_off >= job->open.size()) {
        job->put_off = 0;
        job->not_before = Clock::now() + settings_.retry_after;
      }
    }
    ended = job->open.empty() && job->running == 0 && std::erase(active_, job) > 0;
  }
  work_.notify_one();
  changed_.notify_all();
  if (ended) log_info("match_job_finished", {{"job", job->id}});
}

api::PairResult MatchJobs::result_of(const JobPair& pair, const MatchJobOptions& options) {
  api::PairResult line{pair.position, pair.source, pair.target, {}, {}};
  const auto fail = [&line](api::Code code, std::string detail) {
    line.error.emplace();
    line.error->code = code;
    line.error->detail = std::move(detail);
  };
  if (!pair.error_code.empty()) {
    fail(api::code_from_wire(pair.error_code).value_or(api::Code::internal), pair.error_detail);
    return line;
  }
  try {
    const MatchQuery query{pair.source, pair.target, options.parameters};
    const api::Shape target = shapes_.get(pair.target);
    shapes_.require_known(pair.source);
    MatchedShapes shapes;
    if (options.fields.quality()) shapes = {shapes_.load(pair.source), shapes_.load(pair.target)};
    line.match = match_of(query, matches_.get(query, MatchService::Cache::use, MatchService::Urgency::background), options.fields,
                          target.vertices, matches_.engine(), shapes);
  } catch (...) {
    const api::Problem problem = problem_of(std::current_exception()).problem();
    fail(problem.code, problem.detail);
  }
  return line;
}

}  // namespace spherematch
