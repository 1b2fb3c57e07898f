// Memory that several requests share.
#pragma once

#include <atomic>
#include <cstddef>

namespace spherematch {

/// Thread-safe.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : bytes_(bytes) {}
  ByteBudget(const ByteBudget&) = delete;
  ByteBudget& operator=(const ByteBudget&) = delete;

  /// A part of the budget that grows, and is given back at its end. Used by one thread; must not outlive the budget.
  class Share {
   public:
    explicit Share(ByteBudget& budget) : budget_(budget) {}
    ~Share() { budget_.used_ -= taken_; }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

    /// False, with nothing taken, when the budget does not allow it.
    [[nodiscard]] bool grow(std::size_t bytes) {
      if (budget_.used_.fetch_add(bytes) + bytes > budget_.bytes_) {
        budget_.used_ -= bytes;
        return false;
      }
      taken_ += bytes;
      return true;
    }

   private:
    ByteBudget& budget_;
    std::size_t taken_ = 0;
  };

  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  const std::size_t bytes_;
  std::atomic<std::size_t> used_ = 0;
};

}  // namespace spherematch
