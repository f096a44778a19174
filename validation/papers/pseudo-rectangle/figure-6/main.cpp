#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real slope = 40 * std::numbers::pi / 180, friction = 38 * std::numbers::pi / 180, begin = 0.02, end = 0.5;

/// How far the block has slid between `begin` and the end, less what its velocity at `begin` makes of it [m]. Placed on the
/// slope without pressing on it, the block meets less friction until it has settled, within a millisecond.
Real slip(Real normal, Real ratio, Real step) {
  const cases::CaseFile file = registry::read_case(
      "cases/block-on-slope/case.toml",
      std::vector<std::string>{fmt::format("contact.face_normal_stiffness={:e}", normal),
                               fmt::format("contact.face_shear_stiffness={:e}", ratio * normal), fmt::format("time.step={:e}", step)});
  const runs::RectanglesModel model = runs::build_rectangles(file);
  model.stepper->start();
  const auto down = [](const auto& columns) { return -(std::cos(slope) * columns[0][0] + std::sin(slope) * columns[1][0]); };
  const auto advance_to = [&](Real time) {
    const auto steps = std::llround(time / step);
    while (model.stepper->steps() < steps) model.stepper->advance();
    return down(model.stepper->particles().displacement);
  };
  const Real before = advance_to(begin), velocity = down(model.stepper->velocity());
  return advance_to(end) - before - velocity * (end - begin);
}

}  // namespace

int main() {
  parallel::set_threads(1);
  // (20), the acceleration along the slope by t^2/2, from `begin`.
  const Real exact = std::cos(slope) * (std::tan(slope) - std::tan(friction)) * 0.5 * 9.81 * (end - begin) * (end - begin);
  constexpr Real stiffness = 3e8;  // Pa: 12 kN/mm for each end of the face, 0.04 m thick
  validation::print_row("case-1", slip(stiffness, 1, 1e-6), exact);
  validation::print_row("case-2", slip(stiffness, 0.01, 1e-6), exact);
  validation::print_row("case-3", slip(stiffness, 0.001, 1e-6), exact);
  validation::print_row("case-4", slip(100 * stiffness, 1, 1e-7), exact);
}
