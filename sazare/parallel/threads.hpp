#pragma once

#include <cstddef>

namespace sazare::parallel {

/// Sets the number of threads of parallel_for; 0 or less: as many as the machine (or OMP_NUM_THREADS) offers.
void set_threads(int count);

/// Lets parallel_for use so many threads at most (at least one), unless a number was set.
void limit_threads(int most);

/// The number of threads that parallel_for uses.
int threads();

/// Processor time of this thread so far [s]; what it waits does not count.
double processor_seconds();

namespace detail {
using RangeFunction = void (*)(void* context, std::size_t begin, std::size_t end);
void run_ranges(std::size_t n, std::size_t pieces, RangeFunction function, void* context);
bool is_serial();

template <class F>
void run_ranges(std::size_t n, std::size_t serial_below, std::size_t pieces, F& f) {
  if (n == 0) return;
  if (n < serial_below || is_serial()) {
    f(std::size_t{0}, n);
    return;
  }
  run_ranges(
      n, pieces, [](void* context, std::size_t begin, std::size_t end) { (*static_cast<F*>(context))(begin, end); },
      const_cast<void*>(static_cast<const void*>(&f)));
}
}  // namespace detail

/// Calls f(begin, end) for contiguous ranges that cover 0..n, as many as there are threads, and waits for all.
///
/// One range on the calling thread when n < serial_below, when there is one thread, or inside another
/// parallel_for. The first exception (lowest range) is thrown again in the caller.
template <class F>
void parallel_for(std::size_t n, std::size_t serial_below, F&& f) {
  detail::run_ranges(n, serial_below, 1, f);
}

/// Like `parallel_for`, for items of very different cost: the range of each thread is cut into pieces, and a thread that has
/// finished its own takes pieces of others.
template <class F>
void parallel_for_uneven(std::size_t n, std::size_t serial_below, F&& f) {
  constexpr std::size_t pieces = 4;
  detail::run_ranges(n, serial_below, pieces, f);
}

}  // namespace sazare::parallel
