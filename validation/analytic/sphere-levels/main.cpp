#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr laws::GrainElasticity soft{1e8, 0.3};
constexpr Real density = 2500, largest_radius = 8e-3;

/// Rayleigh time step of a sphere [s].
Real rayleigh(Real radius) {
  const Real shear_modulus = 0.5 * soft.youngs_modulus / (1 + soft.poisson_ratio);
  return 3.14159265358979 * radius * std::sqrt(density / shear_modulus) / (0.1631 * soft.poisson_ratio + 0.8766);
}

methods::spheres::ContactTable table(Real restitution, Real friction) {
  methods::spheres::ContactTable contacts(laws::ContactModel::hertz, 1);
  contacts.set(0, 0, laws::hertz_constants(soft, soft, restitution, {friction}));
  return contacts;
}

std::int8_t level_of(Real radius) { return static_cast<std::int8_t>(std::ceil(std::log2(largest_radius / radius) - 1e-9)); }

class Random {
public:
  /// From -1 to 1.
  Real operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state_ >> 11) / 4503599627370496.0 - 1;
  }

private:
  std::uint64_t state_ = 11;
};

/// A row of spheres in a domain that is periodic along it, pressed together so that all contacts stay closed.
struct Ring {
  std::vector<Real> radius;
  Real overlap = 2e-5;  ///< of the smallest contact; the others push as much [m]
  Real speed = 5e-3;    ///< of the spheres along the row at the start, random [m/s]
  Real restitution = 1, friction = 0;
  bool sags = false;  ///< across, the first sphere being held: sliders begin from rest

  state::Spheres spheres(Random& random) const {
    state::Spheres row;
    Real place = 0;
    for (std::size_t n = 0; n < radius.size(); ++n) {
      row.add({place, 0, 0}, radius[n], density, 0, sags && n == 0);
      const Real along = speed * random();
      if (row.kick[n].inverse_mass > 0) row.set_motion(n, {along, 0, 0}, Vector3::Zero());
      const Real next = radius[(n + 1) % radius.size()];
      const Real share = std::cbrt(smallest_reduced() * (radius[n] + next) / (radius[n] * next));
      place += radius[n] + next - overlap * share;
    }
    row.box.length.x() = place;
    return row;
  }

  Real smallest_reduced() const {
    Real least = largest_radius;
    for (std::size_t n = 0; n < radius.size(); ++n) {
      const Real next = radius[(n + 1) % radius.size()];
      least = std::min(least, radius[n] * next / (radius[n] + next));
    }
    return least;
  }

  methods::spheres::SphereStepper stepper(Real step, bool levels) const {
    Random random;
    std::vector<std::int8_t> level;
    if (levels)
      for (const Real one : radius) level.push_back(level_of(one));
    return {spheres(random),
            table(restitution, friction),
            {},
            {step, sags ? Vector3(0, -20, 5) : Vector3(0, 0, 0), 1e-3, 1e-3, level}};
  }
};

/// A bar of bonded spheres that touch, pulled and whirled at random; nothing touches but by bonds.
struct Bar {
  std::vector<Real> radius;
  Real damping = 0;  ///< share of the critical one of a bond
  Real whirl = 1;    ///< of the whole bar, across it [rad/s]

  methods::spheres::SphereStepper stepper(Real step, bool levels) const {
    Random random;
    state::Spheres spheres;
    Real place = 0;
    for (std::size_t n = 0; n < radius.size(); ++n) {
      if (n > 0) place += radius[n - 1] + radius[n];
      spheres.add({place, 0, 0}, radius[n], density, 0);
      const Real vx = random(), vy = random(), vz = random();
      spheres.set_motion(n, Vector3(1e-2 * vx, 1e-2 * vy, 1e-2 * vz + whirl * place), {0, -whirl, 0});
    }
    const auto bonds = bonds_of(spheres);
    std::vector<std::int8_t> level;
    if (levels) level = levels_of(spheres);
    return {std::move(spheres),
            table(1, 0),
            {},
            {step, Vector3::Zero(), 1e-3, 1e-3, level},
            methods::spheres::Bonds(bonds, {{infinite, infinite, 0, 1}})};
  }

  /// A fifth of the largest stability limit of any sphere [s].
  Real base_step() const {
    state::Spheres spheres;
    for (const Real one : radius) spheres.add({0, 0, 0}, one, density, 0);
    return 0.2 * std::ranges::max(methods::spheres::stable_steps(bonds_of(spheres), spheres));
  }

private:
  static constexpr Real infinite = std::numeric_limits<Real>::infinity();

