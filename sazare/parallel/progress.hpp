#pragma once

/// How far threads have come with their shares of some tasks, for those that must not be ahead of others.

#include <atomic>
#include <cstddef>
#include <limits>
#include <thread>
#include <vector>

namespace sazare::parallel {

class Progress {
public:
  explicit Progress(std::size_t shares) : shares_(shares) {}

  /// A thread works on a share from now on.
  void begin(std::size_t share) { shares_[share].begun.store(true, std::memory_order_release); }
  bool has_begun(std::size_t share) const { return shares_[share].begun.load(std::memory_order_acquire); }

  /// A share has done all tasks before this one.
  void set(std::size_t share, std::size_t task) { shares_[share].done.store(task, std::memory_order_release); }

  /// Waits until a share has come so far. False where it never will: a thread has given up.
  bool wait(std::size_t share, std::size_t task) const {
    for (int looks = 0; !has_come(share, task);)
      if (looks < looks_before_yield)
        ++looks;
      else
        std::this_thread::yield();  // there may be more threads than cores
    return !failed_.load(std::memory_order_acquire);
  }

  /// Nobody is to wait any longer.
  void give_up() {
    failed_.store(true, std::memory_order_release);
    for (Share& share : shares_) share.done.store(std::numeric_limits<std::size_t>::max(), std::memory_order_release);
  }

private:
  bool has_come(std::size_t share, std::size_t task) const { return shares_[share].done.load(std::memory_order_acquire) >= task; }

  static constexpr int looks_before_yield = 2000;  // some microseconds

  struct alignas(64) Share {  // a line of the cache each
    std::atomic<bool> begun{false};
    std::atomic<std::size_t> done{0};
  };

  std::vector<Share> shares_;
  std::atomic<bool> failed_{false};
};

}  // namespace sazare::parallel
