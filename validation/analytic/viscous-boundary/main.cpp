#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/parallel/threads.hpp"
#include "validation/common/mps_trace.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Amplitude of what the viscous base sends back of a wave, over that of the wave.
Real reflected(std::size_t axis, Real velocity) {
  const std::vector<std::string> settings = {
      fmt::format("boundaries=[{{side=\"bottom\",kind=\"viscous\",motion_{}=\"wavelet\"}}]", "xy"[axis]), "time.end=4",
      "time.step=1e-3"};
  const auto trace = validation::trace_gauges("cases/column-ricker/case.toml", settings, axis);
  // The wave passes the surface around 0.25 s + 100 m / velocity. What the base sends back of it gets there 200 m later, and
  // doubles.
  const std::vector<Real>& surface = trace.acceleration.back();
  const Real passed = 0.5 + 100 / velocity;
  Real incident = 0, returned = 0;
  for (std::size_t k = 0; k < surface.size(); ++k) {
    const Real size = 0.5 * std::abs(surface[k]);
    Real& part = trace.step * static_cast<Real>(k) < passed ? incident : returned;
    part = std::max(part, size);
  }
  return returned / incident;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  validation::print_row("shear", reflected(0, 100));
  validation::print_row("pressure", reflected(1, 200));
}
