#include <gtest/gtest.h>

#include "sazare/levels/terms/springs.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::terms {
namespace {

/// Two tilted bodies, and a third spring to a point of the world.
template <int D>
state::Bodies<D> two_bodies();

template <>
state::Bodies<3> two_bodies<3>() {
  state::Bodies<3> bodies;
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.9, Vector3(1, -2, 0.5).normalized()));
  state::add_body(bodies, 2.0, Vector3(0, 0, 0), Vector3(1, 2, 2.5), tilted, 1.0);
  state::add_body(bodies, 3.0, Vector3(1, 0.5, -0.2), Vector3(1, 1, 1.5), tilted.conjugate(), 1.0);
  return bodies;
}

template <>
state::Bodies<2> two_bodies<2>() {
  state::Bodies<2> bodies;
  state::add_body(bodies, 2.0, Vector<2>(0, 0), 0.5, 1.0);
  state::add_body(bodies, 3.0, Vector<2>(1, 0.5), 0.25, 1.0);
  return bodies;
}

template <int D>
Vector<D> point(std::initializer_list<Real> xyz) {
  Vector<D> made;
  for (int i = 0; i < D; ++i) made[i] = *(xyz.begin() + i);
  return made;
}

template <int D>
std::vector<Spring<D>> both_kinds() {
  return {{0, 1, point<D>({0.1, 0.2, 0.3}), point<D>({-0.2, 0.1, 0.1}), 0.6, 50, 3, 0},
          {1, Link::outside, point<D>({0.3, 0, 0.1}), point<D>({2, 2, 2}), 1.5, 20, 2, 0}};
}

template <class Dimension>
class SpringsIn : public testing::Test {};

template <int D>
struct Dimension {
  static constexpr int value = D;
};
using BothDimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(SpringsIn, BothDimensions);

TYPED_TEST(SpringsIn, force_and_moment_are_the_slope_of_the_energy) {
  constexpr int D = TypeParam::value;
  auto bodies = two_bodies<D>();
  Springs<D> springs(both_kinds<D>(), bodies);
  test::ForceProbe<D> probe(springs, bodies);
  const auto forces = probe.forces();
  for (Index body = 0; body < 2; ++body)
    for (int freedom = 0; freedom < D + angular_dimension<D>; ++freedom)
      // A step of 1e-5 leaves 1e-10 of truncation and 1e-11 of rounding, of forces of some tens of newtons.
      EXPECT_NEAR(test::component(forces[static_cast<std::size_t>(body)], freedom),
                  test::energy_slope(probe, bodies, body, freedom, 1e-5), 1e-7)
          << body << " " << freedom;
}

TYPED_TEST(SpringsIn, action_and_reaction_leave_no_force_and_no_moment) {
  constexpr int D = TypeParam::value;
  auto bodies = two_bodies<D>();
  bodies.motion[0].velocity = point<D>({1, 2, 3});
  bodies.motion[1].spin[0] = 2;
  Springs<D> springs({both_kinds<D>()[0]}, bodies);
  test::ForceProbe<D> probe(springs, bodies);
  const auto forces = probe.forces();
  EXPECT_GT(forces[0].linear.norm(), 1);
  EXPECT_LT((forces[0].linear + forces[1].linear).norm(), 1e-14 * forces[0].linear.norm());
  Angular<D> moments = forces[0].angular + forces[1].angular;
  for (std::size_t body = 0; body < 2; ++body) moments += moment(bodies.motion[body].position, forces[body].linear);
  EXPECT_LT(moments.norm(), 1e-14 * forces[0].linear.norm());
}

TYPED_TEST(SpringsIn, the_dashpot_sees_the_rate_of_the_length) {
  constexpr int D = TypeParam::value;
  auto bodies = two_bodies<D>();
  const auto spring = both_kinds<D>()[0];
  Springs<D> springs({spring}, bodies);
  test::ForceProbe<D> probe(springs, bodies);
  const auto still = probe.forces();
  const auto ends = [&](Real seconds) {  // length after drifting for a time
    std::array<Vector<D>, 2> at;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& motion = bodies.motion[i];
      at[i] = motion.position + seconds * motion.velocity +
              state::turn(motion.spin, seconds) * motion.rotation * (i == 0 ? spring.first_arm : spring.second_arm);
    }
    return (at[1] - at[0]).norm();
  };
  bodies.motion[0].velocity = point<D>({0.4, -0.3, 0.2});
  bodies.motion[1].spin.setConstant(0.7);
  const Real rate = (ends(1e-6) - ends(-1e-6)) / 2e-6;
  const auto moving = probe.forces();
  const Vector<D> along = still[0].linear.normalized();  // elongated: the first body is pulled along the spring
  EXPECT_NEAR((moving[0].linear - still[0].linear).dot(along), spring.damping * rate, 1e-8);
  EXPECT_GT(std::abs(rate), 0.1);
}

TYPED_TEST(SpringsIn, a_spring_that_only_pushes_never_pulls) {
  constexpr int D = TypeParam::value;
  auto bodies = two_bodies<D>();
  auto spring = both_kinds<D>()[0];
  spring.pushes_only = 1;
  bodies.motion[1].velocity = point<D>({5, 5, 5});
  for (const Real length : {0.1, 5.0}) {
    spring.length = length;
    Springs<D> springs({spring}, bodies);
    test::ForceProbe<D> probe(springs, bodies);
    const auto force = probe.forces();
    EXPECT_EQ(force[1].linear.norm() > 0, length > 1);
    EXPECT_EQ(probe.energy_balance()[EnergyKind::elastic] > 0, length > 1);
  }
}

TEST(springs, rates_bound_the_frequencies_of_the_body_they_hold) {
  // One mass between two springs of the world along x, through its centre: w^2 = (k1 + k2) / m exactly.
  state::Bodies<2> bodies;
  state::add_body(bodies, 2.0, Vector<2>(0, 0), 0.5, 0.0);
  const Vector<2> none = Vector<2>::Zero();
  Springs<2> springs({{0, Link::outside, none, {1, 0}, 1, 30, 4, 0}, {0, Link::outside, none, {-1, 0}, 1, 50, 6, 0}}, bodies);
  EXPECT_DOUBLE_EQ(springs.rates(0).stiffness, 40);
  EXPECT_DOUBLE_EQ(springs.rates(0).damping, 5);
}

TEST(springs, rates_count_the_turning_of_the_body) {
  state::Bodies<2> bodies;
  state::add_body(bodies, 2.0, Vector<2>(0, 0), 0.5, 1.0);
  Springs<2> springs({{0, Link::outside, {0, 1}, {1, 1}, 1, 30, 4, 0}}, bodies);
  EXPECT_DOUBLE_EQ(springs.rates(0).stiffness, 30 * (1 / 2.0 + 1 / 0.5));
}

}  // namespace
}  // namespace sazare::terms
