#include "sazare/laws/joint_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sazare::laws {
namespace {

// Table 1 of the blasting paper; d_e = 1.48e-5 m, d_u = 2.99e-5 m.
constexpr Real stiffness = 450e9, strength = 6.66e6, fracture_energy = 99.67;
const JointTension concrete = JointTension::make(stiffness, strength, fracture_energy);

/// Central difference. The energies below are quadratic in the opening, so only rounding is left: about
/// 1e-16 x energy / step, some 1e-10 of the stress.
template <class F>
Real slope(F&& energy, Real at, Real step) {
  return (energy(at + step) - energy(at - step)) / (2 * step);
}

constexpr Real rounding = 1e-9;

TEST(joint_tension, stress_is_the_slope_of_the_energy_at_any_memory) {
  const Real first = concrete.elastic_opening, last = concrete.failure_opening;
  for (const Real peak : {first, first + 0.3 * (last - first), first + 0.9 * (last - first)}) {
    const Real unloading = unloading_stiffness(concrete, peak);
    for (const Real opening : {-2 * first, -0.1 * first, 0.2 * first, 0.5 * first, 0.99 * peak}) {
      const auto energy = [&](Real d) { return tension_energy(d, tension_stress(concrete, d, unloading)); };
      const Real stress = tension_stress(concrete, opening, unloading);
      EXPECT_NEAR(slope(energy, opening, 1e-3 * first), stress, rounding * strength) << peak << " " << opening;
    }
  }
}

TEST(joint_tension, on_the_envelope_the_work_is_what_is_stored_and_what_fracture_took) {
  const auto taken = [&](Real d) {
    return tension_energy(d, tension_stress(concrete, d, unloading_stiffness(concrete, d))) + fracture_dissipation(concrete, d);
  };
  for (const Real share : {0.1, 0.5, 0.9}) {
    const Real width = concrete.failure_opening - concrete.elastic_opening;
    const Real opening = concrete.elastic_opening + share * width;
    EXPECT_NEAR(slope(taken, opening, 1e-3 * width), softening_stress(concrete, opening), rounding * strength);
  }
}

TEST(joint_tension, fracture_takes_the_fracture_energy_and_not_more) {
  EXPECT_EQ(fracture_dissipation(concrete, concrete.elastic_opening), 0);
  EXPECT_NEAR(fracture_dissipation(concrete, concrete.failure_opening), fracture_energy, 1e-13 * fracture_energy);
  EXPECT_EQ(fracture_dissipation(concrete, 10 * concrete.failure_opening),
            fracture_dissipation(concrete, concrete.failure_opening));
}

TEST(joint_tension, pulled_apart_the_work_is_the_fracture_energy) {
  // Midpoint rule: exact on straight pieces, so an error of at most one cell at each kink.
  constexpr int cells = 20000;
  const Real width = concrete.failure_opening / cells;
  Real work = 0, peak = concrete.elastic_opening;
  for (int cell = 0; cell < cells; ++cell) {
    const Real opening = (cell + 0.5) * width;
    peak = std::max(peak, opening);
    work += width * tension_stress(concrete, opening, unloading_stiffness(concrete, peak));
  }
  EXPECT_NEAR(work, fracture_energy, 1e-4 * fracture_energy);
}

TEST(joint_tension, stress_has_no_jump_on_the_way_to_failure) {
  EXPECT_NEAR(unloading_stiffness(concrete, concrete.elastic_opening), stiffness, 0);
  EXPECT_NEAR(softening_stress(concrete, concrete.elastic_opening), strength, 1e-15 * strength);
  EXPECT_EQ(softening_stress(concrete, concrete.failure_opening), 0);
  EXPECT_EQ(softening_stress(concrete, 2 * concrete.failure_opening), 0);
  const Real just_after = concrete.elastic_opening * (1 + 1e-12);
  EXPECT_NEAR(tension_stress(concrete, just_after, unloading_stiffness(concrete, just_after)), strength, 1e-10 * strength);
}

TEST(joint_tension, unloading_goes_straight_to_the_origin_and_back_to_where_it_left) {
  const Real peak = 0.5 * (concrete.elastic_opening + concrete.failure_opening);
  const Real unloading = unloading_stiffness(concrete, peak);
  EXPECT_LT(unloading, stiffness);
  for (const Real share : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(tension_stress(concrete, share * peak, unloading), share * softening_stress(concrete, peak), 1e-15 * strength);
}

TEST(joint_tension, the_memory_tells_whether_it_has_softened_and_failed) {
  const Real first = elastic_peak(concrete), last = concrete.failure_opening, between = 0.5 * (first + last);
  EXPECT_EQ(first, concrete.elastic_opening);
  EXPECT_FALSE(is_softened(concrete, first));
  EXPECT_TRUE(is_softened(concrete, between));
  EXPECT_FALSE(has_failed(concrete, between));
  EXPECT_TRUE(has_failed(concrete, last));
  for (const Real peak : {first, between, last})
    for (const Real opening : {-first, 0.5 * first, peak}) {
      const Real stress = softened_stress(concrete, opening, peak);
      EXPECT_EQ(stress, tension_stress(concrete, opening, unloading_stiffness(concrete, peak)));
      EXPECT_EQ(stored_energy(concrete, opening, stress), 0.5 * opening * stress);
    }
}

TEST(joint_tension, compression_forgets_the_damage) {
  const Real unloading = unloading_stiffness(concrete, 0.99 * concrete.failure_opening);
  EXPECT_EQ(tension_stress(concrete, -1e-6, unloading), -1e-6 * stiffness);
}

TEST(joint_tension, the_largest_strength_leaves_no_softening) {
  const Real largest = std::sqrt(2 * fracture_energy * stiffness);
  const auto brittle = JointTension::make(stiffness, largest, fracture_energy);
  EXPECT_NEAR(brittle.elastic_opening, brittle.failure_opening, 1e-15 * brittle.failure_opening);
  const auto impossible = JointTension::make(stiffness, 1.001 * largest, fracture_energy);
  EXPECT_GT(impossible.elastic_opening, impossible.failure_opening);
}

TEST(joint_tension, four_lanes_give_the_bits_of_four_numbers) {
  const Lanes opening = {-1e-6, 1e-5, 2e-5, 4e-5};
  const Lanes peak = maximum(opening, broadcast(concrete.elastic_opening));
  const Lanes unloading = unloading_stiffness(concrete, peak);
  const Lanes stress = tension_stress(concrete, opening, unloading);
  const Lanes energy = tension_energy(opening, stress);
  for (int lane = 0; lane < 4; ++lane) {
    const Real alone = unloading_stiffness(concrete, Real{peak[lane]});
    EXPECT_EQ(unloading[lane], alone);
    EXPECT_EQ(stress[lane], tension_stress(concrete, Real{opening[lane]}, alone));
    EXPECT_EQ(energy[lane], tension_energy(Real{opening[lane]}, tension_stress(concrete, Real{opening[lane]}, alone)));
  }
}

}  // namespace
}  // namespace sazare::laws
