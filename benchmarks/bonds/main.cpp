/// Bond-steps per second of method spheres: a cube of bonded spheres that vibrates, no contacts.
///
///     bonds THREADS ACROSS [breaks]
///
/// prints `bonds,bond_steps_per_second,bond_steps_per_processor_second,bytes_per_bond`: steps 20 to 220. With `breaks` the bonds
/// have a strength that they never reach, and every step looks at it.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>

#include "benchmarks/memory.hpp"
#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace {

using namespace sazare;
using namespace sazare::benchmarks;

constexpr Real radius = 5e-4, spacing = 1e-3, step = 1e-7;
constexpr int warm_up = 20, measured = 200;

methods::spheres::Bond bond(Index first, Index second, int axis) {
  methods::spheres::Bond bond;
  bond.first = first;
  bond.second = second;
  bond.radius = radius;
  bond.stiffness = laws::beam_stiffness(spacing, radius, 1e9, 0.25);
  bond.direction = Vector3(Vector3::Unit(axis));
  return bond;
}

}  // namespace

int main(int count, char** arguments) {
  const int threads = count > 1 ? std::atoi(arguments[1]) : 0, across = count > 2 ? std::atoi(arguments[2]) : 0;
  if (threads < 1 || across < 2) {
    std::fprintf(stderr, "usage: bonds THREADS ACROSS [breaks]\n");
    return 2;
  }
  parallel::set_threads(threads);
  const Real before = largest_resident_bytes();
  state::Spheres spheres;
  std::vector<methods::spheres::Bond> bonds;
  std::uint64_t seed = 42;
  const auto random = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return 0.01 * (static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1);
  };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k) {
        const auto number = static_cast<Index>(spheres.size());
        spheres.add(spacing * Vector3(i, j, k), radius, 2500, 0);
        const Real vx = random(), vy = random(), vz = random();
        spheres.set_motion(spheres.size() - 1, {vx, vy, vz}, Vector3::Zero());
        if (i > 0) bonds.push_back(bond(number - across * across, number, 0));
        if (j > 0) bonds.push_back(bond(number - across, number, 1));
        if (k > 0) bonds.push_back(bond(number - 1, number, 2));
      }
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  const Real strength = count > 3 && std::string(arguments[3]) == "breaks" ? 1e20 : infinite;
  const auto bond_count = static_cast<Real>(bonds.size());
  methods::spheres::ContactTable table(laws::ContactModel::hertz, 1);
  const laws::GrainElasticity grain{1e8, 0.3};
  table.set(0, 0, laws::hertz_constants(grain, grain, 0.7, {0.5}));
  methods::spheres::SphereStepper stepper(std::move(spheres), table, {}, {step, Vector3::Zero(), 0.1 * spacing, radius},
                                methods::spheres::Bonds(std::move(bonds), {{strength, strength, 0, 1}}));
  stepper.start();
  for (int k = 0; k < warm_up; ++k) stepper.advance();
  const std::clock_t worked = std::clock();
  const auto began = std::chrono::steady_clock::now();
  for (int k = 0; k < measured; ++k) stepper.advance();
  const Real seconds = std::chrono::duration<Real>(std::chrono::steady_clock::now() - began).count();
  const Real processor = static_cast<Real>(std::clock() - worked) / CLOCKS_PER_SEC;
  std::printf("%.0f,%.4g,%.4g,%.4g\n", bond_count, measured * bond_count / seconds, measured * bond_count / processor,
              (largest_resident_bytes() - before) / bond_count);
}
