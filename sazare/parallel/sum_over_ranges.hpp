#pragma once

/// Sums over ranges that do not depend on the number of threads, where whatever is added up is added without rounding.

#include <mutex>

#include "sazare/parallel/threads.hpp"

namespace sazare::parallel {

/// Calls f(begin, end, sums) for ranges that cover 0..n, on several threads from `serial_below` on, and adds up their sums in any
/// order. `Sums` are nothing at first, and may be added with +=.
template <class Sums, class F>
void sum_over_ranges(std::size_t n, std::size_t serial_below, Sums& total, F&& f) {
  std::mutex adding;
  parallel_for(n, serial_below, [&](std::size_t begin, std::size_t end) {
    if (end - begin == n) return f(begin, end, total);
    Sums own{};
    f(begin, end, own);
    const std::lock_guard lock(adding);
    total += own;
  });
}

}  // namespace sazare::parallel
