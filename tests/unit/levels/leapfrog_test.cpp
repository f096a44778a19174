/// With one level the engine is the leapfrog step and nothing else, to the last bit.

#include <gtest/gtest.h>

#include <numeric>

#include "sazare/core/lanes.hpp"
#include "sazare/levels/motion/step.hpp"
#include "sazare/levels/terms/gravity.hpp"
#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

constexpr Real h = 0.01;
constexpr int steps = 200;

StepRules one_level() {
  StepRules rules;
  rules.base_step = h;
  rules.stability = false;
  return rules;
}

/// Force of a spring with a dashpot on its second body, and where it begins.
template <int D>
struct Pull {
  Vector<D> force, point;
};

template <int D>
Pull<D> pull(const terms::Spring<D>& spring, const state::Motion<D>& first, const state::Motion<D>& second) {
  Pull<D> at;
  const Vector<D> first_arm = first.rotation * spring.first_arm, second_arm = second.rotation * spring.second_arm;
  at.point = first.position + first_arm;
  const Vector<D> apart = second.position + second_arm - first.position - first_arm;
  const Real length = apart.norm();
  const Vector<D> direction = apart / length;
  Vector<D> opening = -first.velocity_at(first_arm);
  opening += second.velocity_at(second_arm);
  const Vector<D> dashpot = (-spring.damping * opening.dot(direction)) * direction;
  at.force = (-spring.stiffness * (length - spring.length)) * direction + dashpot;
  return at;
}

template <int D>
test::Network<D> damped_ladder() {
  auto network = test::ladder<D>();
  for (auto& spring : network.springs) spring.damping = 0.1;
  return network;
}

/// Force of each spring at the last step, by hand; empty before the first one.
template <int D>
using Forces = std::vector<terms::PairForce<D>>;

/// sum + factor part, each number rounded once where the processor can, as gathers do.
template <class Vector, class Part>
void add_product_to(Vector& sum, Real factor, const Part& part) {
  for (int i = 0; i < sum.size(); ++i) sum[i] = add_product(factor, part[i], sum[i]);
}

/// What all springs give to all bodies, with moments about the pole: to their second bodies, in the order of the springs, then to
/// their first ones.
template <int D>
std::vector<state::Impulse<D>> impulses(const test::Network<D>& network, Real acting, Forces<D>& last) {
  const auto& motion = network.bodies.motion;
  std::vector<state::Impulse<D>> sums(motion.size());
  const auto add = [acting](state::Impulse<D>& sum, Real sign, const terms::PairForce<D>& force,
                            const terms::PairForce<D>& before) {
    add_product_to(sum.linear, sign * acting, force.linear);
    add_product_to(sum.angular, sign * acting, force.moment);
    add_product_to(sum.linear_lead, sign * (h / 4), before.linear);  // the mean of both forces is predicted for h / 2
    add_product_to(sum.angular_lead, sign * (h / 4), before.moment);
    add_product_to(sum.linear_lead, sign * (h / 2 - h / 4), force.linear);
    add_product_to(sum.angular_lead, sign * (h / 2 - h / 4), force.moment);
  };
  const bool begins = last.empty();
  last.resize(network.springs.size());
  Forces<D> now(last.size());
  for (std::size_t i = 0; i < network.springs.size(); ++i) {
    const auto& spring = network.springs[i];
    const auto second = static_cast<std::size_t>(spring.second);
    const Pull<D> at = pull(spring, motion[static_cast<std::size_t>(spring.first)], motion[second]);
    now[i] = {at.force, moment(at.point, at.force)};
    last[i] = (begins ? now[i] : last[i]).template as<float>().template as<Real>();
    add(sums[second], 1, now[i], last[i]);
  }
  for (std::size_t i = 0; i < network.springs.size(); ++i)
    add(sums[static_cast<std::size_t>(network.springs[i].first)], -1, now[i], last[i]);
  last = std::move(now);
  return sums;
}

template <int D>
void expect_same_bits(const Simulation<D>& simulation, const test::Network<D>& by_hand) {
  for (std::size_t body = 0; body < by_hand.bodies.motion.size(); ++body) {
    const auto &ours = simulation.bodies().motion[body], &hand = by_hand.bodies.motion[body];
    EXPECT_EQ(ours.position, hand.position);
    EXPECT_EQ(ours.velocity, hand.velocity);
    EXPECT_EQ(ours.angular_momentum, hand.angular_momentum);
    EXPECT_EQ(ours.rotation, hand.rotation);
    EXPECT_EQ(ours.spin, hand.spin);
  }
}

/// Every number that a two-dimensional body has, by hand.
void step_by_hand(test::Network<2>& network, Real acting, Forces<2>& last) {
  const auto sum = impulses(network, acting, last);
  for (std::size_t body = 0; body < sum.size(); ++body) {
    auto& motion = network.bodies.motion[body];
    auto& inertia = network.bodies.inertia[body];
    const Real inverse_mass = 1 / inertia.mass;
    const state::Impulse<2> given = sum[body].about(motion.position);
    for (int i = 0; i < 2; ++i) {
      motion.velocity[i] = motion.velocity[i] + inverse_mass * sum[body].linear[i];
      motion.predicted_velocity[i] = motion.velocity[i] + inverse_mass * sum[body].linear_lead[i];
      motion.position[i] = motion.position[i] + h * motion.velocity[i];
    }
    motion.angular_momentum[0] = motion.angular_momentum[0] + given.angular[0];
    motion.spin[0] = inertia.inverse_moments[0] * motion.angular_momentum[0];
    motion.predicted_spin[0] = inertia.inverse_moments[0] * (motion.angular_momentum[0] + given.angular_lead[0]);
    inertia.angle = inertia.angle + motion.spin[0] * h;
    const Real c = std::cos(inertia.angle), s = std::sin(inertia.angle);
    motion.rotation << c, -s, s, c;
  }
}

