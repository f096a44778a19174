#include <gtest/gtest.h>

#include <cmath>

#include "sazare/levels/motion/kick.hpp"

namespace sazare::motion {
namespace {

const Vector3 moments(1.0, 2.0, 3.5);

/// An asymmetric top, tilted, near its unstable axis, so that it tumbles.
state::Bodies<3> top() {
  state::Bodies<3> bodies;
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.9, Vector3(1, -2, 0.5).normalized()));
  state::add_body(bodies, 1.0, Vector3::Zero(), moments, tilted, 1.0);
  auto& motion = bodies.motion[0];
  motion.angular_momentum = motion.rotation * moments.cwiseProduct(Vector3(0.2, 1.5, 0.1));
  return bodies;
}

struct Spun {
  Matrix3 rotation;
  Real energy_error = 0;  ///< largest on the way, relative
  Vector3 angular_momentum;
  Real orthonormal_error = 0;
};

Real energy(const state::Bodies<3>& bodies) {
  return kinetic_energy<3>(bodies.motion[0].rotation, bodies.inertia[0], {}, Vector3::Zero(), bodies.motion[0].angular_momentum);
}

/// Spins freely for four seconds, more than one tumble.
Spun spin_freely(int steps) {
  auto bodies = top();
  const Real before = energy(bodies);
  Spun spun;
  for (int step = 0; step < steps; ++step) {
    kick<3>(bodies.motion[0], bodies.inertia[0], {}, {});
    drift<3>(bodies.motion[0], bodies.inertia[0], {}, step + 1, 4.0 / steps);
    spun.energy_error = std::max(spun.energy_error, std::abs(energy(bodies) / before - 1));
  }
  spun.rotation = bodies.motion[0].rotation;
  spun.angular_momentum = bodies.motion[0].angular_momentum;
  spun.orthonormal_error = (spun.rotation * spun.rotation.transpose() - Matrix3::Identity()).norm();
  return spun;
}

TEST(free_rotation, keeps_the_angular_momentum_to_the_bit) {
  EXPECT_EQ(spin_freely(1000).angular_momentum, top().motion[0].angular_momentum);
}

TEST(free_rotation, stays_a_rotation) { EXPECT_LT(spin_freely(10000).orthonormal_error, 1e-14); }

TEST(free_rotation, the_error_of_the_energy_is_of_second_order) {
  const Real coarse = spin_freely(400).energy_error, fine = spin_freely(800).energy_error;
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(free_rotation, the_error_of_the_place_is_of_second_order) {
  const Matrix3 exact = spin_freely(64000).rotation;  // its own error is 1/6400 of the coarsest one
  const Real coarse = (spin_freely(800).rotation - exact).norm(), fine = (spin_freely(1600).rotation - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.05);
}

/// Euler's equations in body axes by the classical Runge-Kutta method, of fourth order: another way to the same motion.
TEST(free_rotation, agrees_with_eulers_equations) {
  constexpr int steps = 20000;
  constexpr Real h = 4.0 / steps;
  Quaternion q = top().inertia[0].orientation;
  Vector3 w(0.2, 1.5, 0.1);
  const auto spin_rate = [](const Vector3& s) -> Vector3 { return moments.cwiseProduct(s).cross(s).cwiseQuotient(moments); };
  const auto turn_rate = [](const Quaternion& p, const Vector3& s) {
    Quaternion r = p * Quaternion(0, s.x(), s.y(), s.z());
    r.coeffs() *= 0.5;
    return r;
  };
  const auto moved = [](const Quaternion& p, const Quaternion& rate, Real time) {
    return Quaternion(Vector<4>(p.coeffs() + time * rate.coeffs()));
  };
  for (int step = 0; step < steps; ++step) {
    const Vector3 w1 = spin_rate(w), w2 = spin_rate(w + h / 2 * w1), w3 = spin_rate(w + h / 2 * w2), w4 = spin_rate(w + h * w3);
    const Quaternion q1 = turn_rate(q, w), q2 = turn_rate(moved(q, q1, h / 2), w + h / 2 * w1),
                     q3 = turn_rate(moved(q, q2, h / 2), w + h / 2 * w2), q4 = turn_rate(moved(q, q3, h), w + h * w3);
    q.coeffs() += h / 6 * (q1.coeffs() + 2 * q2.coeffs() + 2 * q3.coeffs() + q4.coeffs());
    w += h / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
  }
  // Ours at 64000 steps is off by some 1e-7 (second order), the reference by less than 1e-13.
  EXPECT_LT((spin_freely(64000).rotation - q.toRotationMatrix()).norm(), 1e-6);
}

TEST(free_rotation, about_a_principal_axis_it_turns_by_the_angle_of_the_formula) {
  state::Bodies<3> bodies;
  state::add_body(bodies, 1.0, Vector3::Zero(), moments, Quaternion::Identity(), 1.0);
  bodies.motion[0].angular_momentum = {0, 0, 3.5 * 2.0};
  for (int step = 0; step < 100; ++step) drift<3>(bodies.motion[0], bodies.inertia[0], {}, step + 1, 0.01);
  const Real angle = 100 * 2 * std::atan(0.01);
  const Matrix3 expected = Eigen::AngleAxis<Real>(angle, Vector3::UnitZ()).toRotationMatrix();
  EXPECT_LT((bodies.motion[0].rotation - expected).norm(), 1e-13);
}

TEST(free_rotation, in_the_plane_it_is_exact) {
  state::Bodies<2> bodies;
  state::add_body(bodies, 1.0, Vector<2>(0, 0), 4.0, 1.0);
  auto& motion = bodies.motion[0];
  motion.velocity = {0.5, -0.25};
  motion.angular_momentum[0] = 2;
  for (int step = 0; step < 64; ++step) drift<2>(motion, bodies.inertia[0], {}, step + 1, 0.125);
  EXPECT_EQ(motion.position, Vector<2>(4, -2));
  EXPECT_EQ(bodies.inertia[0].angle, 4);
  EXPECT_NEAR(motion.rotation(1, 0), std::sin(4.0), 1e-15);
  EXPECT_EQ(motion.due, 64);
  EXPECT_EQ(motion.last_kick, 63);
}

}  // namespace
}  // namespace sazare::motion
