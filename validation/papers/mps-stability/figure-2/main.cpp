#include <fmt/format.h>

#include <cmath>

#include "sazare/laws/ground_motion.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/mps_trace.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real height = 100, velocity = 100, before_second_wave = 1.6;

struct Surface {
  Real arrival = 0;    ///< peak at the surface after that at the base [s]
  Real amplitude = 0;  ///< largest acceleration [m/s2]
  Real error = 0;      ///< of the wave form, over the exact one
};

/// Exact: the wave goes up from the row at D/2, passes the top row and comes back from the free surface half a spacing above.
Surface surface(Real spacing) {
  const auto trace = validation::trace_gauges("cases/column-ricker/case.toml",
                                              {fmt::format("particles.spacing={}", spacing), "time.end=1.6"}, 0, 5);
  const laws::Ricker wave{4, 0.25};
  const std::vector<Real>& found = trace.acceleration.back();
  Surface result;
  Real square = 0, exact_square = 0;
  std::size_t peak = 1;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Real time = trace.step * static_cast<Real>(i);
    if (time > before_second_wave) break;
    const Real exact = laws::ricker(wave, time - (height - spacing) / velocity) + laws::ricker(wave, time - height / velocity);
    square += (found[i] - exact) * (found[i] - exact);
    exact_square += exact * exact;
    if (i > 0 && i + 1 < found.size() && std::abs(found[i]) > std::abs(found[peak])) peak = i;
  }
  const Real left = found[peak - 1], middle = found[peak], right = found[peak + 1];
  const Real shift = 0.5 * (left - right) / (left - 2 * middle + right);  // of the parabola through three points
  result.arrival = trace.step * (static_cast<Real>(peak) + shift) - wave.peak_time;
  result.amplitude = std::abs(middle - 0.25 * (left - right) * shift);
  result.error = std::sqrt(square / exact_square);
  return result;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const Surface coarse = surface(2), paper = surface(1), fine = surface(0.5);
  validation::print_row("arrival", paper.arrival);
  validation::print_row("amplitude", fine.amplitude);
  validation::print_row("amplitude-order", std::log2((2 - paper.amplitude) / (2 - fine.amplitude)));
  validation::print_row("order", std::log2(coarse.error / paper.error));
  validation::print_row("order-fine", std::log2(paper.error / fine.error));
}
