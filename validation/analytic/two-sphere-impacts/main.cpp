#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

void print_row(const std::string& row, Real ours, Real expected) { validation::print_row(row.c_str(), ours, expected); }

struct Solid {
  laws::GrainElasticity elasticity;
  Real density, restitution, friction;
};

constexpr laws::GrainElasticity rigid{1e20, 0};

struct Ball {
  Real radius;
  Vector3 centre, velocity, spin = Vector3::Zero();
};

struct After {
  std::vector<Vector3> velocity, spin;  ///< by ball
  Real largest_overlap = 0, largest_force = 0, duration = 0;
};

/// Hertz: how long a contact of these lasts [s].
Real duration(Real mass, Real radius, Real modulus, Real speed) {
  return 2.868265 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2);
}

/// One impact, from just before it to the end of the contact.
After impact(const Solid& solid, const std::vector<Ball>& balls, Real expected_duration, int resolution = 4000) {
  state::Spheres spheres;
  for (const Ball& ball : balls) {
    spheres.add(ball.centre, ball.radius, solid.density, 0);
    spheres.set_motion(spheres.size() - 1, ball.velocity, ball.spin);
  }
  methods::spheres::ContactTable table(laws::ContactModel::hertz, 2);
  table.set(0, 0, laws::hertz_constants(solid.elasticity, solid.elasticity, solid.restitution, {solid.friction}));
  table.set(0, 1, laws::hertz_constants(solid.elasticity, rigid, solid.restitution, {solid.friction}));
  std::vector<methods::spheres::Wall> walls;
  if (balls.size() == 1) walls.emplace_back().material = 1;
  const Real step = expected_duration / resolution, radius = balls.front().radius;
  methods::spheres::SphereStepper stepper(std::move(spheres), table, walls, {step, Vector3::Zero(), radius, radius});
  stepper.start();
  After after;
  bool met = false;
  for (int k = 0; k < 8 * resolution && !(met && stepper.contacts() == 0); ++k) {
    stepper.advance();
    stepper.evaluate_now();
    if (stepper.contacts() == 0) continue;
    met = true;
    after.duration += step;
    const auto& places = stepper.spheres().place;
    const Real gap = balls.size() == 1 ? places[0].z - radius
                                       : (places[0].centre() - places[1].centre()).norm() - places[0].radius - places[1].radius;
    after.largest_overlap = std::max(after.largest_overlap, -gap);
    after.largest_force = std::max(after.largest_force, std::abs(stepper.load(0).fz));
  }
  for (Index number = 0; number < static_cast<Index>(balls.size()); ++number) {
    const auto& numbers = stepper.spheres().number;
    const auto i = static_cast<std::size_t>(std::ranges::find(numbers, number) - numbers.begin());
    after.velocity.push_back(stepper.velocity(i));
    after.spin.push_back(stepper.spin(i));
  }
  return after;
}

Real modulus_of(const laws::GrainElasticity& solid) {
  return solid.youngs_modulus / (1 - solid.poisson_ratio * solid.poisson_ratio);
}
Real mass_of(Real density, Real radius) { return density * 4.18879020478639 * radius * radius * radius; }

/// A ball of a solid on a rigid plane, its lowest point at the plane.
After on_plane(const Solid& solid, Real radius, const Vector3& velocity, const Vector3& spin = Vector3::Zero()) {
  return impact(solid, {{radius, {0, 0, radius}, velocity, spin}},
                duration(mass_of(solid.density, radius), radius, modulus_of(solid.elasticity), -velocity.z()));
}

/// Test 1: two alike, each at 10 m/s.
void equal_spheres(const std::string& name, const Solid& solid) {
  const Real radius = 0.01, speed = 10, mass = 0.5 * mass_of(solid.density, radius), modulus = 0.5 * modulus_of(solid.elasticity);
  const Real expected = duration(mass, 0.5 * radius, modulus, 2 * speed);
  const After after =
      impact(solid, {{radius, {0, 0, -radius}, {0, 0, speed}}, {radius, {0, 0, radius}, {0, 0, -speed}}}, expected);
  const Real stiffness = 4.0 / 3 * modulus * std::sqrt(0.5 * radius),
             deepest = std::pow(1.25 * mass * 4 * speed * speed / stiffness, 0.4);
  print_row("1-" + name + "-force", after.largest_force, stiffness * std::pow(deepest, 1.5));
  print_row("1-" + name + "-overlap", after.largest_overlap, deepest);
  print_row("1-" + name + "-time", after.duration, expected);
}

/// Test 2: on a rigid plane at 0.2 m/s.
void on_rigid_plane(const std::string& name, const Solid& solid) {
  const Real radius = 0.1, speed = 0.2, mass = mass_of(solid.density, radius), modulus = modulus_of(solid.elasticity);
  const After after = on_plane(solid, radius, {0, 0, -speed});
  const Real stiffness = 4.0 / 3 * modulus * std::sqrt(radius), deepest = std::pow(1.25 * mass * speed * speed / stiffness, 0.4);
  print_row("2-" + name + "-force", after.largest_force, stiffness * std::pow(deepest, 1.5));
  print_row("2-" + name + "-time", after.duration, duration(mass, radius, modulus, speed));
}

/// Test 3: the restitution that was asked for, at 3.9 m/s.
void restitutions(const Solid& solid) {
  for (const Real restitution : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    Solid changed = solid;
    changed.restitution = restitution;
    print_row(fmt::format("3-restitution-{:.1f}", restitution), on_plane(changed, 0.0025, {0, 0, -3.9}).velocity[0].z() / 3.9,
              restitution);
  }
}

