#include "sazare/methods/spheres/plane_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sazare/methods/spheres/wall_contacts.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

using laws::Hertz, laws::Linear, laws::MindlinDeresiewicz;

constexpr Real step = 2e-6, margin = 2e-3;
constexpr std::size_t count = 3 * lane_count + 3;  // of spheres
constexpr Real round_off = 1e-10;  // of forces of some 10 N: places are known to 1e-17 m, stiffnesses some 1e5 N/m

template <class Law>
ContactTable three_materials(bool rolls) {
  ContactTable table(laws::model_of<Law>, 3);
  for (Index one = 0; one < 3; ++one)
    for (Index other = 0; other <= one; ++other) {
      const Real n = 1 + one + 0.5 * other;
      const laws::MaterialsInContact materials{
          {1e8 * n, 0.3}, soft, 1 - 0.1 * n, {0.2 * n, rolls ? 0.05 * n : 0, rolls ? 0.02 * n : 0}};
      if constexpr (std::is_same_v<Law, Linear>)
        table.set(one, other, Law::constants(materials, {1e5 * n, 8e4 * n}));
      else
        table.set(one, other, Law::constants(materials, {}));
    }
  return table;
}

/// A plane that leans, goes to and fro and turns.
Wall leaning() {
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::sine;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.amplitude = 0.3;
  motion.sine_wave = {2000, 0};
  Wall wall;
  wall.material = 1;
  wall.point = Vector3(0.03, -0.02, 0.05);
  wall.normal = Vector3(0.2, -0.5, 1).normalized();
  wall.motion.histories = {{0, motion}, {2, motion}};
  wall.motion.pivot = Vector3(-0.04, 0.03, 0.02);
  wall.motion.spin = Vector3(3, -2, 5);
  return wall;
}

/// Spheres of three materials, of which some are pressed into a plane by up to 3 % of their radius, some are near it and
/// some are far away.
state::Spheres at(const Wall& wall, const state::PeriodicBox& box = {}) {
  std::uint64_t seed = 7;
  const auto random = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1;
  };
  const auto vector = [&](Real size) {
    const Real x = random(), y = random(), z = random();
    return Vector3(size * x, size * y, size * z);
  };
  state::Spheres spheres;
  spheres.box = box;
  for (std::size_t i = 0; i < count; ++i) {
    const Real radius = 0.01 + 0.002 * random();
    const Vector3 on_plane = wall.normal.cross(vector(0.1));
    const Real height = i % 11 == 10 ? 0.05 : radius * (1 + 0.03 * random());
    const Vector3 image = box.length.cwiseProduct(Vector3(static_cast<Real>(i % 3) - 1, static_cast<Real>(i % 4) - 2, 0));
    spheres.add(wall.point + on_plane + height * wall.normal + image, radius, 2500, static_cast<Index>(i % 3));
    spheres.set_motion(i, vector(1), vector(100));
  }
  return spheres;
}

/// As far as the free flight of a step, so that some part and some meet.
void fly(state::Spheres& spheres, Real seconds) {
  for (auto& place : spheres.place) {
    place.x += seconds * place.vx;
    place.y += seconds * place.vy;
    place.z += seconds * place.vz;
  }
}

/// What one sphere gets, and what the plane gets from it.
struct OneContact {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  WallLoad on_plane;
  ContactSums sums;
};

