#include "sazare/laws/granular_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/core/twin_lanes.hpp"

namespace sazare::laws {
namespace {

const GrainElasticity glass{70e9, 0.25};

template <class Law>
ContactConstants<Real> constants(Real restitution = 1, const GrainFriction& friction = {0.5}) {
  if constexpr (std::is_same_v<Law, Linear>)
    return Law::constants({{}, {}, restitution, friction}, {1e6, 8e5});
  else
    return Law::constants({glass, glass, restitution, friction}, {});
}

ContactMotion<Real> touching(Real overlap) {
  ContactMotion<Real> at{};
  at.overlap = overlap;
  at.radius = Reduced<Real>::of(0.007, 0.0175);
  at.mass = Reduced<Real>::alone(0.01);
  at.normal = {0, 0, 1};
  at.step = 1e-7;
  return at;
}

template <class Law>
ContactForce<Real> at_rest(Real overlap, const Vector3& stretch = Vector3::Zero()) {
  ContactMemory<Real> memory{.sliding = stretch};
  return contact_force<Law, false>(constants<Law>(1, {1e9}), touching(overlap), memory);
}

/// What a stretch along the face is remembered as [sqrt(J)].
template <class Law>
Real remembered(const ContactConstants<Real>& constants, Real overlap, Real stretch) {
  return std::sqrt(constants.tangential * Law::width(constants, overlap, touching(overlap).radius)) * stretch;
}

template <class Law>
void expect_derivatives() {
  for (const Real overlap : {1e-7, 1e-6, 1e-5}) {
    const Real small = 1e-4 * overlap;
    const Real normal =
        (at_rest<Law>(overlap + small).elastic_energy - at_rest<Law>(overlap - small).elastic_energy) / (2 * small);
    EXPECT_NEAR(at_rest<Law>(overlap).normal, normal, 1e-7 * normal);
    const auto sheared = [&](Real x) { return at_rest<Law>(overlap, {remembered<Law>(constants<Law>(), overlap, x), 0, 0}); };
    const Real x = 0.3 * overlap;
    const Real across = (sheared(x + small).sliding_energy - sheared(x - small).sliding_energy) / (2 * small);
    EXPECT_NEAR(-sheared(x).friction[0], across, 1e-7 * across);
  }
}

TEST(granular_contact, forces_are_slopes_of_the_energies) {
  expect_derivatives<Hertz>();
  expect_derivatives<Linear>();
}

TEST(granular_contact, hertz_force_is_that_of_the_formula) {
  const Real modulus = 70e9 / (2 * (1 - 0.25 * 0.25));
  EXPECT_NEAR(at_rest<Hertz>(1e-6).normal, 4.0 / 3 * modulus * std::sqrt(0.005) * 1e-9, 1e-9);
}

TEST(granular_contact, linear_shear_and_normal_springs_of_mindlin_have_their_ratio) {
  // k_t/k_n = 2 (1 - nu)/(2 - nu) for two spheres alike: G a over 3/2 K a.
  const auto hertz = constants<Hertz>();
  EXPECT_NEAR(hertz.tangential / (1.5 * hertz.normal), 2 * (1 - 0.25) / (2 - 0.25), 1e-12);
}

TEST(contact_laws, have_words_and_are_found_by_their_models) {
  EXPECT_EQ(model_of<Hertz>, ContactModel::hertz);
  EXPECT_EQ(model_of<Linear>, ContactModel::linear);
  for (std::size_t n = 0; n < contact_law_words.size(); ++n)
    EXPECT_EQ(visit_law(static_cast<ContactModel>(n), []<class Law>(Law) { return Law::word; }), contact_law_words[n]);
}

TEST(contact_laws, tell_their_parameters_once) {
  for (std::size_t n = 0; n < law_parameters.size(); ++n)
    for (std::size_t k = 0; k < n; ++k) EXPECT_NE(law_parameters[n].name, law_parameters[k].name);
  EXPECT_TRUE(takes<Linear>("contact_shear_stiffness"));
  EXPECT_FALSE(takes<Hertz>("contact_shear_stiffness"));
}

TEST(contact_laws, find_the_overlap_that_holds_an_energy) {
  for (const ContactModel model : {ContactModel::hertz, ContactModel::linear}) {
    const auto law = model == ContactModel::hertz ? constants<Hertz>() : constants<Linear>();
    EXPECT_NEAR(overlap_of_energy(model, law, normal_energy(model, law, 1e-6, 0.005), 0.005), 1e-6, 1e-18);
    EXPECT_EQ(normal_energy(model, law, -1e-6, 0.005), 0);
    EXPECT_EQ(overlap_of_energy(model, law, 0, 0.005), 0);
  }
  EXPECT_NEAR(normal_energy(ContactModel::hertz, constants<Hertz>(), 1e-6, 0.005), at_rest<Hertz>(1e-6).elastic_energy, 1e-20);
}

TEST(granular_contact, the_same_from_the_other_side) {
  ContactMemory<Real> memory{.sliding = {1e-8, -2e-8, 0}}, mirrored{.sliding = {-1e-8, 2e-8, 0}};
  auto at = touching(1e-6);
  at.velocity = {0.1, 0.2, -0.3};
  const auto force = contact_force<Hertz, false>(constants<Hertz>(0.5), at, memory);
  at.velocity = {-0.1, -0.2, 0.3};
  at.normal = {0, 0, -1};
  const auto other = contact_force<Hertz, false>(constants<Hertz>(0.5), at, mirrored);
  EXPECT_DOUBLE_EQ(force.normal, other.normal);
  EXPECT_DOUBLE_EQ(force.friction[0], -other.friction[0]);
  EXPECT_DOUBLE_EQ(force.friction[1], -other.friction[1]);
  EXPECT_DOUBLE_EQ(memory.sliding[0], -mirrored.sliding[0]);
}

TEST(granular_contact, friction_stays_on_coulombs_line) {
  ContactMemory<Real> memory{};
  auto at = touching(1e-6);
  at.velocity = {3, 4, 0};
  const auto law = constants<Hertz>(0.8, {0.25});
  ContactForce<Real> force{};
  for (int step = 0; step < 20; ++step) force = contact_force<Hertz, false>(law, at, memory);
  EXPECT_NEAR(std::sqrt(dot(force.friction, force.friction)), 0.25 * force.normal, 1e-12 * force.normal);
  EXPECT_NEAR(force.friction[0] / force.friction[1], 0.75, 1e-12);
  EXPECT_LT(force.friction[0], 0);
}

TEST(granular_contact, without_friction_nothing_pulls_across) {
  ContactMemory<Real> memory{};
  auto at = touching(1e-6);
  at.velocity = {3, 4, 0};
  const auto force = contact_force<Hertz, false>(constants<Hertz>(1, {}), at, memory);
  EXPECT_EQ(dot(force.friction, force.friction), 0);
}

TEST(granular_contact, memory_turns_with_the_contact) {
  ContactMemory<Real> memory{.sliding = {1e-8, 0, 0}};
  auto at = touching(1e-6);
  at.normal = {std::sin(1e-3), 0, std::cos(1e-3)};
  contact_force<Hertz, false>(constants<Hertz>(), at, memory);
  EXPECT_NEAR(dot(memory.sliding, at.normal), 0, 1e-22);
  EXPECT_NEAR(std::sqrt(dot(memory.sliding, memory.sliding)), 1e-8, 1e-14);
}

TEST(granular_contact, rolling_moment_has_its_limit) {
  ContactMemory<Real> memory{};
  auto at = touching(1e-6);
  at.rolling = {1, 0, 0};
  ContactForce<Real> force{};
  const auto law = constants<Hertz>(1, {0.5, 0.1});
  for (int step = 0; step < 20; ++step) force = contact_force<Hertz, true>(law, at, memory);
  EXPECT_NEAR(force.rolling[0], -0.1 * force.normal, 1e-12 * force.normal);
  EXPECT_EQ(force.twisting, 0);
}

/// Below the limit the moment is the derivative of the energy by the twist, above it the limit.
TEST(granular_contact, twisting_moment_is_elastic_up_to_its_limit) {
  const auto law = constants<Hertz>(1, {0.5, 0, 0.1});
  const auto twisted = [&](Real twist) {
    ContactMemory<Real> memory{};
    memory.twisting = remembered<Hertz>(law, 1e-6, twist);
    return contact_force<Hertz, true>(law, touching(1e-6), memory);
  };
  const Real small = 1e-8, apart = 1e-10;
  EXPECT_NEAR(twisted(small).twisting,
              -(twisted(small + apart).sliding_energy - twisted(small - apart).sliding_energy) / (2 * apart),
              1e-6 * std::abs(twisted(small).twisting));
  EXPECT_LT(std::abs(twisted(small).twisting), 0.1 * twisted(small).normal);
  EXPECT_NEAR(twisted(1e-5).twisting, -0.1 * twisted(1e-5).normal, 1e-12 * twisted(1e-5).normal);
  EXPECT_NEAR(twisted(-1e-5).twisting, 0.1 * twisted(1e-5).normal, 1e-12 * twisted(1e-5).normal);
}

/// Speed after a central impact of the reduced mass over that before.
template <class Law>
Real restitution_of(Real restitution, Real speed) {
  const auto law = constants<Law>(restitution);
  const Real mass = 0.01, step = 1e-9;
  Real place = 0, velocity = -speed;
  while (place <= 0) {
    ContactMemory<Real> memory{};
    auto at = touching(-place);
    at.velocity = {0, 0, velocity};
    at.step = step;
    const Real middle = velocity + 0.5 * step / mass * contact_force<Law, false>(law, at, memory).normal;
    at.velocity = {0, 0, middle};
    velocity += step / mass * contact_force<Law, false>(law, at, memory).normal;
    place += step * velocity;
  }
  return velocity / speed;
}

TEST(granular_contact, restitution_is_the_one_asked_for_at_any_speed) {
  for (const Real restitution : {0.2, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(restitution_of<Hertz>(restitution, 0.1), restitution, 2e-3);
    EXPECT_NEAR(restitution_of<Hertz>(restitution, 5), restitution, 2e-3);
    EXPECT_NEAR(restitution_of<Linear>(restitution, 1), restitution, 2e-3);
  }
}

void set_lane(ContactMotion<TwinLanes>& lanes, int lane, const ContactMotion<Real>& at) {
  lanes.overlap.set(lane, at.overlap);
  lanes.radius.product.set(lane, at.radius.product);
  lanes.radius.sum.set(lane, at.radius.sum);
  lanes.mass.product.set(lane, at.mass.product);
  lanes.mass.sum.set(lane, at.mass.sum);
  lanes.normal[2].set(lane, at.normal[2]);
  lanes.velocity[0].set(lane, at.velocity[0]);
  lanes.velocity[1].set(lane, at.velocity[1]);
  lanes.velocity[2].set(lane, at.velocity[2]);
  lanes.rolling[0].set(lane, at.rolling[0]);
  lanes.rolling[1].set(lane, at.rolling[1]);
  lanes.twisting.set(lane, at.twisting);
  lanes.step.set(lane, at.step);
}

TEST(granular_contact, lanes_compute_what_one_number_does) {
  ContactMotion<TwinLanes> lanes{};
  ContactMemory<TwinLanes> lane_memory{};
  const auto one_law = constants<Hertz>(0.6, {0.3, 0.1, 0.05});
  const ContactConstants<TwinLanes> law{one_law.normal,   one_law.tangential, one_law.normal_damping, one_law.tangential_damping,
                                        one_law.friction, one_law.rolling,    one_law.twisting};
  const auto scene = [](int lane) {
    auto at = touching(1e-6 * (1 + lane));
    at.velocity = {0.3 * lane, -0.1, 0.05 * lane - 0.1};
    at.rolling = {0.02 * lane, 0.01, 0};
    at.twisting = 0.03 - 0.005 * lane;
    return at;
  };
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    const auto at = scene(lane);
    set_lane(lanes, lane, at);
  }
  const auto together = contact_force<Hertz, true>(law, lanes, lane_memory);
  const auto expect_equal = [](Real alone, Real in_lane) { EXPECT_NEAR(in_lane, alone, 1e-15 * std::abs(alone)); };  // roots
  for (int lane = 0; lane < TwinLanes::count; ++lane) {
    ContactMemory<Real> memory{};
    const auto alone = contact_force<Hertz, true>(one_law, scene(lane), memory);
    expect_equal(alone.normal, together.normal[lane]);
    expect_equal(alone.friction[0], together.friction[0][lane]);
    expect_equal(alone.rolling[1], together.rolling[1][lane]);
    expect_equal(alone.twisting, together.twisting[lane]);
    expect_equal(memory.sliding[1], lane_memory.sliding[1][lane]);
    expect_equal(memory.rolling[0], lane_memory.rolling[0][lane]);
    expect_equal(memory.twisting, lane_memory.twisting[lane]);
  }
}

/// Most dashpots are weaker than what a step bears: where none is stronger nothing is divided, and nobody else may notice.
TEST(granular_contact, a_lane_does_not_hang_on_how_strongly_others_are_damped) {
  const auto one_law = constants<Hertz>(0.6, {0.3});
  const ContactConstants<TwinLanes> law{one_law.normal,   one_law.tangential, one_law.normal_damping, one_law.tangential_damping,
                                        one_law.friction, one_law.rolling,    one_law.twisting};
  const auto force_with_step = [&](Real step_of_first) {
    ContactMotion<TwinLanes> lanes{};
    for (int lane = 0; lane < TwinLanes::count; ++lane) {
      auto at = touching(1e-6 * (1 + lane));
      at.velocity = {0.1 * lane, 0, -0.1};
      at.step = lane == 0 ? step_of_first : 1e-9;
      set_lane(lanes, lane, at);
    }
    ContactMemory<TwinLanes> memory{};
    return contact_force<Hertz, false>(law, lanes, memory);
  };
  const auto calm = force_with_step(1e-9), strong = force_with_step(1);
  EXPECT_LT(strong.normal[0], calm.normal[0]);  // the dashpot of the first is cut
  for (int lane = 1; lane < TwinLanes::count; ++lane) {
    EXPECT_EQ(strong.normal[lane], calm.normal[lane]);
    EXPECT_EQ(strong.friction[0][lane], calm.friction[0][lane]);
  }
}

}  // namespace
}  // namespace sazare::laws
