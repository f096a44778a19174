#pragma once

#include <cstddef>
#include <functional>

namespace sazare::parallel {

/// Calls task(0) ... task(count - 1), each once, on so many threads; whoever is free takes the next. Inside a task parallel_for
/// uses one thread. The first exception ends the rest and is thrown again in the caller.
void run_tasks(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace sazare::parallel
