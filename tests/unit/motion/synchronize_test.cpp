#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "sazare/levels/motion/kick.hpp"
#include "sazare/levels/motion/synchronize.hpp"

namespace sazare::motion {
namespace {

constexpr Real round_off = 1e-14;

/// Bodies with motions and masses of their own, some of them locked, and what their links give them until now.
struct Scene {
  state::Bodies<3> bodies;
  std::vector<state::Impulse<3>> given;
  std::vector<state::Pose<3>> pose;

  explicit Scene(int count) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<Real> number(-1, 1);
    const auto vector = [&] { return Vector3(number(random), number(random), number(random)); };
    for (int n = 0; n < count; ++n) {
      const Quaternion turned(Eigen::AngleAxis<Real>(number(random), vector().normalized()));
      state::add_body(bodies, 2 + number(random), vector(), Vector3(2, 3, 4) + vector(), turned, 1);
      bodies.motion.back().velocity = vector();
      bodies.motion.back().angular_momentum = vector();
      if (n % 3 == 1) bodies.locks.back().translation = 0b100;
      if (n % 5 == 2) bodies.locks.back().rotation = 0b011;
      state::Impulse<3> impulse;
      impulse.linear_lead = vector();
      impulse.angular_lead = vector();
      given.push_back(impulse);
      pose.push_back({vector(), bodies.motion.back().rotation});
    }
    bodies.pole = Vector3(0.5, -3, 2);
  }
};

struct Found {
  std::vector<Vector3> velocity, angular_momentum;
  std::vector<Real> energy;
  std::vector<state::MeanMotion<3>> ahead;
};

Found find(const Scene& scene, std::size_t first, std::size_t count) {
  Found found{std::vector<Vector3>(count), std::vector<Vector3>(count), std::vector<Real>(count),
              std::vector<state::MeanMotion<3>>(count)};
  const auto pose = std::span(scene.pose).subspan(first, count);
  find_momenta<3>(scene.bodies, first, std::span(scene.given).subspan(first, count),
                  {pose, found.velocity, found.angular_momentum});
  find_energies<3>(scene.bodies, first, {pose, found.velocity, found.angular_momentum}, found.energy, found.ahead);
  return found;
}

TEST(synchronize, momenta_are_those_after_the_kick_and_what_links_have_given_since) {
  const Scene scene(21);
  const Found found = find(scene, 0, 21);
  for (std::size_t n = 0; n < 21; ++n) {
    state::Impulse<3> given = scene.given[n].about(scene.pose[n].position - scene.bodies.pole);
    clear_locked<3>(given, scene.bodies.locks[n]);
    const auto& motion = scene.bodies.motion[n];
    EXPECT_LT((found.velocity[n] - motion.velocity - given.linear_lead / scene.bodies.inertia[n].mass).norm(), round_off) << n;
    EXPECT_LT((found.angular_momentum[n] - motion.angular_momentum - given.angular_lead).norm(), round_off) << n;
  }
}

TEST(synchronize, energies_and_mean_motions_are_those_of_the_momenta) {
  const Scene scene(21);
  const Found found = find(scene, 0, 21);
  for (std::size_t n = 0; n < 21; ++n) {
    const auto& motion = scene.bodies.motion[n];
    const auto& inertia = scene.bodies.inertia[n];
    const state::Locks locks = scene.bodies.locks[n];
    const Rotation<3>& rotation = scene.pose[n].rotation;
    EXPECT_NEAR(found.energy[n], kinetic_energy<3>(rotation, inertia, locks, found.velocity[n], found.angular_momentum[n]),
                round_off)
        << n;
    const Vector3 spin = spin_of(rotation, inertia, locks, 0.5 * (motion.angular_momentum + found.angular_momentum[n]));
    const Vector3 at_pole = 0.5 * (motion.velocity + found.velocity[n]) + spin.cross(scene.bodies.pole - scene.pose[n].position);
    EXPECT_LT((found.ahead[n].spin - spin).norm(), round_off) << n;
    EXPECT_LT((found.ahead[n].velocity - at_pole).norm(), round_off) << n;
  }
}

TEST(synchronize, has_the_same_bits_whatever_stands_beside_a_body) {
  const Scene scene(21);
  const Found all = find(scene, 0, 21);
  for (const std::size_t first : {1, 2, 7, 13})
    for (const std::size_t count : {1, 3, 8}) {
      const Found some = find(scene, first, count);
      for (std::size_t n = 0; n < count; ++n) {
        EXPECT_EQ(some.velocity[n], all.velocity[first + n]);
        EXPECT_EQ(some.angular_momentum[n], all.angular_momentum[first + n]);
        EXPECT_EQ(some.energy[n], all.energy[first + n]);
        EXPECT_EQ(some.ahead[n].velocity, all.ahead[first + n].velocity);
        EXPECT_EQ(some.ahead[n].spin, all.ahead[first + n].spin);
      }
    }
}

}  // namespace
}  // namespace sazare::motion
