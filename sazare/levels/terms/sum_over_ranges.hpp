#pragma once

#include <mutex>

#include "sazare/levels/terms/energy_balance.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::terms {

/// Calls f(begin, end, sums) for ranges that cover 0..n, on several threads from `serial_below` on, and adds up their sums.
template <class F>
void sum_over_ranges(std::size_t n, std::size_t serial_below, EnergySums& energies, F&& f) {
  std::mutex adding;
  parallel::parallel_for(n, serial_below, [&](std::size_t begin, std::size_t end) {
    if (end - begin == n) return f(begin, end, energies);
    EnergySums own;
    f(begin, end, own);
    const std::lock_guard lock(adding);
    energies += own;
  });
}

}  // namespace sazare::terms
