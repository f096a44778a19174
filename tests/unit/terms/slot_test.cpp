#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/levels/terms/slot_table.hpp"

namespace sazare::terms {
namespace {

PairForce<3> push(Real force) { return {Vector3(force, 2 * force, 3 * force), Vector3(force, 0, -force)}; }

/// One link between two bodies, evaluated at the ticks given.
struct OneLink {
  SlotTable<3, 1, FixedIncidence> table;
  Instant now{0, 0.1};

  OneLink() {
    const std::vector<Link> links = {{0, 1}};
    table.slots.resize(1);
    table.incidence = FixedIncidence(2, links);
  }
  void evaluate(Tick tick, Real force, Real acting, Real ahead) {
    now.tick = tick;
    write<3, 1>(table[0], now, Due{0, acting, ahead}, push(force), {});
  }
  Impulse<3> gathered(Index body, Real until_next) const {
    Impulse<3> sum;
    sum.until_next = until_next;
    CauseImpulses<3> parts;
    parts.clear();
    table.gather_one(now, body, 0, sum, parts);
    return sum;
  }
};

TEST(slot, power_is_that_of_the_force_at_its_point) {
  const Vector3 point(0.3, -0.2, 0.5), force(1, 2, -3);
  PairForce<3> pair;
  pair.add_at(point, force);
  const MeanMotion<3> motion{{0.1, 0.2, 0.3}, {-1, 0.5, 2}};
  EXPECT_NEAR(pair.power(motion), force.dot(motion.velocity + turned(motion.spin, point)), 1e-15);
}

TEST(slot, impulse_and_motion_at_another_point_do_the_same_work) {
  Impulse<3> given;
  given.linear = Vector3(1, -2, 0.5);
  given.angular = Vector3(0.2, 0.1, -0.3);
  const MeanMotion<3> motion{{0.1, 0.2, 0.3}, {-1, 0.5, 2}};
  const Vector3 away(0.4, -0.7, 0.2);
  const Impulse<3> moved = given.about(away);
  const MeanMotion<3> there = motion.at(away);
  EXPECT_GT((moved.angular - given.angular).norm(), 0.1);
  EXPECT_NEAR(moved.linear.dot(there.velocity) + moved.angular.dot(there.spin),
              given.linear.dot(motion.velocity) + given.angular.dot(motion.spin), 1e-15);
}

TEST(slot, keeps_the_force_before_from_the_first_one_on) {
  OneLink link;
  link.evaluate(0, 8, 0.1, 0.1);
  EXPECT_EQ(link.table[0].previous.as<Real>().linear, push(8).linear);
  link.evaluate(2, 4, 0.2, 0.1);
  EXPECT_EQ(link.table[0].previous.as<Real>().linear, push(8).linear);
  EXPECT_EQ(link.table[0].previous.as<Real>().moment, push(8).moment);
  link.evaluate(4, 6, 0.2, 0.1);
  EXPECT_EQ(link.table[0].previous.as<Real>().moment, push(4).moment);
}

/// In every lane, the force that `push` returns for the number `force[lane]`.
LanePairForce push(const Lanes& force) { return {{{force, 2 * force, 3 * force}}, {{force, Lanes{}, -force}}}; }

bool are_same(const Slot<3, 1>& a, const Slot<3, 1>& b) {
  const auto same = [](const auto& one, const auto& other) { return one.linear == other.linear && one.moment == other.moment; };
  return same(a.total, b.total) && same(a.part[0], b.part[0]) && same(a.previous, b.previous) && a.acting == b.acting &&
         a.ahead == b.ahead && a.evaluated == b.evaluated;
}

TEST(slot, lanes_write_what_is_written_for_one) {
  std::vector<Slot<3, 1>> in_lanes(lane_count), one_by_one(lane_count);
  LanePointers<Slot<3, 1>> slots;
  LaneDue due;
  Lanes force;
  for (Index lane = 0; lane < lane_count; ++lane) {
    const Index n = lane < 3 ? lane : 0;  // idle lanes repeat the first
    slots[static_cast<std::size_t>(lane)] = &in_lanes[static_cast<std::size_t>(n)];
    due[static_cast<std::size_t>(lane)] = {n, 0.1 * (n + 1), 0.05 * n};
    force[lane] = 1.1 + n;
  }
  for (const Tick tick : {3, 5, 9}) {  // the second slot begins at 5
    for (std::size_t n = 0; n < 3; ++n) {
      if (tick == 5 && n == 1) in_lanes[n] = one_by_one[n] = {};
      const Real one = static_cast<Real>(tick) * force[static_cast<int>(n)];
      write<3, 1>(one_by_one[n], Instant{tick, 0.1}, due[n], push(one), {push(0.5 * one)});
    }
    write(slots, Instant{tick, 0.1}, due, push(static_cast<Real>(tick) * force), push(0.5 * static_cast<Real>(tick) * force));
    for (std::size_t n = 0; n < 3; ++n) EXPECT_TRUE(are_same(in_lanes[n], one_by_one[n])) << tick << ' ' << n;
  }
}

TEST(slot, a_link_that_begins_anew_in_a_lane_has_no_force_before) {
  std::vector<Slot<3, 1>> table(lane_count);
  LanePointers<Slot<3, 1>> slots;
  LaneDue due;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    slots[lane] = &table[lane];
    due[lane] = {static_cast<Index>(lane), 0.1, 0.05};
  }
  LaneMask anew{};
  anew[2] = -1;
  write(slots, Instant{0, 0.1}, due, push(broadcast(8)), push(broadcast(1)));
  write(slots, Instant{2, 0.1}, due, push(broadcast(4)), push(broadcast(1)), anew);
  EXPECT_EQ(table[1].previous.as<Real>().linear, push(8.0).linear);
  EXPECT_EQ(table[2].previous.as<Real>().linear, push(4.0).linear);
  EXPECT_EQ(table[2].previous.as<Real>().moment, push(4.0).moment);
}

TEST(slot, what_was_given_beyond_now_is_taken_back_with_the_force_itself) {
  OneLink link;
  link.evaluate(0, 8, 0.1, 0.1);
  link.evaluate(2, 4, 0.2, 0.1);
  EXPECT_LT((link.gathered(1, 0).linear_lead + 0.1 * push(4).linear).norm(), 1e-15);
  EXPECT_LT(link.gathered(1, 0.1).linear_lead.norm(), 1e-15);  // given until then
}

TEST(slot, what_no_force_was_given_for_is_predicted_with_the_mean) {
  OneLink link;
  link.evaluate(0, 8, 0.1, 0.1);
  link.evaluate(2, 4, 0.2, 0.1);
  const auto second = link.gathered(1, 0.2), first = link.gathered(0, 0.2);
  EXPECT_LT((second.linear_lead - 0.1 * push(6).linear).norm(), 1e-15);
  EXPECT_LT((first.linear_lead + 0.1 * push(6).linear).norm(), 1e-15);
  EXPECT_LT((second.angular_lead - 0.1 * push(6).moment).norm(), 1e-15);
  EXPECT_LT((first.angular_lead + 0.1 * push(6).moment).norm(), 1e-15);
}

TEST(slot, a_constant_force_is_predicted_as_it_is) {
  OneLink link;
  for (const Tick tick : {0, 2, 4}) link.evaluate(tick, 8, 0.2, 0.1);
  const auto sum = link.gathered(1, 0.2);
  EXPECT_LT((sum.linear_lead - 0.1 * push(8).linear).norm(), 1e-15);
}

TEST(slot, lanes_find_the_work_after_now_that_the_table_finds_for_one) {
  SlotTable<3, 1, FixedIncidence> table;
  table.slots.resize(lane_count);
  std::vector<state::MeanMotion<3>> ahead;
  LanePointers<const Slot<3, 1>> slots;
  LanePointers<const state::MeanMotion<3>> firsts, seconds;
  for (Index n = 0; n < lane_count; ++n) {
    const Real x = 0.25 * (n + 1);
    write<3, 1>(table[n], Instant{4, 0.1}, Due{n, 0.2, 0.1 * x}, push(x), {push(3 - x)});
    ahead.push_back({{x, -2 * x, 1}, {0.5, x * x, -x}});
    ahead.push_back({{-x, 1 - x, x}, {x, -0.5, 2.6 * x}});
  }
  for (std::size_t n = 0; n < lane_count; ++n) {
    slots[n] = &table.slots[n];
    firsts[n] = &ahead[2 * n];
    seconds[n] = &ahead[2 * n + 1];
  }
  const Lanes work = work_after(slots, firsts, seconds);
  const std::vector<state::Pose<3>> nowhere;
  for (Index n = 0; n < lane_count; ++n) {
    const Real expected = table.work_after(n, Link{2 * n, 2 * n + 1}, Synchronized<3>{nowhere, ahead, 0})[0];
    EXPECT_NE(expected, 0);
    EXPECT_NEAR(work[n], expected, 1e-14 * std::abs(expected));
  }
}

std::vector<Index> slots_of(const FixedIncidence& incidence, Index body) {
  std::vector<Index> slots;
  for (const SlotSide side : incidence.of(body)) slots.push_back(side.slot);
  return slots;
}

TEST(slot, links_that_have_ended_are_left_out_and_the_others_keep_their_order) {
  const std::vector<Link> links = {{0, 1}, {1, 2}, {1, Link::outside}, {0, 1}, {3, 1}};
  FixedIncidence incidence(4, links);
  const std::vector<Index> all = {0, 3, 4, 1, 2};
  EXPECT_EQ(slots_of(incidence, 1), all);
  incidence.end(3, links[3]);
  incidence.end(2, links[2]);
  EXPECT_EQ(slots_of(incidence, 0), (std::vector<Index>{0}));
  EXPECT_EQ(slots_of(incidence, 1), (std::vector<Index>{0, 4, 1}));
  EXPECT_EQ(slots_of(incidence, 2), (std::vector<Index>{1}));
  for (const Index slot : {0, 1, 4}) incidence.end(slot, links[static_cast<std::size_t>(slot)]);
  for (const Index body : {0, 1, 2, 3}) EXPECT_TRUE(slots_of(incidence, body).empty());
}

}  // namespace
}  // namespace sazare::terms
