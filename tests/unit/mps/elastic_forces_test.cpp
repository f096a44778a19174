#include "sazare/methods/mps/elastic_forces.hpp"

#include <gtest/gtest.h>

#include "sazare/core/lane_math.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

template <int D>
void turn(state::Particles<D>& particles, std::size_t i, int axis, Real angle) {
  if constexpr (D == 2) {
    particles.angle[i] += angle;
    particles.rotation[0][i] = std::cos(particles.angle[i]);
    particles.rotation[1][i] = std::sin(particles.angle[i]);
  } else {
    Matrix3 matrix;
    for (int n = 0; n < 9; ++n) matrix(n / 3, n % 3) = particles.rotation[static_cast<std::size_t>(n)][i];
    matrix = Eigen::AngleAxis<Real>(angle, Vector3::Unit(axis)).toRotationMatrix() * matrix;
    for (int n = 0; n < 9; ++n) particles.rotation[static_cast<std::size_t>(n)][i] = matrix(n / 3, n % 3);
  }
}

/// Particles displaced and turned at random, by a good part of a spacing and of a radian.
template <int D>
struct Deformed {
  Deformed() {
    Site<D> counts{};
    counts.fill(D == 2 ? 5 : 3);
    const auto sites = box_sites<D>(counts);
    particles = make_particles<D>(sites, 0.8, {});
    links = make_links<D>(sites, 0.8, 1.5);
    Noise noise;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      for (auto& column : particles.displacement) column[i] += 0.15 * noise();
      for (int axis = 0; axis < angular_dimension<D>; ++axis) turn<D>(particles, i, axis, 0.4 * noise());
      particles.shear_modulus[i] *= 1 + 0.5 * noise();
      particles.lame[i] *= 1 + 0.5 * noise();
    }
  }
  state::Particles<D> particles;
  LinkTable<D> links;
};

template <int D>
state::FreedomColumns<D> forces_of(const state::Particles<D>& particles, ElasticForces<D>& elastic) {
  state::FreedomColumns<D> result;
  for (auto& column : result) column.assign(particles.padded(), 0);
  elastic.evaluate(particles, result);
  for (std::size_t freedom = 0; freedom < result.size(); ++freedom)
    for (std::size_t i = 0; i < particles.size(); ++i) result[freedom][i] /= particles.inverse_inertia_of(freedom)[i];
  return result;
}

template <int D>
void expect_derivatives_of_energy(RotationRemoval removal) {
  Deformed<D> deformed;
  ElasticForces<D> elastic(deformed.links, removal);
  const auto forces = forces_of<D>(deformed.particles, elastic);
  const Real energy = elastic.energy(deformed.particles);
  constexpr Real small = 1e-6;
  for (const std::size_t i : {std::size_t{0}, std::size_t{7}, deformed.particles.size() - 1})
    for (std::size_t freedom = 0; freedom < forces.size(); ++freedom) {
      const auto moved = [&](Real by) {
        state::Particles<D> particles = deformed.particles;
        if (freedom < D)
          particles.displacement[freedom][i] += by;
        else
          turn<D>(particles, i, static_cast<int>(freedom) - D, by);
        return elastic.energy(particles);
      };
      const Real slope = (moved(small) - moved(-small)) / (2 * small);
      EXPECT_NEAR(-slope, forces[freedom][i], 1e-7 * energy) << "particle " << i << ", freedom " << freedom;
    }
}

TEST(elastic_forces, are_derivatives_of_their_energy) {
  expect_derivatives_of_energy<2>(RotationRemoval::mean_rotation);
  expect_derivatives_of_energy<2>(RotationRemoval::mean_angle);
  expect_derivatives_of_energy<3>(RotationRemoval::mean_rotation);
}

template <int D>
void expect_balance(RotationRemoval removal) {
  Deformed<D> deformed;
  ElasticForces<D> elastic(deformed.links, removal);
  const auto forces = forces_of<D>(deformed.particles, elastic);
  Vector<D> force = Vector<D>::Zero();
  Angular<D> torque = Angular<D>::Zero();
  Real size = 0;
  for (std::size_t i = 0; i < deformed.particles.size(); ++i) {
    Vector<D> own, place;
    for (int axis = 0; axis < D; ++axis) {
      own[axis] = forces[static_cast<std::size_t>(axis)][i];
      place[axis] = deformed.particles.position(static_cast<std::size_t>(axis), i);
    }
    force += own;
    torque += moment(place, own);
    for (int axis = 0; axis < angular_dimension<D>; ++axis) torque[axis] += forces[static_cast<std::size_t>(D + axis)][i];
    size += own.norm();
  }
  EXPECT_LT(force.norm(), 1e-12 * size);
  EXPECT_LT(torque.norm(), 1e-12 * size);
}

TEST(elastic_forces, change_neither_momentum_nor_angular_momentum) {
  expect_balance<2>(RotationRemoval::mean_rotation);
  expect_balance<2>(RotationRemoval::mean_angle);
  expect_balance<3>(RotationRemoval::mean_rotation);
}

