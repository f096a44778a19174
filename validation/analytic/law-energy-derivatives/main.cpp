#include <algorithm>
#include <cmath>

#include "sazare/laws/sphere_contact.hpp"
#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Central difference.
template <class F>
Real slope(F&& energy, Real at, Real step) {
  return (energy(at + step) - energy(at - step)) / (2 * step);
}

/// Over compression, the elastic branch and unloading after every share of the way to failure; relative to the strength.
Real tension_error(const laws::JointTension& law) {
  Real worst = 0;
  for (int share = 0; share < 20; ++share) {
    const Real peak = law.elastic_opening + share / 20.0 * (law.failure_opening - law.elastic_opening);
    const Real unloading = laws::unloading_stiffness(law, peak);
    for (int i = -20; i < 20; ++i) {
      const Real opening = (i + 0.5) / 20 * peak;
      const auto energy = [&](Real d) { return laws::tension_energy(d, laws::tension_stress(law, d, unloading)); };
      const Real derived = slope(energy, opening, 1e-3 * peak / 20);
      worst = std::max(worst, std::abs(derived - laws::tension_stress(law, opening, unloading)) / law.strength);
    }
  }
  return worst;
}

/// On the softening branch: what is stored and what fracture took, together.
Real softening_error(const laws::JointTension& law) {
  Real worst = 0;
  const auto taken = [&](Real d) {
    const Real stress = laws::tension_stress(law, d, laws::unloading_stiffness(law, d));
    return laws::tension_energy(d, stress) + laws::fracture_dissipation(law, d);
  };
  for (int i = 0; i < 100; ++i) {
    const Real opening = law.elastic_opening + (i + 0.5) / 100 * (law.failure_opening - law.elastic_opening);
    worst =
        std::max(worst, std::abs(slope(taken, opening, 1e-3 * law.elastic_opening / 100) - laws::softening_stress(law, opening)) /
                            law.strength);
  }
  return worst;
}

Real contact_error() {
  const laws::SphereContact law{1.5e9, 0, 0, laws::DampingCap::step};
  Real worst = 0;
  for (const Real overlap : {1e-9, 1e-7, 1e-5, 1e-3}) {
    laws::SphereMotion at;
    at.overlap = overlap;
    at.step = 1;
    laws::SphereMemory memory;
    const Real force = laws::sphere_force(law, at, memory).elastic;
    const Real derivative = slope([&](Real d) { return laws::sphere_energy(law, d); }, overlap, 1e-3 * overlap);
    worst = std::max(worst, std::abs(derivative - force) / force);
  }
  return worst;
}

/// All twelve freedoms of two blocks that are displaced and turned, relative to the largest.
Real joint_error() {
  test::BondedPair pair;
  pair.place(2e-6, 3e-6, -4e-6);
  auto& bodies = pair.bodies();
  bodies.motion[0].position += Vector3(1e-6, -2e-6, 1e-6);
  bodies.motion[0].rotation = state::turn(Vector3(1e-5, 2e-5, 2e-5), 1) * bodies.motion[0].rotation;
  bodies.motion[1].rotation = state::turn(Vector3(-3e-5, 2e-5, 1e-5), 1) * bodies.motion[1].rotation;
  const auto forces = pair.forces();
  Real worst = 0, largest = 0;
  for (const Index body : {0, 1})
    for (int freedom = 0; freedom < 6; ++freedom) {
      const Real force = test::component(forces[static_cast<std::size_t>(body)], freedom);
      const Real derived = test::energy_slope(pair.probe(), bodies, body, freedom, freedom < 3 ? 1e-8 : 1e-7);
      worst = std::max(worst, std::abs(derived - force));
      largest = std::max(largest, std::abs(force));
    }
  return worst / largest;
}

}  // namespace

int main() {
  const auto concrete = laws::JointTension::make(450e9, 6.66e6, 99.67);
  validation::print_row("tension", tension_error(concrete));
  validation::print_row("softening", softening_error(concrete));
  validation::print_row("contact", contact_error());
  validation::print_row("joint", joint_error());
}
