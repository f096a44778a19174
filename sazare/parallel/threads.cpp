#include "sazare/parallel/threads.hpp"

#include <omp.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <vector>

namespace sazare::parallel {
namespace {

/// 0: not set, as many as OpenMP offers.
std::atomic<int> chosen_threads{0};

/// How many pieces of a thread's range are begun.
struct alignas(64) Begun {
  std::atomic<std::size_t> pieces = 0;
};

/// One parallel_for.
struct Work {
  std::size_t n;
  std::size_t pieces;  ///< of each range
  std::vector<Begun> begun;
  detail::RangeFunction function;
  void* context;

  std::mutex failure_lock = {};
  std::size_t failed_part = SIZE_MAX;  ///< the lowest
  std::exception_ptr failure = {};

  /// The pieces that are left of a range.
  void run_range(std::size_t range) noexcept {
    for (std::size_t piece = begun[range].pieces++; piece < pieces; piece = begun[range].pieces++)
      run(range * pieces + piece, begun.size() * pieces);
  }

  void run(std::size_t part, std::size_t parts) noexcept {
    const std::size_t quotient = n / parts;
    const std::size_t rest = n % parts;
    const std::size_t begin = part * quotient + std::min(part, rest);
    const std::size_t end = begin + quotient + (part < rest ? 1 : 0);
    if (begin == end) return;
    try {
      function(context, begin, end);
    } catch (...) {
      const std::lock_guard lock(failure_lock);
      if (part > failed_part) return;
      failed_part = part;
      failure = std::current_exception();
    }
  }
};

// A race detector cannot see into the OpenMP library. The fence tells it that each thread's work comes after
// what the caller did before, and before what the caller does next; the fork itself is hidden from it.
#if defined(__has_feature)
#define SAZARE_SANITIZE_THREAD __has_feature(thread_sanitizer)  // as Clang says it
#elif defined(__SANITIZE_THREAD__)
#define SAZARE_SANITIZE_THREAD 1
#else
#define SAZARE_SANITIZE_THREAD 0
#endif
#if SAZARE_SANITIZE_THREAD
#define SAZARE_HIDE_FORK __attribute__((no_sanitize_thread, noinline))
#else
#define SAZARE_HIDE_FORK
#endif

std::atomic<int> fence{0};

void run_thread(Work* work, std::size_t thread) {
  fence.load(std::memory_order_acquire);
  // Its own range, then what others have left, or have not begun: OpenMP may give fewer threads than asked for.
  const std::size_t ranges = work->begun.size();
  for (std::size_t n = 0; n < ranges; ++n) work->run_range((thread + n) % ranges);
  fence.fetch_add(1, std::memory_order_release);
}

SAZARE_HIDE_FORK void fork(Work* work, int ranges) {
#pragma omp parallel num_threads(ranges) default(none) firstprivate(work)
  run_thread(work, static_cast<std::size_t>(omp_get_thread_num()));
}

}  // namespace

void set_threads(int count) { chosen_threads = std::max(count, 0); }

void limit_threads(int most) {
  if (chosen_threads == 0) chosen_threads = std::clamp(most, 1, omp_get_max_threads());
}

int threads() {
  const int chosen = chosen_threads;
  return chosen > 0 ? chosen : omp_get_max_threads();
}

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

namespace detail {

bool is_serial() { return omp_in_parallel() != 0 || threads() == 1; }

void run_ranges(std::size_t n, std::size_t pieces, RangeFunction function, void* context) {
  const auto ranges = std::min(static_cast<std::size_t>(threads()), n);
  Work work{n, pieces, std::vector<Begun>(ranges), function, context};
  fence.fetch_add(1, std::memory_order_release);
  fork(&work, static_cast<int>(ranges));
  fence.load(std::memory_order_acquire);
  if (work.failure) std::rethrow_exception(work.failure);
}

}  // namespace detail

}  // namespace sazare::parallel