TEST(elastic_forces, of_a_body_turned_as_a_whole_are_nothing) {
  const auto sites = box_sites<2>({6, 9});
  state::Particles<2> particles = make_particles<2>(sites, 1.0, {});
  const Real angle = 1.2, c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Real x = particles.start[0][i], y = particles.start[1][i];
    particles.displacement[0][i] = 3 + c * x - s * y - x;
    particles.displacement[1][i] = -2 + s * x + c * y - y;
    turn<2>(particles, i, 0, angle);
  }
  ElasticForces<2> elastic(make_links<2>(sites, 1.0, 1.5), RotationRemoval::mean_rotation);
  const Real modulus = particles.shear_modulus[0];
  EXPECT_LT(elastic.energy(particles), 1e-24 * modulus);
  for (const auto& column : forces_of<2>(particles, elastic))
    for (const Real value : column) EXPECT_LT(std::abs(value), 1e-12 * modulus);
}

/// Energy per volume of an inner particle under a homogeneous strain, against mu e:e + lambda (tr e)^2/2.
TEST(elastic_forces, have_the_moduli_of_the_continuum) {
  const auto sites = box_sites<2>({3, 3});
  const Soil soil;
  state::Particles<2> particles = make_particles<2>(sites, 1.0, soil);
  const LinkTable<2> links = make_links<2>(sites, 1.0, 1.5);
  const Real xx = 1e-6, yy = -4e-7, xy = 3e-7;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Real x = particles.start[0][i], y = particles.start[1][i];
    particles.displacement[0][i] += xx * x + xy * y;
    particles.displacement[1][i] += xy * x + yy * y;
  }
  // Stretch of the links of the middle particle, by hand.
  Real shear = 0, divergence = 0;
  for (const auto& direction : links.directions) {
    const auto& r0 = direction.law.start;
    const Real ux = xx * r0[0] + xy * r0[1], uy = xy * r0[0] + yy * r0[1], length = std::hypot(r0[0], r0[1]);
    shear += 0.25 * direction.law.spring * particles.shear_modulus[4] * (ux * ux + uy * uy);
    divergence += direction.law.divergence * (ux * r0[0] + uy * r0[1]) / length;
  }
  EXPECT_NEAR(divergence, xx + yy, 1e-18);
  EXPECT_NEAR(shear, particles.shear_modulus[4] * (xx * xx + yy * yy + 2 * xy * xy), 1e-10 * shear);
  EXPECT_NEAR(links.number_density, 4 * 0.5 + 4 * (1.5 / std::sqrt(2.0) - 1), 1e-15);
}

/// A layer without end in simple shear: every particle turns by half the shear and no force is left but at top and bottom.
TEST(elastic_forces, of_a_periodic_layer_in_simple_shear) {
  const auto sites = box_sites<2>({2, 7});
  state::Particles<2> particles = make_particles<2>(sites, 1.0, {});
  constexpr Real shear = 1e-6;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.displacement[0][i] = shear * particles.start[1][i];
    turn<2>(particles, i, 0, -shear / 2);
  }
  ElasticForces<2> elastic(make_links<2>(sites, 1.0, 1.5, {2, 0}), RotationRemoval::mean_rotation);
  const auto forces = forces_of<2>(particles, elastic);
  const Real stress = particles.shear_modulus[0] * shear;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const int row = sites[i][1];
    const Real expected = row == 0 ? stress : row == 6 ? -stress : 0;
    EXPECT_NEAR(forces[0][i], expected, 1e-5 * stress);
    if (row > 0 && row < 6) {
      EXPECT_NEAR(forces[2][i], 0, 1e-5 * stress);
    }
  }
}

TEST(elastic_forces, have_the_same_bits_with_any_number_of_threads) {
  const auto sites = box_sites<2>({60, 40});
  state::Particles<2> particles = make_particles<2>(sites, 1.0, {});
  Noise noise;
  for (std::size_t i = 0; i < particles.size(); ++i) particles.displacement[0][i] += 0.1 * noise();
  ElasticForces<2> elastic(make_links<2>(sites, 1.0, 1.5), RotationRemoval::mean_rotation);
  parallel::set_threads(1);
  const auto one = forces_of<2>(particles, elastic);
  parallel::set_threads(3);
  const auto three = forces_of<2>(particles, elastic);
  parallel::set_threads(0);
  EXPECT_EQ(one, three);
}

TEST(sine_cosine, is_that_of_the_library) {
  for (int i = -4000; i <= 4000; ++i) {
    Lanes angle{};
    for (int lane = 0; lane < lane_count; ++lane) angle[lane] = 0.0137 * i + 1e-3 * lane;
    const SineCosine found = sine_cosine(angle);
    for (int lane = 0; lane < lane_count; ++lane) {
      EXPECT_NEAR(found.sine[lane], std::sin(angle[lane]), 1e-14);
      EXPECT_NEAR(found.cosine[lane], std::cos(angle[lane]), 1e-14);
    }
  }
}

}  // namespace
}  // namespace sazare::methods::mps
