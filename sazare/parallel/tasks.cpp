#include "sazare/parallel/tasks.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "sazare/parallel/threads.hpp"

namespace sazare::parallel {

void run_tasks(std::size_t count, int threads_wanted, const std::function<void(std::size_t)>& task) {
  set_threads(1);
  std::atomic<std::size_t> next{0};
  std::mutex failure_lock;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t number = next++; number < count; number = next++) {
      try {
        task(number);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failure_lock);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < threads_wanted; ++i) threads.emplace_back(work);
    work();
  }
  set_threads(threads_wanted);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sazare::parallel