/// By the law for single numbers.
template <class Law, bool rolls>
OneContact alone(const state::Spheres& spheres, std::size_t i, const ContactTable& table, const Wall& wall, const WallPose& pose,
                 laws::ContactMemory<Real>& memory, laws::SlipBands<Real>& bands) {
  const auto& place = spheres.place[i];
  const Vector3 centre = spheres.box.wrapped(place.centre()), spin = spheres.spin[i].spin(),
                normal = pose.direction_out(wall.normal);
  const Real overlap = place.radius - (pose.into(centre) - wall.point).dot(wall.normal);
  if (!(overlap > 0)) {
    memory = {};
    bands = {};
    return {};
  }
  const Real arm = place.radius - 0.5 * overlap;
  const Vector3 touched = centre - arm * normal, ground = pose.velocity_at(touched), turns = spin - pose.spin;
  laws::ContactMotion<Real> motion{.overlap = overlap,
                                   .radius = laws::Reduced<Real>::alone(place.radius),
                                   .mass = laws::Reduced<Real>::alone(place.mass),
                                   .normal = normal,
                                   .velocity = place.velocity() - arm * spin.cross(normal) - ground,
                                   .rolling = place.radius * turns.cross(normal),
                                   .twisting = place.radius * turns.dot(normal),
                                   .step = step,
                                   .tilt = step * pose.spin.cross(normal),
                                   .turn = step * pose.spin.dot(normal)};
  const auto& constants = table.of(static_cast<Index>(spheres.spin[i].material), wall.material);
  const auto law = laws::contact_force<Law, rolls>(constants, motion, memory, &bands);
  const Vector3 force = law.normal * normal + law.friction,
                turning = -place.radius * (normal.cross(law.rolling) + law.twisting * normal),
                foot = touched - pose.pivot - pose.shift;
  return {force,
          -arm * normal.cross(force) - turning,
          {-force, turning - foot.cross(force), step * (force.dot(ground) - turning.dot(pose.spin))},
          {law.elastic_energy, law.sliding_energy, step * law.dashpot_power, step * law.sliding_power, 1}};
}

Vector3 force_of(const state::SphereLoad& load) { return {load.fx, load.fy, load.fz}; }
Vector3 moment_of(const state::SphereLoad& load) { return {load.mx, load.my, load.mz}; }

void expect_near(const Vector3& one, const Vector3& other, Real tolerance) { EXPECT_LT((one - other).norm(), tolerance); }

/// A few evaluations of a plane, held against those of single spheres.
template <class Law, bool rolls>
void compare(const ContactTable& table, const Wall& wall, const state::PeriodicBox& box = {}) {
  ASSERT_EQ(table.rolls, rolls);
  state::Spheres spheres = at(wall, box);
  for (auto& spin : spheres.spin) spin.material = std::min(spin.material, static_cast<Real>(table.materials - 1));
  WallContacts contacts(table, {wall}, 0.012 + margin);
  contacts.find(spheres, 0, margin, {}, {});
  std::vector<laws::ContactMemory<Real>> memory(count);
  std::vector<laws::SlipBands<Real>> bands(count);
  std::int64_t most = 0, fewest = count;
  for (int n = 0; n < 300; ++n) {
    const Real time = n * step;
    contacts.move(time);
    const WallPose pose = WallPose::of(wall.motion, time);
    std::vector<state::SphereLoad> loads(count);
    const ContactSums sums = contacts.evaluate(spheres, {0, step, loads.data()});
    OneContact all;
    for (std::size_t i = 0; i < count; ++i) {
      const OneContact one = alone<Law, rolls>(spheres, i, table, wall, pose, memory[i], bands[i]);
      expect_near(force_of(loads[i]), one.force, round_off);
      expect_near(moment_of(loads[i]), one.moment, 0.01 * round_off);
      all.on_plane += one.on_plane;
      all.sums += one.sums;
    }
    const WallLoad on_plane = contacts.loads().front();
    expect_near(on_plane.force, all.on_plane.force, count * round_off);
    expect_near(on_plane.moment, all.on_plane.moment, 0.2 * count * round_off);
    EXPECT_NEAR(on_plane.work, all.on_plane.work, step * count * round_off);
    EXPECT_EQ(sums.contacts, all.sums.contacts);
    EXPECT_NEAR(sums.elastic, all.sums.elastic, 1e-12 * all.sums.elastic);
    EXPECT_NEAR(sums.sliding, all.sums.sliding, 1e-11 * all.sums.sliding);
    EXPECT_NEAR(sums.dashpot_work, all.sums.dashpot_work, 1e-11 * all.sums.dashpot_work);
    EXPECT_NEAR(sums.sliding_work, all.sums.sliding_work, step * count * round_off);
    most = std::max(most, sums.contacts);
    fewest = std::min(fewest, sums.contacts);
    fly(spheres, step);
  }
  EXPECT_GT(most, lane_count);
  EXPECT_LT(fewest, most);
}

template <class Law>
void compare_on(const Wall& wall) {
  compare<Law, false>(three_materials<Law>(false), wall);
  compare<Law, true>(three_materials<Law>(true), wall);
}

