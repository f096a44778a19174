#include <gtest/gtest.h>

#include <cmath>

#include "sazare/laws/ground_flow.hpp"
#include "sazare/methods/mps/failing_forces.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

constexpr Real modulus = 1500 * 100 * 100;
constexpr laws::Elasticity elastic{modulus, 2 * modulus};

template <int D>
Site<D> cube(int side) {
  Site<D> counts{};
  counts.fill(side);
  return counts;
}

/// A box of one ground that is strained as a whole, and turned as a whole about the axis across x and y.
template <int D>
struct StrainedBox {
  explicit StrainedBox(const StrengthOfGround& of)
      : particles(make_particles<D>(box_sites<D>(cube<D>(4)), 0.5, {})),
        links(make_links<D>(box_sites<D>(cube<D>(4)), 0.5, 1.5)),
        ground(particles, links, {of}, std::vector<Index>(particles.size(), 0)) {
    for (auto& column : stretch) column.assign(particles.padded(), 0);
  }

  static Rotation<D> turn(Real angle) {
    Rotation<D> rotation = Rotation<D>::Identity();
    rotation(0, 0) = rotation(1, 1) = std::cos(angle);
    rotation(1, 0) = std::sin(angle);
    rotation(0, 1) = -std::sin(angle);
    return rotation;
  }

  void strain(const Rotation<D>& by, Real angle) {
    const Rotation<D> gradient = turn(angle) * (Rotation<D>::Identity() + by) - Rotation<D>::Identity();
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Vector<D> place;
      for (std::size_t axis = 0; axis < D; ++axis) place[static_cast<int>(axis)] = particles.start[axis][i];
      const Vector<D> moved = gradient * place;
      for (std::size_t axis = 0; axis < D; ++axis) particles.displacement[axis][i] = moved[static_cast<int>(axis)];
      if constexpr (D == 2) {
        particles.rotation[0][i] = std::cos(angle);
        particles.rotation[1][i] = std::sin(angle);
      } else {
        const Rotation<D> rotation = turn(angle);
        for (int n = 0; n < 9; ++n) particles.rotation[static_cast<std::size_t>(n)][i] = rotation(n / 3, n % 3);
      }
    }
    measure_stretch(links, particles, stretch);
  }

  state::Particles<D> particles;
  LinkTable<D> links;
  GroundStrength<D> ground;
  Tensors<D> stretch;
};

template <int D>
void expect_the_tensor_of_elasticity(Real angle) {
  StrainedBox<D> box({.law = {}, .elastic = elastic, .density = 1500});
  Rotation<D> strain;
  if constexpr (D == 2)
    strain << 1e-3, 4e-4, 4e-4, -2e-3;
  else
    strain << 1e-3, 4e-4, -3e-4, 4e-4, -2e-3, 7e-4, -3e-4, 7e-4, 5e-4;
  box.strain(strain, angle);
  const Rotation<D> turn = box.turn(angle);
  const Rotation<D> expected = turn * laws::elastic_stress<D>(elastic, strain) * turn.transpose();
  const Rotation<D> strained = turn * strain * turn.transpose();
  for (Index i = 0; i < box.particles.count; ++i) {
    const auto found = box.ground.tensors(box.particles, box.stretch, i);
    EXPECT_LT((found.stress - expected).norm(), 1e-9 * expected.norm()) << "particle " << i;
    EXPECT_LT((found.strain - strained).norm(), 1e-9 * strained.norm()) << "particle " << i;
    if constexpr (D == 2) {
      EXPECT_NEAR(found.across, elastic.lame * strain.trace(), 1e-9 * expected.norm()) << "particle " << i;
    }
  }
}

/// At edges and corners too, where particles have few links.
TEST(particle_tensors, of_a_uniform_strain_are_those_of_elasticity_in_every_particle) {
  for (const Real angle : {0.0, 0.8}) {
    expect_the_tensor_of_elasticity<2>(angle);
    expect_the_tensor_of_elasticity<3>(angle);
  }
}

/// The stress of ground that flows is within its strength, and its strain is all of what it has been strained by.
TEST(particle_tensors, of_ground_that_flows_have_the_stress_at_the_strength_and_the_whole_strain) {
  constexpr Real cohesion = 30e3, sheared = 8e-3;
  StrainedBox<2> box({true, laws::MohrCoulomb::make(cohesion, 0, 0, 1e9), elastic, 1500, 1});
  Rotation<2> strain;
  strain << 0, 0.5 * sheared, 0.5 * sheared, 0;
  box.strain(strain, 0);
  box.ground.flow(box.particles, box.stretch);
  for (Index i = 0; i < box.particles.count; ++i) {
    const auto found = box.ground.tensors(box.particles, box.stretch, i);
    EXPECT_NEAR(found.stress(0, 1), cohesion, 1e-6 * cohesion);
    EXPECT_NEAR(found.strain(0, 1), 0.5 * sheared, 1e-9);
    EXPECT_NEAR(found.across, 0, 1e-6 * cohesion);
  }
}

/// A strain in the plane has the same stress across it in the plane and in space.
TEST(particle_tensors, of_soil_that_degrades_have_the_stress_across_the_plane) {
  const auto parts = laws::OverlayModel<4>(elastic, laws::hyperbolic_curve(modulus, 1e-3, 1e-3 * modulus, 30)).parts();
  const StrengthOfGround soil{.law = {}, .elastic = elastic, .density = 1500, .parts = parts};
  StrainedBox<2> flat(soil);
  StrainedBox<3> solid(soil);
  for (int step = 1; step <= 100; ++step) {
    Rotation<2> in_plane;
    in_plane << 4e-5, 1e-5, 1e-5, -1e-5;
    Rotation<3> in_space = Rotation<3>::Zero();
    in_space.topLeftCorner<2, 2>() = step * in_plane;
    flat.strain(step * in_plane, 0);
    flat.ground.flow(flat.particles, flat.stretch);
    solid.strain(in_space, 0);
    solid.ground.flow(solid.particles, solid.stretch);
  }
  const auto here = flat.ground.tensors(flat.particles, flat.stretch, 5);
  const auto there = solid.ground.tensors(solid.particles, solid.stretch, 21);
  const Real size = there.stress.norm();
  EXPECT_LT((here.stress - there.stress.topLeftCorner<2, 2>()).norm(), 1e-9 * size);
  EXPECT_NEAR(here.across, there.stress(2, 2), 1e-9 * size);
  EXPECT_GT(std::abs(here.across - elastic.lame * here.strain.trace()), 1e-2 * size) << "it has flowed across the plane";
}

}  // namespace
}  // namespace sazare::methods::mps