  std::vector<methods::spheres::Bond> bonds_of(const state::Spheres& spheres) const {
    std::vector<methods::spheres::Bond> bonds;
    for (std::size_t n = 0; n + 1 < radius.size(); ++n) {
      methods::spheres::Bond bond;
      bond.first = static_cast<Index>(n);
      bond.second = static_cast<Index>(n + 1);
      bond.radius = std::min(radius[n], radius[n + 1]);
      bond.stiffness = laws::beam_stiffness(radius[n] + radius[n + 1], bond.radius, soft.youngs_modulus, soft.poisson_ratio);
      bond.direction = {1, 0, 0};
      const Real mass = std::min(spheres.place[n].mass, spheres.place[n + 1].mass);
      bond.damping.along = bond.damping.across = damping * std::sqrt(bond.stiffness.stretch * mass);
      bonds.push_back(bond);
    }
    return bonds;
  }

  std::vector<std::int8_t> levels_of(const state::Spheres& spheres) const {
    const auto limits = methods::spheres::stable_steps(bonds_of(spheres), spheres);
    const Real largest = std::ranges::max(limits);
    std::vector<std::int8_t> level;
    for (const Real limit : limits) level.push_back(static_cast<std::int8_t>(std::ceil(std::log2(largest / limit) - 1e-9)));
    return level;
  }
};

void advance(methods::spheres::SphereStepper& stepper, int steps) {
  for (int k = 0; k < steps; ++k) stepper.advance();
  stepper.evaluate_now();
}

/// Velocities and spins, each times the radius of its sphere, by number.
std::vector<Vector3> motion(const methods::spheres::SphereStepper& stepper) {
  const state::Spheres& spheres = stepper.spheres();
  std::vector<Vector3> motion(2 * spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto number = static_cast<std::size_t>(spheres.number[i]);
    motion[2 * number] = stepper.velocity(i);
    motion[2 * number + 1] = spheres.place[i].radius * stepper.spin(i);
  }
  return motion;
}

Real distance(const std::vector<Vector3>& one, const std::vector<Vector3>& other) {
  Real sum = 0;
  for (std::size_t n = 0; n < one.size(); ++n) sum += (one[n] - other[n]).squaredNorm();
  return std::sqrt(sum);
}

/// Observed order of convergence of a row or a bar.
template <class Scene>
Real observed_order(const Scene& scene, bool levels, Real end = 4e-3) {
  constexpr int coarse = 256, ticks = 8;
  const auto at_end = [&](int steps, bool with_levels) {
    auto stepper = scene.stepper(end / steps, with_levels);
    stepper.start();
    advance(stepper, steps);
    return motion(stepper);
  };
  const int scale = levels ? 1 : ticks;
  const auto exact = at_end(32 * ticks * coarse, false);
  return std::log2(distance(at_end(scale * coarse, levels), exact) / distance(at_end(2 * scale * coarse, levels), exact));
}

void print_orders() {
  Ring ring{{8e-3, 4e-3, 1e-3, 8e-3, 2e-3, 6e-3, 1e-3, 5e-3}};
  validation::print_row("elastic-one-step", observed_order(ring, false));
  validation::print_row("elastic-levels", observed_order(ring, true));
  ring.restitution = 0.8;
  ring.friction = 5;
  ring.sags = true;
  validation::print_row("damped-one-step", observed_order(ring, false));
  validation::print_row("damped-levels", observed_order(ring, true));
  Bar bar;
  bar.radius = ring.radius;
  validation::print_row("bonded-one-step", observed_order(bar, false, 5e-4));
  validation::print_row("bonded-levels", observed_order(bar, true, 5e-4));
  bar.damping = 0.1;
  validation::print_row("bonded-damped-levels", observed_order(bar, true, 5e-4));
}

/// A small sphere meets a large one, 1:8, head on: share of the relative speed that is left.
Real restitution_of_one_to_eight(Real restitution) {
  constexpr Real small = 1e-3, speed = 1;
  state::Spheres spheres;
  spheres.add({0, 0, 0}, largest_radius, density, 0);
  spheres.add({largest_radius + small + 1e-5, 0, 0}, small, density, 0);
  spheres.set_motion(1, {-speed, 0, 0}, Vector3::Zero());
  methods::spheres::SphereStepper stepper(std::move(spheres), table(restitution, 0), {},
                                {0.2 * rayleigh(largest_radius), Vector3::Zero(), 1e-3, 1e-3, {0, 3}});
  stepper.start();
  bool met = false;
  for (int k = 0; k < 200 && !(met && stepper.contacts() == 0); ++k) {
    stepper.advance();
    stepper.evaluate_now();
    met = met || stepper.contacts() > 0;
  }
  const auto after = motion(stepper);
  return (after[2].x() - after[0].x()) / speed;
}

/// A cloud of sizes 1:8 that falls into itself.
struct Cloud {
  std::vector<std::int8_t> level;
  state::Spheres spheres;
  Real mass = 0;

