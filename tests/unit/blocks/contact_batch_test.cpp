/// The forces of many pairs at a time, against the law for one sphere at a time.

#include "sazare/methods/blocks/contact_batch.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace sazare::methods::blocks {
namespace {

constexpr Index pair_count = 13;  // a full row of lanes, and some that are not
constexpr Real pressed = 2e-5;    // [m]
const laws::SphereContact rough{1.5e9, 3.08e6, 0.58, laws::DampingCap::step};
const geometry::Tetrahedron corners{Vector3(0.1, 0.1, 0.1), {-0.1, 0.1, -0.1}, {0.1, -0.1, -0.1}, {-0.1, -0.1, 0.1}};

/// Pairs of blocks, the first spheres of each pressed into one another, the others as it comes.
struct Rubble {
  state::Bodies<3> bodies;
  ContactSurface surface{2 * pair_count, 5, 1e-3};
  std::deque<std::vector<SpherePair>> spheres;  ///< by pair

  Rubble() {
    for (Index pair = 0; pair < pair_count; ++pair) add_pair(pair);
  }

  Real any(Real most) { return most * std::uniform_real_distribution<Real>(-1, 1)(random); }
  Vector3 any_vector(Real most) { return {any(most), any(most), any(most)}; }

  void add_block(const Vector3& centre) {
    const Quaternion turned(1, any(1), any(1), any(1));
    const Index body = state::add_body(bodies, 2 + any(1), centre, {0.02, 0.03, 0.04}, turned.normalized(), 0.1);
    bodies.motion.back().predicted_velocity = any_vector(0.05);
    bodies.motion.back().predicted_spin = any_vector(0.5);
    surface.open({body, 3}, corners, {Vector3::Zero(), Matrix3::Identity()});
  }

  void add_pair(Index pair) {
    add_block(any_vector(1));
    add_block(Vector3::Zero());
    std::vector<Index> first, second;
    surface.visit_spheres(2 * pair, [&](Index sphere) { first.push_back(sphere); });
    surface.visit_spheres(2 * pair + 1, [&](Index sphere) { second.push_back(sphere); });
    const auto &a = surface.sphere(first[0]), &b = surface.sphere(second[0]);
    const auto& place = bodies.motion[bodies.motion.size() - 2];
    auto& other = bodies.motion.back();
    other.position = place.position + place.rotation * a.centre - other.rotation * b.centre +
                     (a.radius + b.radius - pressed) * any_vector(1).normalized();
    auto& near = spheres.emplace_back();
    for (std::size_t i = 0; i <= static_cast<std::size_t>(pair) % 4; ++i)
      near.push_back({first[i], second[i], 1e-6, 0, {any(100), any_vector(100)}});
  }

  ContactBody body(Index number) const {
    return {bodies.motion[static_cast<std::size_t>(number)], bodies.inertia[static_cast<std::size_t>(number)]};
  }