TEST(leapfrog, one_level_in_the_plane_is_the_step_by_hand_bit_for_bit) {
  auto by_hand = damped_ladder<2>();
  auto simulation = by_hand.simulation(one_level());
  simulation.start();
  Forces<2> last;
  step_by_hand(by_hand, h / 2, last);
  for (int step = 1; step < steps; ++step) {
    simulation.advance();
    step_by_hand(by_hand, h, last);
  }
  expect_same_bits(simulation, by_hand);
  const auto start = damped_ladder<2>().bodies.motion[5];  // it did move
  EXPECT_GT((simulation.bodies().motion[5].position - start.position).norm(), 0.1);
}

/// In space, bodies without turning by hand: springs at the centres.
TEST(leapfrog, one_level_in_space_is_the_step_by_hand_bit_for_bit) {
  auto by_hand = damped_ladder<3>();
  for (auto& spring : by_hand.springs) {
    spring.first_arm.setZero();
    spring.second_arm.setZero();
  }
  for (auto& motion : by_hand.bodies.motion) {
    motion.angular_momentum.setZero();
    motion.spin.setZero();
    motion.predicted_spin.setZero();
  }
  auto simulation = by_hand.simulation(one_level());
  simulation.start();
  Forces<3> last;
  for (int step = 0; step < steps; ++step) {
    if (step > 0) simulation.advance();
    const auto sum = impulses(by_hand, step == 0 ? h / 2 : h, last);
    for (std::size_t body = 0; body < sum.size(); ++body) {
      auto& motion = by_hand.bodies.motion[body];
      const Real inverse_mass = 1 / by_hand.bodies.inertia[body].mass;
      for (int i = 0; i < 3; ++i) {
        motion.velocity[i] = motion.velocity[i] + inverse_mass * sum[body].linear[i];
        motion.predicted_velocity[i] = motion.velocity[i] + inverse_mass * sum[body].linear_lead[i];
        motion.position[i] = motion.position[i] + h * motion.velocity[i];
      }
    }
  }
  for (std::size_t body = 0; body < by_hand.bodies.motion.size(); ++body) {
    EXPECT_EQ(simulation.bodies().motion[body].position, by_hand.bodies.motion[body].position);
    EXPECT_EQ(simulation.bodies().motion[body].velocity, by_hand.bodies.motion[body].velocity);
  }
}

/// With turning, all bodies by the step of motion: slots, clocks and levels add nothing of their own.
TEST(leapfrog, one_level_in_space_is_the_step_of_all_bodies_bit_for_bit) {
  auto by_hand = damped_ladder<3>();
  auto simulation = by_hand.simulation(one_level());
  std::vector<Index> all(by_hand.bodies.motion.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<state::MeanMotion<3>> mean(all.size());
  std::vector<std::size_t> none;
  Forces<3> last;
  simulation.start();
  for (int step = 0; step < steps; ++step) {
    if (step > 0) simulation.advance();
    const auto sum = impulses(by_hand, step == 0 ? h / 2 : h, last);
    motion::Stride stride;
    stride.now = step;
    stride.due = step + 1;
    stride.seconds = h;
    motion::step(by_hand.bodies, all, sum, std::vector<motion::Stride>(all.size(), stride), mean, none);
  }
  EXPECT_TRUE(none.empty());
  expect_same_bits(simulation, by_hand);
}

TEST(leapfrog, levels_that_all_are_the_same_deep_one_give_the_bits_of_that_step) {
  // Uniform levels over a base step eight times as long: the finest body asks for level 3 or so, all follow.
  auto network = damped_ladder<3>();
  StepRules coarse;
  coarse.base_step = 8 * h;
  coarse.uniform = true;
  coarse.stability_fraction = 0.25;
  auto levelled = network.simulation(coarse);
  levelled.start();
  const int level = levelled.levels().finest();
  ASSERT_GT(level, 0);
  StepRules fine = one_level();
  fine.base_step = coarse.base_step / (1 << level);
  auto plain = network.simulation(fine);
  plain.start();
  test::run(levelled, 20);
  test::run(plain, 20 << level);
  for (std::size_t body = 0; body < network.bodies.motion.size(); ++body) {
    EXPECT_EQ(levelled.bodies().motion[body].position, plain.bodies().motion[body].position);
    EXPECT_EQ(levelled.bodies().motion[body].angular_momentum, plain.bodies().motion[body].angular_momentum);
  }
}

TEST(leapfrog, a_snapshot_stands_at_the_time_and_not_half_a_step_ahead) {
  // Free fall from rest: after n steps z = -g t^2 / 2 exactly (constant force), v = -g t.
  state::Bodies<3> bodies;
  state::add_body(bodies, 2.0, Vector3(0, 0, 0), Vector3(1, 1, 1), Quaternion::Identity(), 0.5);
  TermList<3> terms;
  terms.push_back(std::make_unique<terms::Gravity<3>>(Vector3(0, 0, -10), bodies));
  Simulation<3> simulation(bodies, std::move(terms), one_level());
  simulation.start();
  test::run(simulation, 100);
  const auto at = simulation.snapshot();
  EXPECT_DOUBLE_EQ(simulation.now().seconds(), 1.0);
  EXPECT_NEAR(at.velocity[0].z(), -10, 1e-13);
  EXPECT_NEAR(at.pose[0].position.z(), -5, 1e-13);
}

}  // namespace
}  // namespace sazare::levels
