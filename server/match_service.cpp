#include "server/match_service.h"

#include <chrono>
#include <exception>
#include <optional>
#include <span>

#include "server/event_log.h"
#include "server/memory_size.h"
#include "server/parameters_json.h"
#include "server/problem.h"
#include "storage/content_id.h"

namespace spherematch {

namespace {

/// Results of large meshes take megabytes each.
constexpr std::size_t max_waiting_saves = 16;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

struct MatchService::Flight {
  MatchPointer result;       ///< once landed, or
  std::exception_ptr error;  ///< once failed
  bool landed = false;
  std::size_t joined = 0;  ///< who wait for it besides the one who computes
  std::stop_source stop;   ///< of the computation
};

std::string_view to_string(MatchSource source) {
  switch (source) {
    case MatchSource::computed:
      return "computed";
    case MatchSource::memory:
      return "memory";
    case MatchSource::store:
      return "store";
    case MatchSource::joined:
      break;
  }
  return "joined";
}

MatchService::MatchService(ShapeService& shapes, MatchStore& store, const EnginePort& engine, Gate& gate, std::stop_token stop,
                           const MatchServiceSettings& settings)
    : shapes_(shapes),
      store_(store),
      engine_(engine),
      gate_(gate),
      stop_(std::move(stop)),
      settings_(settings),
      memory_(settings.memory_bytes),
      saves_(max_waiting_saves) {}

std::string MatchService::key_of(const MatchQuery& query) const {
  const std::string text = query.src + query.tgt + to_json(query.parameters).dump();
  // The shapes in front, so that forget() finds them.
  return query.src + "." + query.tgt + "." + content_id(std::as_bytes(std::span(text)), engine_.version()).id;
}

void MatchService::forget(const std::string& shape) {
  const auto unwanted = [&shape](std::string_view key) { return key.find(shape) != std::string_view::npos; };
  saves_.drop_if(unwanted);
  memory_.erase_if(unwanted);
}

MatchAnswer MatchService::get(const MatchQuery& query, Cache cache, Urgency urgency, const std::stop_token& given_up) {
  const auto started = std::chrono::steady_clock::now();
  MatchAnswer found = answer(query, cache, urgency, given_up);
  const double seconds = seconds_since(started);
  // Only now, when a result computed in the background is stored: a server that ends before computes it again, and after not.
  if (found.source == MatchSource::computed) log_info("match_computed", {{"src", query.src}, {"tgt", query.tgt}, {"seconds", seconds}});
  if (settings_.observe) settings_.observe(found.source, seconds);
  return found;
}

void MatchService::require_room(const MatchQuery& query, Cache cache) {
  try {
    gate_.require_room();
  } catch (const ProblemError&) {
    if (cache == Cache::bypass) throw;
    const std::string key = key_of(query);
    const auto under_way = [&] {
      const std::lock_guard lock(mutex_);
      return flights_.contains(key);
    };
    if (!under_way() && !find(key, query).result) throw;
  }
}

MatchAnswer MatchService::answer(const MatchQuery& query, Cache cache, Urgency urgency, const std::stop_token& given_up) {
  if (cache == Cache::bypass) {
    const Gate::Permit permit = urgency == Urgency::interactive ? gate_.enter() : gate_.enter_behind();
    std::stop_source stop;
    const std::stop_callback giving_up(given_up, [&stop] { stop.request_stop(); });
    return {compute(query, stop), MatchSource::computed};
  }
  const std::string key = key_of(query);
  if (MatchAnswer found = find(key, query); found.result) return found;
  return compute_or_join(key, query, urgency, given_up);
}

MatchAnswer MatchService::find(const std::string& key, const MatchQuery& query) {
  if (MatchPointer result = memory_.find(key)) return {std::move(result), MatchSource::memory};
  if (MatchPointer result = saves_.find(key)) return {std::move(result), MatchSource::memory};
  MatchPointer result = store_.find(key);
  if (result) {
    memory_.put(key, result, memory_size(*result));
    forget_removed(query);
  }
  return {std::move(result), MatchSource::store};
}

MatchAnswer MatchService::compute_or_join(const std::string& key, const MatchQuery& query, Urgency urgency,
                                          const std::stop_token& given_up) {
  // Who has time waits for its turn before it takes the lead, so that nobody in a hurry waits behind it.
  std::optional<Gate::Permit> permit;
  if (urgency == Urgency::background) permit.emplace(gate_.enter_behind());
  bool mine = false;
  const FlightPointer flight = board(key, mine);
  if (mine) return lead(flight, key, query, permit ? &*permit : nullptr, given_up);
  permit.reset();
  return join(flight);
}

MatchService::FlightPointer MatchService::board(const std::string& key, bool& mine) {
  const std::lock_guard lock(mutex_);
  auto& flight = flights_[key];
  mine = flight == nullptr;
  if (mine) {
    flight = std::make_shared<Flight>();
  } else if (joined_ == settings_.max_joined) {
    throw ProblemError(api::Code::overloaded, "too many requests wait for a match; try again");
  } else {
    ++joined_;
    ++flight->joined;
  }
  return flight;
}

MatchAnswer MatchService::join(const FlightPointer& flight) {
  std::unique_lock lock(mutex_);
  landed_.wait(lock, [&flight] { return flight->landed; });
  --joined_;
  if (flight->error) std::rethrow_exception(flight->error);
  return {flight->result, MatchSource::joined};
}

MatchAnswer MatchService::lead(const FlightPointer& flight, const std::string& key, const MatchQuery& query, Gate::Permit* permit,
                               const std::stop_token& given_up) {
  MatchAnswer found;
  std::exception_ptr error;
  try {
    // Once more: another flight may have landed between the look into the caches and the start of this one.
    found = find(key, query);
    if (!found.result) {
      std::optional<Gate::Permit> own;
      if (permit == nullptr) own.emplace(gate_.enter());
      const std::stop_callback giving_up(given_up, [&] { abandon(flight, key); });
      found = {compute(query, flight->stop), MatchSource::computed};
      keep(key, query, found.result, permit == nullptr ? Urgency::interactive : Urgency::background);
    }
  } catch (...) {
    error = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    flight->result = found.result;
    flight->error = error;
    flight->landed = true;
    remove_locked(flight, key);
  }
  landed_.notify_all();
  if (error) std::rethrow_exception(error);
  return found;
}

void MatchService::abandon(const FlightPointer& flight, const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (flight->joined > 0) return;
  flight->stop.request_stop();
  remove_locked(flight, key);
}

void MatchService::remove_locked(const FlightPointer& flight, const std::string& key) {
  const auto found = flights_.find(key);
  if (found != flights_.end() && found->second == flight) flights_.erase(found);
}

MatchPointer MatchService::compute(const MatchQuery& query, std::stop_source& stop) {
  const std::stop_callback with_the_server(stop_, [&stop] { stop.request_stop(); });
  const Progress progress{.report = {}, .stop = stop.get_token()};
  progress.check();
  const PreparedParts parts = query.parameters.mesh_flow ? PreparedParts::all : PreparedParts::without_eigenbasis;
  const ShapePointer source = shapes_.load(query.src, parts);
  // One object where one shape is matched with itself: the engine then knows that it looks for a symmetry.
  const ShapePointer target = query.tgt == query.src ? source : shapes_.load(query.tgt, parts);
  return std::make_shared<const MatchResult>(engine_.match(source, target, query.parameters, progress));
}

void MatchService::keep(const std::string& key, const MatchQuery& query, const MatchPointer& result, Urgency urgency) {
  memory_.put(key, result, memory_size(*result));
  if (urgency == Urgency::background) {
    save(key, query, *result);
  } else {
    saves_.add(key, result, [this, key, query, result] { save(key, query, *result); });
  }
  forget_removed(query);
}

void MatchService::forget_removed(const MatchQuery& query) {
  for (const std::string& shape : {query.src, query.tgt}) {
    if (!shapes_.knows(shape)) forget(shape);
  }
}

void MatchService::save(const std::string& key, const MatchQuery& query, const MatchResult& result) {
  try {
    store_.save(key, query.src, query.tgt, engine_.version(), result);
  } catch (const std::exception& error) {
    // The answer is there; only the next one has to be computed again.
    log_warning("match_not_stored", {{"key", key}, {"detail", error.what()}});
  }
}

}  // namespace spherematch
