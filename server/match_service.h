// Matches, each computed once: from memory, from the store, or by the engine.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/data/correspondence.h"
#include "engine/data/parameters.h"
#include "server/deferred_saves.h"
#include "server/engine_port.h"
#include "server/gate.h"
#include "server/lru_cache.h"
#include "server/shape_service.h"
#include "storage/match_store.h"

namespace spherematch {

/// Everything that determines a result.
struct MatchQuery {
  std::string src;  ///< shape ids
  std::string tgt;
  MatchParameters parameters;
};

/// Where a result came from.
enum class MatchSource { computed, memory, store, joined };  ///< joined: computed at this moment for another request

/// "computed", "memory", "store", "joined".
[[nodiscard]] std::string_view to_string(MatchSource source);

struct MatchAnswer {
  MatchPointer result;
  MatchSource source = MatchSource::computed;

  [[nodiscard]] bool cached() const { return source == MatchSource::memory || source == MatchSource::store; }
};

struct MatchServiceSettings {
  std::size_t memory_bytes = std::size_t{64} << 20;
  std::size_t max_joined = 64;                                    ///< requests that wait for another's result; further ones get 503
  std::function<void(MatchSource, double seconds)> observe = {};  ///< called for every answer; must be thread-safe and not throw
};

/// Thread-safe.
class MatchService {
 public:
  /// All must outlive this. `stop` ends computations when the server stops.
  MatchService(ShapeService& shapes, MatchStore& store, const EnginePort& engine, Gate& gate, std::stop_token stop,
               const MatchServiceSettings& settings);

  enum class Cache { use, bypass };                ///< bypass: computed afresh and not kept
  enum class Urgency { interactive, background };  ///< background: only when nobody else waits, but without a bound on the waiting

  /// The result for two shapes that are ready. Concurrent calls for the same query compute once. A computation ends early when `given_up`
  /// is requested, unless others wait for it. What an interactive call computed is stored after it returns: a server that is killed in
  /// between computes it again.
  /// @throws ProblemError(not_found, shape_failed, shape_not_ready, overloaded, draining), EngineError(cancelled, invalid_parameter)
  [[nodiscard]] MatchAnswer get(const MatchQuery& query, Cache cache = Cache::use, Urgency urgency = Urgency::interactive,
                                const std::stop_token& given_up = {});

  /// Turns a request away before anything is read for it. @throws ProblemError(overloaded) when get() would have to compute and could not
  void require_room(const MatchQuery& query, Cache cache);

  /// What names a query in caches and entity tags: the same text for the same result, for one engine version.
  [[nodiscard]] std::string key_of(const MatchQuery& query) const;

  [[nodiscard]] const EnginePort& engine() const { return engine_; }

  /// Drops what is in memory of a shape that was removed, also what is still to be stored; the store does so by itself.
  void forget(const std::string& shape);

  [[nodiscard]] std::size_t memory_bytes() const { return memory_.bytes(); }
  [[nodiscard]] std::size_t store_bytes() const { return store_.bytes(); }

 private:
  /// A computation under way and all who wait for it.
  struct Flight;
  using FlightPointer = std::shared_ptr<Flight>;

  [[nodiscard]] MatchAnswer answer(const MatchQuery& query, Cache cache, Urgency urgency, const std::stop_token& given_up);
  [[nodiscard]] MatchAnswer find(const std::string& key, const MatchQuery& query);
  [[nodiscard]] MatchAnswer compute_or_join(const std::string& key, const MatchQuery& query, Urgency urgency,
                                            const std::stop_token& given_up);
  /// The flight of the key; `mine` is set where there was none before.
  [[nodiscard]] FlightPointer board(const std::string& key, bool& mine);
  [[nodiscard]] MatchAnswer join(const FlightPointer& flight);
  [[nodiscard]] MatchAnswer lead(const FlightPointer& flight, const std::string& key, const MatchQuery& query, Gate::Permit* permit,
                                 const std::stop_token& given_up);
  /// Ends the flight early, unless somebody joined it. Who comes later takes another.
  void abandon(const FlightPointer& flight, const std::string& key);
  void remove_locked(const FlightPointer& flight, const std::string& key);
  [[nodiscard]] MatchPointer compute(const MatchQuery& query, std::stop_source& stop);
  /// In the background the result is in the store when this returns; else soon, and at the latest when this service ends.
  void keep(const std::string& key, const MatchQuery& query, const MatchPointer& result, Urgency urgency);
  /// After something came into memory: a shape may have been removed while it was computed or read, and forget() came too early for it.
  void forget_removed(const MatchQuery& query);
  void save(const std::string& key, const MatchQuery& query, const MatchResult& result);

  ShapeService& shapes_;
  MatchStore& store_;
  const EnginePort& engine_;
  Gate& gate_;
  const std::stop_token stop_;
  const MatchServiceSettings settings_;
  LruCache<MatchResult> memory_;
  std::mutex mutex_;
  std::condition_variable landed_;
  std::unordered_map<std::string, FlightPointer> flights_;
  std::size_t joined_ = 0;
  DeferredSaves saves_;  ///< last, so that what it saves is still there
};

}  // namespace spherematch
