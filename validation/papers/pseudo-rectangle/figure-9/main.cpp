#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real width = 0.025, height = 0.075, plate_speed = 0.005;

/// Rotation at an inclination psi of the base by way of the plate [rad/m]: the root of Bray and Goodman's moments about the
/// corner, [Matsui1999], eq. (25) of its section 3 (2), by the midpoint rule over the block and bisection.
Real rotation_rate(Real psi) {
  constexpr int across = 25, up = 75;
  const auto moment = [&](Real rate) {
    Real sum = 0;
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < up; ++j) {
        const Real w = (i + 0.5) * width / across, h = (j + 0.5) * height / up;
        const Real arm = w * std::cos(psi) - h * std::sin(psi), square = w * w + h * h;
        sum += (arm - square * rate) / std::sqrt(1 - 2 * arm * rate + square * rate * rate);
      }
    return sum;
  };
  Real low = -100, high = 100;  // turning counts as w to h here: clockwise
  for (int halving = 0; halving < 60; ++halving) {
    const Real middle = 0.5 * (low + high);
    (moment(middle) > 0 ? low : high) = middle;
  }
  return -0.5 * (low + high);
}

/// Rotation after a way of the plate [rad], by Runge and Kutta.
Real rotation_by_theory(Real slope, Real way) {
  constexpr int parts = 100;
  Real turned = 0;
  for (int i = 0; i < parts; ++i) {
    const Real step = way / parts;
    const Real k1 = rotation_rate(slope + turned), k2 = rotation_rate(slope + turned + 0.5 * step * k1);
    const Real k3 = rotation_rate(slope + turned + 0.5 * step * k2), k4 = rotation_rate(slope + turned + step * k3);
    turned += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return turned;
}

struct Motion {
  Real turn = 0;  ///< [rad]
  Real slip = 0;  ///< of the corner down the slope [m]
};

/// Motion after a way of the plate; `flat`: the block lies on its long side.
Motion run(Real degrees, Real size, Real way, bool flat) {
  const Real slope = degrees * std::numbers::pi / 180, c = std::cos(slope), s = std::sin(slope);
  const cases::CaseFile file = registry::read_case(
      "cases/base-friction/case.toml",
      std::vector<std::string>{fmt::format("blocks.0.angle={:.1f}", degrees), fmt::format("blocks.0.element_size={:e}", size),
                               flat ? "blocks.0.upper=[0.075,0.025,0]" : "blocks.0.upper=[0.025,0.075,0]",
                               fmt::format("walls.0.from=[{:.15f},{:.15f},0.0]", -0.3 * c, -0.3 * s),
                               fmt::format("walls.0.to=[{:.15f},{:.15f},0.0]", 0.3 * c, 0.3 * s), "gauges=[]"});
  const runs::RectanglesModel model = runs::build_rectangles(file);
  model.stepper->start();
  const auto steps = std::llround(way / plate_speed / model.step);
  while (model.stepper->steps() < steps) model.stepper->advance();
  // The first element is the one at the corner; (23), (24).
  const auto& particles = model.stepper->particles();
  const Real half = 0.5 * size, angle = particles.angle[0];
  const Real x = particles.displacement[0][0] - half * ((std::cos(angle) - std::sin(angle)) - (c - s));
  const Real y = particles.displacement[1][0] - half * ((std::sin(angle) + std::cos(angle)) - (s + c));
  return {angle - slope, -(x * c + y * s)};
}

}  // namespace

int main() {
  parallel::set_threads(1);
  constexpr Real way = 0.02;
  for (const int degrees : {45, 50, 60, 70, 75}) {
    const Motion coarse = run(degrees, 0.025, way, false);
    const Real theory = rotation_by_theory(degrees * std::numbers::pi / 180, way);
    validation::print_row(fmt::format("rotation-{}", degrees).c_str(), coarse.turn, theory);
  }
  for (const int degrees : {60, 75}) {
    const Motion fine = run(degrees, 0.005, way, false);
    validation::print_row(fmt::format("rotation-{}-fine", degrees).c_str(), fine.turn,
                          rotation_by_theory(degrees * std::numbers::pi / 180, way));
    validation::print_row(fmt::format("slip-{}-fine", degrees).c_str(), fine.slip);
  }
  for (const int degrees : {45, 60, 75}) {
    const Real slope = degrees * std::numbers::pi / 180, friction = 38 * std::numbers::pi / 180;
    validation::print_row(fmt::format("slip-{}-flat", degrees).c_str(), run(degrees, 0.025, way, true).slip / way,
                          std::sin(slope) - std::tan(friction) * std::cos(slope));
  }
}