  std::mt19937 random{7};
};

const Vector3 pole(0.3, -0.2, 0.1);

Due due_of(Index pair) { return {pair, 1e-7 * (1 + pair % 3), 0.7e-7}; }

void add(ContactBatch& batch, Rubble& rubble, Index pair) {
  batch.begin_pair(due_of(pair), rubble.body(2 * pair), rubble.body(2 * pair + 1));
  for (SpherePair& spheres : rubble.spheres[static_cast<std::size_t>(pair)]) batch.add(spheres);
}

/// Force of a pair by the law for single numbers, sphere by sphere.
ContactForce one_by_one(Rubble& rubble, Index pair) {
  const ContactBody first = rubble.body(2 * pair), second = rubble.body(2 * pair + 1);
  std::vector<std::pair<SphereTouch, SpherePair*>> touching;
  for (SpherePair& spheres : rubble.spheres[static_cast<std::size_t>(pair)]) {
    const auto at =
        touch(rubble.surface.placed(spheres.first, first.pose()), rubble.surface.placed(spheres.second, second.pose()));
    if (at.overlap > spheres.initial_overlap) touching.emplace_back(at, &spheres);
  }
  laws::SphereMotion shared;
  shared.contacts = static_cast<Real>(touching.size());
  shared.elapsed = due_of(pair).acting;
  shared.step = std::max(shared.elapsed, 2 * due_of(pair).ahead);
  ContactForce sum;
  for (const auto& [at, spheres] : touching) {
    const Vector3 arm = at.point - first.motion.position, other_arm = at.point - second.motion.position;
    shared.overlap = at.overlap - spheres->initial_overlap;
    const Vector3 opening = second.motion.velocity_at(other_arm) - first.motion.velocity_at(arm);
    turn_with_spheres(spheres->memory, at.normal, opening, at.arm, at.other_arm, first.motion.predicted_spin,
                      second.motion.predicted_spin, shared.elapsed);
    const auto force = force_at(
        rough, at.normal, opening,
        [&](const Vector3& along) { return first.softness(arm, along) + second.softness(other_arm, along); }, shared,
        spheres->memory);
    sum.dashpot.add_at(at.point - pole, force.dashpot * at.normal);
    sum.friction.add_at(at.point - pole, force.friction);
    sum.total.add_at(at.point - pole, (force.elastic + force.dashpot) * at.normal + force.friction);
  }
  return sum;
}

/// Share of what a spring as far pressed gives.
Real difference(const terms::PairForce<3>& a, const terms::PairForce<3>& b) {
  return ((a.linear - b.linear).norm() + (a.moment - b.moment).norm() / 0.1) / (rough.stiffness * pressed);
}

TEST(contact_batch, pushes_as_the_law_for_single_spheres_does) {
  Rubble rubble, expected;
  ContactBatch batch;
  for (Index pair = 0; pair < pair_count; ++pair) add(batch, rubble, pair);
  batch.evaluate(rough, rubble.surface, pole);
  ASSERT_EQ(batch.pairs().size(), static_cast<std::size_t>(pair_count));
  int pushing = 0;
  for (const auto& pair : batch.pairs()) {
    ASSERT_GT(pair.touching, 0U);
    const ContactForce force = batch.force(pair), single = one_by_one(expected, pair.due.link);
    pushing += static_cast<int>(single.total.linear.norm() > 0 && single.friction.linear.norm() > 0);
    EXPECT_LT(difference(force.total, single.total), 1e-9);  // places are known to 1e-16 m
    EXPECT_LT(difference(force.dashpot, single.dashpot), 1e-9);
    EXPECT_LT(difference(force.friction, single.friction), 1e-9);
    const auto& memory = rubble.spheres[static_cast<std::size_t>(pair.due.link)][0].memory;
    const auto& known = expected.spheres[static_cast<std::size_t>(pair.due.link)][0].memory;
    EXPECT_NEAR(memory.dashpot, known.dashpot, 1e-9 * rough.stiffness * pressed);
    EXPECT_LT((memory.friction - known.friction).norm(), 1e-9 * rough.stiffness * pressed);
  }
  EXPECT_GT(pushing, pair_count / 2);
}

TEST(contact_batch, a_pair_has_the_same_bits_alone_and_among_others) {
  Rubble together, apart;
  ContactBatch all, one;
  for (Index pair = 0; pair < pair_count; ++pair) add(all, together, pair);
  all.evaluate(rough, together.surface, pole);
  for (const auto& pair : all.pairs()) {
    one.clear();
    add(one, apart, pair.due.link);
    one.evaluate(rough, apart.surface, pole);
    const ContactForce among = all.force(pair), alone = one.force(one.pairs()[0]);
    EXPECT_EQ(among.total.linear, alone.total.linear);
    EXPECT_EQ(among.total.moment, alone.total.moment);
    EXPECT_EQ(among.dashpot.linear, alone.dashpot.linear);
    EXPECT_EQ(among.friction.moment, alone.friction.moment);
  }
}

TEST(contact_batch, spheres_that_have_parted_forget_and_need_not_overlap_as_at_rest_any_more) {
  Rubble rubble;
  auto& near = rubble.spheres[0];
  rubble.bodies.motion[1].position += Vector3(1, 0, 0);
  ContactBatch batch;
  add(batch, rubble, 0);
  batch.evaluate(rough, rubble.surface, pole);
  EXPECT_EQ(batch.pairs()[0].touching, 0U);
  EXPECT_FALSE(batch.pairs()[0].overlap);
  EXPECT_EQ(near[0].initial_overlap, 0);
  EXPECT_EQ(near[0].memory.dashpot, 0);
  EXPECT_EQ(near[0].memory.friction, Vector3::Zero());
}

}  // namespace
}  // namespace sazare::methods::blocks
