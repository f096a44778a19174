#include "sazare/parallel/threads.hpp"

#include <omp.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>

namespace sazare::parallel {
namespace {

/// 0: not set, as many as OpenMP offers.
std::atomic<int> chosen_threads{0};

/// One parallel_for.
struct Work {
  std::size_t n;
  std::size_t parts;
  detail::RangeFunction function;
  void* context;

  std::mutex failure_lock = {};
  std::size_t failed_part = SIZE_MAX;  ///< the lowest
  std::exception_ptr failure = {};

  void run(std::size_t part) noexcept {
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
#if defined(__SANITIZE_THREAD__)
#define SAZARE_HIDE_FORK __attribute__((no_sanitize_thread, noinline))
#else
#define SAZARE_HIDE_FORK
#endif

std::atomic<int> fence{0};

void run_thread(Work* work, std::size_t thread, std::size_t thread_count) {
  fence.load(std::memory_order_acquire);
  // OpenMP may give fewer threads than asked for: then each does several parts.
  for (std::size_t part = thread; part < work->parts; part += thread_count) work->run(part);
  fence.fetch_add(1, std::memory_order_release);
}

SAZARE_HIDE_FORK void fork(Work* work, int parts) {
#pragma omp parallel num_threads(parts) default(none) firstprivate(work)
  run_thread(work, static_cast<std::size_t>(omp_get_thread_num()), static_cast<std::size_t>(omp_get_num_threads()));
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

void run_ranges(std::size_t n, RangeFunction function, void* context) {
  const auto parts = std::min(static_cast<std::size_t>(threads()), n);
  Work work{n, parts, function, context};
  fence.fetch_add(1, std::memory_order_release);
  fork(&work, static_cast<int>(parts));
  fence.load(std::memory_order_acquire);
  if (work.failure) std::rethrow_exception(work.failure);
}

}  // namespace detail

}  // namespace sazare::parallel
