#pragma once

#include <cstddef>
#include <type_traits>

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
void run_ranges(std::size_t n, RangeFunction function, void* context);
bool is_serial();
}  // namespace detail

/// Calls f(begin, end) for contiguous ranges that cover 0..n, one range per thread, and waits for all.
///
/// One range on the calling thread when n < serial_below, when there is one thread, or inside another
/// parallel_for. The first exception (lowest range) is thrown again in the caller.
template <class F>
void parallel_for(std::size_t n, std::size_t serial_below, F&& f) {
  if (n == 0) return;
  if (n < serial_below || detail::is_serial()) {
    f(std::size_t{0}, n);
    return;
  }
  using Function = std::remove_reference_t<F>;
  detail::run_ranges(
      n, [](void* context, std::size_t begin, std::size_t end) { (*static_cast<Function*>(context))(begin, end); },
      const_cast<void*>(static_cast<const void*>(&f)));
}

}  // namespace sazare::parallel
