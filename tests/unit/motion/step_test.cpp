#include <gtest/gtest.h>

#include <numeric>

#include "sazare/levels/motion/kick.hpp"
#include "sazare/levels/motion/step.hpp"

namespace sazare::motion {
namespace {

/// Bodies at rest, one of which may not turn.
struct Row {
  state::Bodies<3> bodies;
  std::vector<Index> which;
  std::vector<state::Impulse<3>> given;
  std::vector<Stride> strides;
  std::vector<state::MeanMotion<3>> mean;
  std::vector<std::size_t> too_fast;

  explicit Row(std::size_t count) : which(count), given(count), strides(count, {0, 4, 0.5}), mean(count) {
    std::iota(which.begin(), which.end(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      state::add_body(bodies, 2.0, Vector3(i, 0, 0), Vector3(1, 2, 2.5), Quaternion::Identity(), 1.0);
      given[i].linear = Vector3(0, 1.0 + static_cast<Real>(i), 0);
      given[i].angular = Vector3(0.1, 0, 0.2);
    }
    bodies.locks[2].rotation = 0b111;
  }
  void step() { motion::step(bodies, which, given, strides, mean, too_fast); }
};

TEST(step, bodies_that_would_be_too_fast_stay_as_they_are_and_are_named) {
  Row free(13), bound(13);
  free.step();
  EXPECT_TRUE(free.too_fast.empty());
  for (const std::size_t i : {1, 2, 7, 12}) bound.strides[i].fastest_squared = 0.9 * free.bodies.motion[i].velocity.squaredNorm();
  for (const std::size_t i : {0, 5}) bound.strides[i].fastest_squared = 1.1 * free.bodies.motion[i].velocity.squaredNorm();
  bound.step();
  std::ranges::sort(bound.too_fast);
  EXPECT_EQ(bound.too_fast, (std::vector<std::size_t>{1, 2, 7, 12}));
  for (std::size_t i = 0; i < 13; ++i) {
    const bool stayed = std::ranges::find(bound.too_fast, i) != bound.too_fast.end();
    const auto &moved = free.bodies.motion[i], &now = bound.bodies.motion[i];
    EXPECT_EQ(now.velocity, stayed ? Vector3(Vector3::Zero()) : moved.velocity) << i;
    EXPECT_EQ(now.position, stayed ? Vector3(static_cast<Real>(i), 0, 0) : moved.position) << i;
    EXPECT_EQ(now.due, stayed ? 0 : 4) << i;
  }
}

TEST(step, a_body_alone_and_among_others_gets_the_same_bits) {
  Row together(11), alone(11);
  together.step();
  for (std::size_t i = 0; i < 11; ++i)
    step(alone.bodies, std::span(&alone.which[i], 1), std::span(&alone.given[i], 1), std::span(&alone.strides[i], 1),
         std::span(&alone.mean[i], 1), alone.too_fast);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_EQ(alone.bodies.motion[i].position, together.bodies.motion[i].position);
    EXPECT_EQ(alone.bodies.motion[i].rotation, together.bodies.motion[i].rotation);
    EXPECT_EQ(alone.bodies.motion[i].predicted_spin, together.bodies.motion[i].predicted_spin);
    EXPECT_EQ(alone.mean[i].velocity, together.mean[i].velocity);
  }
}

}  // namespace
}  // namespace sazare::motion