  Cloud() {
    Random random;
    constexpr int across = 7;
    for (int i = 0; i < across * across * across; ++i) {
      const Real radius = i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 3e-3 : largest_radius;
      const Vector3 place(i % across, i / across % across, i / across / across);
      spheres.add(0.0145 * place, radius, density, 0);
      const Real vx = random(), vy = random(), vz = random(), wx = random(), wy = random(), wz = random();
      const Vector3 inwards = 0.3 * (Vector3::Constant(0.5 * (across - 1)) - place);
      spheres.set_motion(spheres.size() - 1, inwards + 0.3 * Vector3(vx, vy, vz), 50 * Vector3(wx, wy, wz));
      level.push_back(level_of(radius));
      mass += spheres.place.back().mass;
    }
  }
};

void print_momentum() {
  Cloud cloud;
  methods::spheres::SphereStepper stepper(cloud.spheres, table(0.7, 0.4), {},
                                {0.2 * rayleigh(largest_radius), Vector3::Zero(), 5e-4, 5e-4, cloud.level});
  stepper.start();
  stepper.evaluate_now();
  const Vector3 momentum = stepper.momentum(), angular = stepper.angular_momentum();
  advance(stepper, 400);
  validation::print_row("momentum", (stepper.momentum() - momentum).norm() / cloud.mass);
  validation::print_row("angular-momentum", (stepper.angular_momentum() - angular).norm() / (cloud.mass * 0.05));
  const auto& counts = stepper.levels().counts();
  validation::print_row("levels", static_cast<Real>(stepper.levels().count()));
  validation::print_row("evaluations", static_cast<Real>(counts.evaluations) / static_cast<Real>(counts.uniform_evaluations));
}

/// Residual of the energy balance when the cloud has fallen on a floor, over what was lost.
Real residual(Real fraction) {
  Cloud cloud;
  constexpr Real end = 0.03;
  const int steps = static_cast<int>(std::ceil(end / (fraction * rayleigh(largest_radius))));
  methods::spheres::Wall floor;
  floor.point.z() = -0.01;
  methods::spheres::SphereStepper stepper(cloud.spheres, table(0.7, 0.4), {floor},
                                {end / steps, Vector3(0, 0, -9.81), 5e-4, 5e-4, cloud.level});
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum();
  advance(stepper, steps);
  const auto now = stepper.energies();
  return std::abs(now.sum() - before) / (now.dashpot_work + now.sliding_work);
}

void print_energy_balance() {
  const Real coarse = residual(0.2), fine = residual(0.05);
  validation::print_row("energy-balance", coarse);
  validation::print_row("energy-balance-falls", fine / coarse);
}

/// How much the largest kinetic energy seen has grown from the first to the last third of a long swing.
Real growth(methods::spheres::SphereStepper stepper) {
  constexpr int steps = 3000, look = 50;
  stepper.start();
  stepper.evaluate_now();
  Real first = 0, last = 0;
  for (int k = 0; k < steps; k += look) {
    advance(stepper, look);
    const auto now = stepper.energies();
    Real& part = k < steps / 3 ? first : last;
    if (k < steps / 3 || k >= 2 * steps / 3) part = std::max(part, now.translation + now.rotation);
  }
  return last / first;
}

/// Random rows and bars without any dashpot, each some hundred times to and fro: the largest growth.
void print_resonance() {
  constexpr int rows = 60;
  Random random;
  const auto radii_by_chance = [&] {
    std::vector<Real> radius;
    const int count = 3 + static_cast<int>(2 * (1 + random()));
    for (int k = 0; k < count; ++k) radius.push_back(largest_radius * std::exp2(1.5 * (random() - 1)));
    radius.front() = largest_radius;
    radius.back() = largest_radius / 8;
    return radius;
  };
  Real of_rows = 0, of_bars = 0;
  for (int n = 0; n < rows; ++n) {
    Ring ring;
    ring.radius = radii_by_chance();
    of_rows = std::max(of_rows, growth(ring.stepper(0.2 * rayleigh(largest_radius), true)));
  }
  for (int n = 0; n < rows; ++n) {
    Bar bar;
    bar.radius = radii_by_chance();
    bar.whirl = 0;
    of_bars = std::max(of_bars, growth(bar.stepper(bar.base_step(), true)));
  }
  validation::print_row("resonance", of_rows);
  validation::print_row("bonded-resonance", of_bars);
}

}  // namespace

int main() {
  print_orders();
  validation::print_row("elastic-collision", restitution_of_one_to_eight(1));
  validation::print_row("damped-collision", restitution_of_one_to_eight(0.5));
  print_momentum();
  print_energy_balance();
  print_resonance();
}
