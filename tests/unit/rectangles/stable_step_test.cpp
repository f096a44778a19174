#include "sazare/methods/rectangles/stable_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/blocks_of_squares.hpp"

namespace sazare::methods::rectangles {
namespace {

using test::Scene;
constexpr Real radius = 0.05;

Scene lattice(Real damping_ratio, int count) {
  Scene scene;
  const Real mass = 4 * radius * radius * scene.density;
  scene.kinds = {test::square_faces(radius, 1e8, 4e7, count, laws::FaceFormula::small, damping_ratio, mass)};
  scene.contact = {1e8, 1e8, 0.2, 0.5, 1};
  scene.add_lattice(6, 5, radius, {0, 0}, 0);
  return scene;
}

/// Energy after some thousand steps over that at the beginning, of a small random motion; as soon as it is a million times as
/// large.
Real growth(Scene scene, Real step) {
  scene.make(step);
  std::uint64_t state = 1;
  for (auto& column : scene.particles().velocity)
    for (Real& value : column) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      value = 1e-9 * (static_cast<Real>(state >> 11) / 4503599627370496.0 - 1);
    }
  auto stepper = scene.make(step);
  stepper->start();
  const Real before = stepper->kinetic_energy();
  Real growth = 1;
  for (int i = 0; i < 4000 && growth < 1e6; ++i) {
    stepper->advance();
    if (i % 20 == 0) growth = stepper->kinetic_energy() / before;
  }
  return growth;
}

TEST(stable_step, is_where_motion_begins_to_grow) {
  for (const Real damping_ratio : {0.0, 0.5, 1.0}) {
    Scene scene = lattice(damping_ratio, 4);
    auto stepper = scene.make(1e-6);
    const auto& forces = *scene.forces;
    const StableStep found = stable_step(stepper->particles(), forces.outlines(), forces.links(), scene.contact, false);
    EXPECT_LT(growth(lattice(damping_ratio, 4), 0.98 * found.limit), 20) << damping_ratio;
    EXPECT_GT(growth(lattice(damping_ratio, 4), 1.03 * found.limit), 1e3) << damping_ratio;
  }
}

TEST(stable_step, counts_what_may_touch) {
  Scene scene = lattice(0, 4);
  auto stepper = scene.make(1e-6);
  const auto& forces = *scene.forces;
  EXPECT_LT(stable_step(stepper->particles(), forces.outlines(), forces.links(), scene.contact, true).limit,
            stable_step(stepper->particles(), forces.outlines(), forces.links(), scene.contact, false).limit);
}

TEST(stable_step, knows_the_paper_s_condition) {
  Scene scene = lattice(1, 4);
  auto stepper = scene.make(1e-6);
  const Real mass = 4 * radius * radius * scene.density;
  const StableStep found =
      stable_step(stepper->particles(), scene.forces->outlines(), scene.forces->links(), scene.contact, false);
  EXPECT_NEAR(found.paper, std::sqrt(mass / 1e8), 1e-12);
}

}  // namespace
}  // namespace sazare::methods::rectangles