Wall still() {
  Wall wall = leaning();
  wall.motion = {};
  return wall;
}

TEST(plane_contacts, in_lanes_are_those_of_single_spheres) {
  compare_on<Hertz>(still());
  compare_on<Linear>(still());
  compare_on<MindlinDeresiewicz>(still());
}

TEST(plane_contacts, with_a_plane_that_moves_and_turns_are_those_of_single_spheres) {
  compare_on<Hertz>(leaning());
  compare_on<Linear>(leaning());
  compare_on<MindlinDeresiewicz>(leaning());
}

TEST(plane_contacts, of_one_material_are_those_of_single_spheres) {
  Wall wall = leaning();
  wall.material = 0;
  compare<Hertz, true>(table({.restitution = 0.7, .friction = 0.3, .rolling = 0.1, .twisting = 0.05}), wall);
}

TEST(plane_contacts, in_a_periodic_room_are_those_of_single_spheres) {
  Wall wall = leaning();
  wall.normal = Vector3::UnitZ();
  wall.motion.spin = Vector3::Zero();
  compare<Hertz, true>(three_materials<Hertz>(true), wall, {{-0.1, -0.15, 0}, {0.25, 0.3, 0}});
}

laws::ContactMemory<Real> some_memory(Real number) {
  return {{number, number + 1, number + 2}, {number + 3, number + 4, number + 5}, number + 6};
}

TEST(plane_row, tells_each_sphere_its_own_memory) {
  PlaneRow row;
  for (Index n = 0; n < 2 * lane_count + 3; ++n) row.add(3 * n + 1, {.rolls = true});
  for (Index n = 0; n < 2 * lane_count + 3; n += 2) row.remember(3 * n + 1, some_memory(10 * n));
  for (const Index missing : {0, 2, 3 * (2 * lane_count + 3) + 1}) row.remember(missing, some_memory(1));
  ASSERT_EQ(row.size(), 2 * lane_count + 3);
  for (std::size_t n = 0; n < row.size(); ++n) {
    EXPECT_EQ(row[n], static_cast<Index>(3 * n + 1));
    ASSERT_EQ(row.remembers(n), n % 2 == 0) << n;
    if (n % 2 != 0) continue;
    EXPECT_EQ(row.memory(n).sliding[1], 10.0 * static_cast<Real>(n) + 1);
    EXPECT_EQ(row.memory(n).rolling[2], 10.0 * static_cast<Real>(n) + 5);
    EXPECT_EQ(row.memory(n).twisting, 10.0 * static_cast<Real>(n) + 6);
  }
}

TEST(plane_row, without_rolling_remembers_sliding_alone) {
  PlaneRow row;
  row.add(5, {});
  row.remember(5, some_memory(1));
  EXPECT_EQ(row.memory(0).sliding[2], 3);
  EXPECT_EQ(row.memory(0).twisting, 0);
}

std::vector<state::SphereLoad> evaluated(WallContacts& contacts, const state::Spheres& spheres) {
  std::vector<state::SphereLoad> loads(spheres.size());
  contacts.evaluate(spheres, {0, step, loads.data()});
  return loads;
}

WallContacts at_leaning(const state::Spheres& spheres, int evaluations) {
  Wall far_below;
  far_below.point.z() = -9;
  WallContacts contacts(three_materials<Hertz>(true), {far_below, leaning()}, 0.012 + margin);
  contacts.find(spheres, 0, margin, {}, {});
  for (int n = 0; n < evaluations; ++n) evaluated(contacts, spheres);
  return contacts;
}

void expect_equal(const state::SphereLoad& one, const state::SphereLoad& other) {
  EXPECT_EQ(force_of(one), force_of(other));
  EXPECT_EQ(moment_of(one), moment_of(other));
}

TEST(plane_contacts, that_part_are_forgotten) {
  const state::Spheres pressed = at(leaning());
  state::Spheres apart = pressed;
  for (auto& place : apart.place) place.z += 0.0025;
  WallContacts anew = at_leaning(pressed, 0), long_there = at_leaning(pressed, 5), parted = at_leaning(pressed, 5);
  evaluated(parted, apart);
  const auto first = evaluated(anew, pressed), again = evaluated(parted, pressed), last = evaluated(long_there, pressed);
  int other = 0;
  for (std::size_t i = 0; i < count; ++i) {
    expect_equal(again[i], first[i]);
    other += force_of(last[i]) != force_of(first[i]) ? 1 : 0;
  }
  EXPECT_GT(other, 3);
}

