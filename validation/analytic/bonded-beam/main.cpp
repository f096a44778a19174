#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real radius = 0.01, spacing = 0.02, bond_radius = 0.008, modulus = 1e9, poisson = 0.25, density = 2300;
constexpr int nodes = 11;

/// Beam theory for the whole of a beam of these bonds.
struct Beam {
  Real length, radius, modulus, poisson;

  Real area() const { return std::numbers::pi * radius * radius; }
  Real second_moment() const { return 0.25 * area() * radius * radius; }
  Real shear_modulus() const { return 0.5 * modulus / (1 + poisson); }
  Real bend() const { return modulus * second_moment() / length; }
  /// 12 E I/(k G A L^2), with Cowper's k.
  Real shear() const {
    const Real coefficient = 6 * (1 + poisson) / (7 + 6 * poisson);
    return 12 * modulus * second_moment() / (coefficient * shear_modulus() * area() * length * length);
  }
  Real across() const { return 12 * bend() / (length * length * (1 + shear())); }
};

const Beam whole{spacing * (nodes - 1), bond_radius, modulus, poisson};

methods::spheres::Bond bond(Index first, Real mass) {
  methods::spheres::Bond bond;
  bond.first = first;
  bond.second = first + 1;
  bond.radius = bond_radius;
  bond.stiffness = laws::beam_stiffness(spacing, bond_radius, modulus, poisson);
  bond.direction = {1, 0, 0};
  const Real inertia = 0.2 * mass * radius * radius;
  bond.damping = {2 * std::sqrt(0.5 * mass * bond.stiffness.stretch), 2 * std::sqrt(0.5 * mass * bond.stiffness.shear) / spacing,
                  2 * std::sqrt(inertia * bond.stiffness.bend)};
  return bond;
}

/// Load on the last sphere of a beam at rest, of which both ends are held and the last one was moved and turned.
state::SphereLoad reaction(const Vector3& shift, const Vector3& turning) {
  state::Spheres spheres;
  for (int n = 0; n < nodes; ++n)
    spheres.add(spacing * Vector3(n, 0, 0) + (n + 1 == nodes ? shift : Vector3(Vector3::Zero())), radius, density, 0,
                n == 0 || n + 1 == nodes);
  spheres.turn.resize(nodes);
  spheres.turn.back() = {std::sqrt(1 - 0.25 * turning.squaredNorm()), 0.5 * turning.x(), 0.5 * turning.y(), 0.5 * turning.z()};
  std::vector<methods::spheres::Bond> bonds;
  for (Index n = 0; n + 1 < nodes; ++n) bonds.push_back(bond(n, spheres.place[1].mass));
  const Real step = 0.1 * methods::spheres::stable_step(bonds, spheres);
  methods::spheres::ContactTable table(laws::ContactModel::linear, 1);
  table.set(0, 0, laws::linear_constants(1, 1, 1, {}));
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  methods::spheres::SphereStepper stepper(std::move(spheres), table, {}, {step, Vector3::Zero(), radius, radius},
                                methods::spheres::Bonds(std::move(bonds), {{infinite, infinite, 0, 1}}));
  stepper.start();
  for (int k = 0; k < 1000000; ++k) stepper.advance();
  stepper.evaluate_now();
  const auto& numbers = stepper.spheres().number;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] + 1 == nodes) return stepper.load(i);
  return {};
}

void statics() {
  const Real small = 1e-5, shift = small * whole.length;
  using validation::print_row;
  print_row("stretch", -reaction({shift, 0, 0}, Vector3::Zero()).fx, modulus * whole.area() * small);
  const auto sheared = reaction({0, 0, shift}, Vector3::Zero());
  print_row("shear-force", -sheared.fz, whole.across() * shift);
  print_row("shear-moment", -sheared.my, 0.5 * whole.across() * whole.length * shift);
  const auto bent = reaction(Vector3::Zero(), {0, small, 0});
  print_row("bending-moment", -bent.my, whole.bend() * (4 + whole.shear()) / (1 + whole.shear()) * small);
  print_row("bending-force", -bent.fz, 0.5 * whole.across() * whole.length * small);
  print_row("twist", -reaction(Vector3::Zero(), {small, 0, 0}).mx,
            whole.shear_modulus() * 2 * whole.second_moment() / whole.length * small);
}

/// The case bonded-beam, until it breaks.
void breaking() {
  const cases::CaseFile file = registry::read_case("cases/bonded-beam/case.toml");
  const auto& rules = file.as<cases::SpheresCase>().bonds.front();
  const Beam beam{0.2, 0.01, *rules.youngs_modulus, *rules.poisson_ratio};
  runs::SpheresModel model = runs::build_spheres(file);
  methods::spheres::SphereStepper& stepper = *model.stepper;
  stepper.start();
  const Real speed = 0.005;
  // Half the way to where it breaks.
  const Real breaks_at = *rules.tensile_strength / modulus * beam.length * beam.length * (1 + beam.shear()) / (6 * beam.radius);
  Real force = 0, way = 0;
  Index samples = 0;
  while (stepper.broken_bonds() == 0 && way < 2 * breaks_at) {
    stepper.advance();
    way = speed * stepper.time();
    if (way < 0.4 * breaks_at || way > 0.6 * breaks_at) continue;
    stepper.evaluate_now();
    for (std::size_t i = 0; i < stepper.spheres().size(); ++i)
      if (model.group[static_cast<std::size_t>(stepper.spheres().number[i])] == 2) force += stepper.load(i).fz / way;
    ++samples;
  }
  validation::print_row("stiffness", force / samples, beam.across());
  validation::print_row("breaks-at", way, breaks_at);
}

}  // namespace

int main() {
  parallel::set_threads(1);
  statics();
  breaking();
}