/// What a contact that slides throughout brings across: the integral of N where it pushes, and that of N d/2, by which the arm is
/// shorter.
struct Push {
  Real impulse = 0;    ///< [N s]
  Real short_arm = 0;  ///< [N m s]
};

/// Integrates m d'' = -K sqrt(R) d^(3/2) - c(d) d' alone, the damping that of Antypov and Elliott.
Push push_of(Real mass, Real radius, Real modulus, Real restitution, Real speed) {
  const Real stiffness = 4.0 / 3 * modulus * std::sqrt(radius), log = std::log(restitution);
  const Real damping =
      -std::sqrt(5.0) * log / std::sqrt(log * log + std::numbers::pi * std::numbers::pi) * std::sqrt(mass * stiffness);
  const Real step = duration(mass, radius, modulus, speed) / 2e5;
  Push push;
  Real depth = speed * step, rate = speed;
  while (depth > 0) {
    const Real force = stiffness * std::pow(depth, 1.5) + damping * std::pow(depth, 0.25) * rate;
    push.impulse += step * std::max(force, Real{0});
    push.short_arm += step * std::max(force, Real{0}) * depth / 2;
    rate -= step * force / mass;
    depth += step * rate;
  }
  return push;
}

/// Tests 4 and 5: sliding throughout.
void oblique(const std::string& name, const Solid& solid, Real radius, const Vector3& velocity) {
  const After after = on_plane(solid, radius, velocity);
  const Real mass = mass_of(solid.density, radius);
  const Push push = push_of(mass, radius, modulus_of(solid.elasticity), solid.restitution, -velocity.z());
  print_row(name + "-tangential", after.velocity[0].x() / velocity.x(), 1 - solid.friction * push.impulse / mass / velocity.x());
  print_row(name + "-spin", after.spin[0].y(),
            2.5 * solid.friction * (push.impulse * radius - push.short_arm) / (mass * radius * radius));
}

/// Test 6: with spin, at a normal speed of 0.2 m/s.
void spinning(const Solid& solid) {
  const Real radius = 0.1, speed = 0.2, spin = -24, mass = mass_of(solid.density, radius);
  const Push push = push_of(mass, radius, modulus_of(solid.elasticity), solid.restitution, speed);
  const After after = on_plane(solid, radius, {0, 0, -speed}, {0, spin, 0});
  print_row("6-velocity", after.velocity[0].x(), -solid.friction * push.impulse / mass);
  print_row("6-spin", after.spin[0].y(),
            spin + 2.5 * solid.friction * (push.impulse * radius - push.short_arm) / (mass * radius * radius));
}

/// Tests 7 and 8: two spheres with spin at a closing speed of 0.4 m/s.
void spinning_pair(const std::string& name, const Solid& solid, Real first_radius, Real second_radius) {
  const Real speed = 0.2, spin = 30;
  const Real m1 = mass_of(solid.density, first_radius), m2 = mass_of(solid.density, second_radius), mass = m1 * m2 / (m1 + m2);
  const Real radius = first_radius * second_radius / (first_radius + second_radius), modulus = 0.5 * modulus_of(solid.elasticity);
  const After after = impact(solid,
                             {{first_radius, {0, 0, -first_radius}, {0, 0, speed}, {0, spin, 0}},
                              {second_radius, {0, 0, second_radius}, {0, 0, -speed}, {0, spin, 0}}},
                             duration(mass, radius, modulus, 2 * speed));
  // The first one's upper side moves along +x, so friction pushes it along -x.
  const Push push = push_of(mass, radius, modulus, solid.restitution, 2 * speed);
  const auto slowed = [&](Real own_mass, Real own_radius) {
    return spin - 2.5 * solid.friction * (push.impulse * own_radius - push.short_arm) / (own_mass * own_radius * own_radius);
  };
  print_row(name + "-velocity", after.velocity[0].x(), -solid.friction * push.impulse / m1);
  print_row(name + "-spin", after.spin[0].y(), slowed(m1, first_radius));
  print_row(name + "-other-spin", after.spin[1].y(), slowed(m2, second_radius));
}

}  // namespace

int main() {
  parallel::set_threads(1);
  equal_spheres("glass", {{4.8e10, 0.20}, 2800, 1, 0.35});
  equal_spheres("limestone", {{2.0e10, 0.25}, 2500, 1, 0.35});
  on_rigid_plane("aluminium", {{7.0e10, 0.30}, 2699, 1, 0});
  on_rigid_plane("magnesium", {{4.0e10, 0.35}, 1800, 1, 0});
  const Solid oxide{{3.8e11, 0.23}, 4000, 0.98, 0.092}, alloy{{7.0e10, 0.33}, 2700, 1, 0.18};
  restitutions(oxide);
  const Real angle = 1.2;  // rad to the normal
  oblique("4-oxide", oxide, 0.0025, 3.9 * Vector3(std::sin(angle), 0, -std::cos(angle)));
  oblique("4-alloy", alloy, 0.0025, 3.9 * Vector3(std::sin(angle), 0, -std::cos(angle)));
  oblique("5-steel", {{2.08e11, 0.30}, 7850, 1, 0.3}, 1e-5, {20, 0, -5});
  oblique("5-polyethylene", {{1.0e9, 0.30}, 1400, 1, 0.3}, 1e-5, {20, 0, -5});
  const Solid damped{{7.0e10, 0.33}, 2700, 0.5, 0.4};
  spinning(damped);
  spinning_pair("7", damped, 0.1, 0.1);
  spinning_pair("8", damped, 0.1, 0.5);
}