TEST(plane_contacts, are_remembered_by_a_search_that_puts_spheres_in_another_order) {
  const state::Spheres spheres = at(leaning());
  WallContacts before = at_leaning(spheres, 5), sought = at_leaning(spheres, 5);
  state::Spheres reordered = spheres;
  std::vector<Index> new_place(count);
  static_assert(count % 7 != 0);  // each is met once
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t from = (7 * n + 2) % count;
    new_place[from] = static_cast<Index>(n);
    reordered.place[n] = spheres.place[from];
    reordered.spin[n] = spheres.spin[from];
    reordered.number[n] = spheres.number[from];
  }
  const std::vector<std::int8_t> part(count, 1);
  sought.find(reordered, 0, margin, new_place, {2, part});
  const auto expected = evaluated(before, spheres);
  std::vector<state::SphereLoad> loads(count);
  sought.evaluate(reordered, {0, step, loads.data(), 0});
  for (const auto& load : loads) EXPECT_EQ(force_of(load), Vector3(Vector3::Zero()));
  sought.evaluate(reordered, {0, step, loads.data(), 1});
  for (std::size_t n = 0; n < count; ++n) expect_equal(loads[static_cast<std::size_t>(new_place[n])], expected[n]);
}

TEST(plane_contacts, are_forgotten_by_a_search_that_finds_them_far_away) {
  const state::Spheres pressed = at(leaning());
  state::Spheres far = pressed;
  for (auto& place : far.place) place.z += 1;
  WallContacts anew = at_leaning(pressed, 0), sought = at_leaning(pressed, 5);
  sought.find(far, 0, margin, {}, {});
  sought.find(pressed, 0, margin, {}, {});
  const auto first = evaluated(anew, pressed), again = evaluated(sought, pressed);
  for (std::size_t i = 0; i < count; ++i) expect_equal(again[i], first[i]);
}

/// A run that is resumed finds who is near anew: sums may not depend on who is near without touching.
TEST(plane_contacts, give_the_same_bits_whoever_else_is_near) {
  const Wall wall = leaning();
  const state::Spheres spheres = at(wall);
  const ContactTable table = three_materials<Hertz>(true);
  WallContacts few(table, {wall}, 0.012 + margin), all(table, {wall}, 0.012 + margin);
  few.find(spheres, 0, 1e-6, {}, {});
  all.find(spheres, 0, 1, {}, {});
  std::vector<state::SphereLoad> loads(count), more_loads(count);
  for (int n = 0; n < 3; ++n) {
    const ContactSums sums = few.evaluate(spheres, {0, step, loads.data()}),
                      more = all.evaluate(spheres, {0, step, more_loads.data()});
    EXPECT_GT(sums.contacts, 1);
    EXPECT_LT(sums.contacts, static_cast<std::int64_t>(count) - 2);
    EXPECT_EQ(sums.contacts, more.contacts);
    EXPECT_EQ(sums.elastic, more.elastic);
    EXPECT_EQ(sums.sliding, more.sliding);
    EXPECT_EQ(sums.dashpot_work, more.dashpot_work);
    EXPECT_EQ(sums.sliding_work, more.sliding_work);
    EXPECT_EQ(few.loads().front().force, all.loads().front().force);
    EXPECT_EQ(few.loads().front().moment, all.loads().front().moment);
    EXPECT_EQ(few.loads().front().work, all.loads().front().work);
  }
}

TEST(plane_contacts, go_on_from_a_checkpoint) {
  const state::Spheres spheres = at(leaning());
  WallContacts through = at_leaning(spheres, 5), resumed = at_leaning(spheres, 0);
  test::MemoryArchive checkpoint;
  through.columns(checkpoint);
  checkpoint.turn_round();
  resumed.columns(checkpoint);
  resumed.find(spheres, 0, margin, {}, {});
  const auto expected = evaluated(through, spheres), loads = evaluated(resumed, spheres);
  for (std::size_t i = 0; i < count; ++i) expect_equal(loads[i], expected[i]);
}

}  // namespace
}  // namespace sazare::methods::spheres
