#pragma once

#include <mutex>

#include "sazare/levels/terms/ledger.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::terms {

/// Calls f(begin, end, sums) for ranges that cover 0..n, on several threads from `serial_below` on, and adds up their sums.
template <class F>
void book_ranges(std::size_t n, std::size_t serial_below, Books& books, F&& f) {
  std::mutex adding;
  parallel::parallel_for(n, serial_below, [&](std::size_t begin, std::size_t end) {
    if (end - begin == n) return f(begin, end, books);
    Books own;
    f(begin, end, own);
    const std::lock_guard lock(adding);
    books += own;
  });
}

}  // namespace sazare::terms
