#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real g = 9.81;

using Settings = std::vector<std::string>;

runs::RectanglesModel table(const Settings& settings) {
  runs::RectanglesModel model = runs::build_rectangles(registry::read_case("cases/shaking-table/case.toml", settings));
  model.stepper->start();
  return model;
}

/// The block's width and height, and the table's acceleration as a triangle that rises by `rate` in a second: a sine of so low
/// a frequency that it is straight.
Settings rising(Real width, Real height, Real rate, Real friction) {
  constexpr Real frequency = 1e-3;
  return {fmt::format("blocks.0.lower=[{},0.0,0.0]", -0.5 * width),
          fmt::format("blocks.0.upper=[{},{},0.0]", 0.5 * width, height),
          fmt::format("motions.0.amplitude={}", rate / (2 * std::numbers::pi * frequency)),
          fmt::format("motions.0.frequency={}", frequency),
          "motions.0.cycles=0",
          fmt::format("contact.friction_angle={}", std::atan(friction) * 180 / std::numbers::pi),
          "gauges=[]",
          "time.end=20",
          "time.snapshot_interval=1"};
}

Real acceleration(const runs::RectanglesModel& model) {
  return model.stepper->supports().motions[0].at(model.stepper->time()).acceleration;
}

/// Acceleration at which the block begins to slide [m/s2]: the first slip after it has settled.
Real sliding(Real friction) {
  const auto model = table(rising(1, 0.5, 0.5, friction));
  while (model.stepper->time() < 1) model.stepper->advance();
  const Real before = model.forces->contacts().losses().friction;
  while (model.forces->contacts().losses().friction <= before && model.stepper->time() < 20) model.stepper->advance();
  return acceleration(model);
}

/// Acceleration at which one of its corners rises [m/s2].
Real rocking(Real width, Real height) {
  const auto model = table(rising(width, height, 0.3, 5));
  while (model.stepper->time() < 1) model.stepper->advance();
  const auto corners = [&] {
    const auto& outlines = model.forces->outlines();
    const auto& particles = model.stepper->particles();
    return geometry::overlap(outlines.at(particles, 0), outlines.at(particles, 1)).count;
  };
  while (corners() == 2 && model.stepper->time() < 20) model.stepper->advance();
  return acceleration(model);
}

/// Whether the block falls over under half a sine.
bool overturns(Real width, Real amplitude, Real frequency) {
  const auto model =
      table({fmt::format("blocks.0.lower=[{},0.0,0.0]", -0.5 * width), fmt::format("blocks.0.upper=[{},2.0,0.0]", 0.5 * width),
             fmt::format("motions.0.amplitude={}", amplitude), fmt::format("motions.0.frequency={}", frequency), "gauges=[]",
             "time.end=8", "time.snapshot_interval=1"});
  while (model.stepper->time() < 8) {
    model.stepper->advance();
    const Real angle = std::abs(model.stepper->particles().angle[0]);
    if (angle > 0.5) return true;
    if (model.stepper->time() > 1.5 / frequency && angle < 1e-4) return false;
  }
  return false;
}

/// The least amplitude that overturns it [m/s2], by bisection.
Real overturning(Real width, Real frequency, Real low, Real high) {
  while (high - low > 1e-3 * low) {
    const Real middle = 0.5 * (low + high);
    (overturns(width, middle, frequency) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Housner's rocking block of small angles, theta'' = p^2 (theta - alpha + a/g), p^2 = 3 g/(4 R), in closed form: A sin(w t)
/// rocks it from sin(w s) = 1/q on, q = A/(g alpha), and overturns it when what grows as exp(p t) is positive after the pulse,
///
///     w/p = sqrt(q^2 - 1) + q exp(-p (pi/w - s)).
///
/// Housner's own q = sqrt(1 + (w/p)^2) leaves out the last term.
Real housner(Real width, Real frequency) {
  const Real half_diagonal = std::hypot(0.5 * width, 1.0), p = std::sqrt(3 * g / (4 * half_diagonal)),
             w = 2 * std::numbers::pi * frequency;
  Real low = 1, high = 100;
  for (int halving = 0; halving < 60; ++halving) {
    const Real q = 0.5 * (low + high);
    const Real grows = std::sqrt(q * q - 1) + q * std::exp(-p * (std::numbers::pi - std::asin(1 / q)) / w);
    (grows > w / p ? high : low) = q;
  }
  return g * std::atan(0.5 * width) * low;
}

constexpr Real friction = 0.3, horizontal = 6, vertical = 4, shaking = 2;  // m/s2, Hz

Settings newmark_settings() {
  return {"blocks.0.lower=[-0.5,0.0,0.0]", "blocks.0.upper=[0.5,0.5,0.0]",
          fmt::format("motions=[{{name=\"pulse\",type=\"sine\",frequency={},cycles=6,amplitude={}}},"
                      "{{name=\"vertical\",type=\"sine\",frequency={},cycles=9,amplitude={}}}]",
                      shaking, horizontal, 1.5 * shaking, vertical),
          "walls.0.motion_y=\"vertical\"",
          fmt::format("contact.friction_angle={:.17g}", std::atan(friction) * 180 / std::numbers::pi), "gauges=[]",
          "time.end=3.5", "time.snapshot_interval=0.5",
          // Friction follows the springs without the dashpots, so both are stiff and weak here.
          "contact.face_normal_stiffness=1e11", "contact.face_shear_stiffness=1e11", "contact.damping_ratio=0.2"};
}

/// How far a block has slid over the table after shaking both ways [m].
Real shaken() {
  const auto model = table(newmark_settings());
  while (model.stepper->time() < 3.5) model.stepper->advance();
  const auto& moved = model.stepper->particles().displacement;
  return moved[0][0] - moved[0][1];
}

/// Newmark's sliding block, whose friction follows the vertical acceleration, in steps of 1e-6 s.
Real newmark() {
  constexpr Real dt = 1e-6, end = 6 / shaking;
  Real velocity = 0, slip = 0;
  for (std::int64_t i = 0; i < std::llround(3.5 / dt); ++i) {
    const Real time = (static_cast<Real>(i) + 0.5) * dt;
    const Real pull = time < end ? -horizontal * std::sin(2 * std::numbers::pi * shaking * time) : 0;
    const Real bears = friction * (g + (time < end ? vertical * std::sin(3 * std::numbers::pi * shaking * time) : 0));
    if (velocity == 0 && std::abs(pull) <= bears) continue;
    const Real direction = velocity != 0 ? std::copysign(1, velocity) : std::copysign(1, pull);
    const Real next = velocity + dt * (pull - direction * bears);
    velocity = velocity != 0 && next * velocity < 0 ? 0 : next;
    slip += dt * velocity;
  }
  return slip;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  validation::print_row("sliding", sliding(0.3), 0.3 * g);
  validation::print_row("rocking", rocking(0.5, 2), g * 0.25);
  validation::print_row("rocking-slender", rocking(0.2, 2), g * 0.1);
  validation::print_row("overturning-1-hz", overturning(0.2, 1, 1.0, 6), housner(0.2, 1));
  validation::print_row("overturning-2-hz", overturning(0.2, 2, 1.0, 12), housner(0.2, 2));
  validation::print_row("newmark", shaken(), newmark());
}
