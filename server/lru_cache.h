// Immutable values in memory, the least recently used dropped first, bounded by bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace spherematch {

/// Thread-safe. A value that a caller holds lives on after it was dropped here.
template <typename Value>
class LruCache {
 public:
  using Pointer = std::shared_ptr<const Value>;

  explicit LruCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Null when absent.
  [[nodiscard]] Pointer find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
  }

  /// Replaces what the key stood for. A value larger than the whole cache is not kept. `bytes` is what the value takes in memory.
  void put(const std::string& key, Pointer value, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    erase_locked(key);
    if (bytes > max_bytes_) return;
    entries_.push_front({key, std::move(value), bytes});
    by_key_[key] = entries_.begin();
    bytes_ += bytes;
    while (bytes_ > max_bytes_) erase_locked(std::string(entries_.back().key));
  }

  void erase(const std::string& key) {
    const std::lock_guard lock(mutex_);
    erase_locked(key);
  }

  /// Linear in the number of values.
  void erase_if(const std::function<bool(std::string_view key)>& unwanted) {
    const std::lock_guard lock(mutex_);
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      const auto next = std::next(entry);
      if (unwanted(entry->key)) erase_locked(std::string(entry->key));
      entry = next;
    }
  }

  [[nodiscard]] std::size_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  struct Entry {
    std::string key;
    Pointer value;
    std::size_t bytes = 0;
  };

  void erase_locked(const std::string& key) {
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return;
    bytes_ -= found->second->bytes;
    entries_.erase(found->second);
    by_key_.erase(found);
  }

  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;  ///< most recently used first
  std::unordered_map<std::string, typename std::list<Entry>::iterator> by_key_;
  std::size_t bytes_ = 0;
};

}  // namespace spherematch
