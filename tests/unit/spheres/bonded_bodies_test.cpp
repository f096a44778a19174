/// Bodies of bonded spheres: what must be kept, pieces, contacts of broken bonds, and the same bits.

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "sazare/geometry/ball_members.hpp"
#include "sazare/methods/spheres/bonded_bodies.hpp"
#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity(), modulus = 1e8, poisson = 0.2, density = 2500;

struct Cement {
  laws::BondStrength<Real> strength{infinite, infinite, 0, 1};
  Real damping = 0;  ///< share of the critical one
};

/// Bodies of overlapping balls, which share the mass of their union.
class Bodies {
public:
  explicit Bodies(const Cement& cement) : cement_(cement) {}

  /// Balls about their centre of mass along their principal axes.
  void add(const std::vector<geometry::Ball>& balls, const geometry::UnionProperties& whole, const Vector3& centre,
           const Eigen::Quaternion<Real>& turn, const Vector3& velocity, const Vector3& spin) {
    const auto first = static_cast<Index>(spheres_.size());
    const auto shares = geometry::share_mass(balls, whole.volume, whole.inertia.diagonal());
    for (std::size_t n = 0; n < balls.size(); ++n) {
      const Vector3 arm = turn * balls[n].centre;
      const std::size_t i = spheres_.size();
      spheres_.add(centre + arm, balls[n].radius, density, 0);
      spheres_.set_share(i, density * shares.of[n].volume, density * shares.of[n].inertia);
      spheres_.set_motion(i, velocity + spin.cross(arm), spin);
      body_.push_back(count_);
    }
    for (const auto& [one, other] : geometry::neighbouring_balls(balls, 0)) bond(first + one, first + other);
    ++count_;
  }

  /// Level 1 for spheres that are smaller than this [m].
  std::vector<std::int8_t> levels(Real small) const {
    std::vector<std::int8_t> level;
    for (const auto& place : spheres_.place) level.push_back(place.radius < small ? 1 : 0);
    return level;
  }

  void set_velocity(std::size_t sphere, const Vector3& velocity) { spheres_.set_motion(sphere, velocity, Vector3::Zero()); }

  methods::spheres::SphereStepper stepper(const Rules& rules, std::vector<Wall> walls = {}) const {
    Bonds bonds(bonds_, {cement_.strength});
    BondedBodies bodies(body_, bonds);
    return {spheres_,         table(rules), std::move(walls), {rules.step, rules.gravity, rules.margin, 5e-3, rules.level},
            std::move(bonds), {},           std::move(bodies)};
  }

private:
  void bond(Index first, Index second) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const Vector3 apart = spheres_.place[j].centre() - spheres_.place[i].centre();
    Bond bond;
    bond.first = first;
    bond.second = second;
    bond.radius = std::min(spheres_.place[i].radius, spheres_.place[j].radius);
    bond.stiffness = laws::beam_stiffness(apart.norm(), bond.radius, modulus, poisson);
    bond.direction = apart.normalized();
    const Real mass = std::min(spheres_.place[i].mass, spheres_.place[j].mass);
    bond.damping.along = bond.damping.across = cement_.damping * std::sqrt(bond.stiffness.stretch * mass);
    bonds_.push_back(bond);
  }

  Cement cement_;
  state::Spheres spheres_;
  std::vector<Index> body_;
  std::vector<Bond> bonds_;
  Index count_ = 0;
};

struct Template {
  std::vector<geometry::Ball> balls;
  geometry::UnionProperties whole;

  explicit Template(std::vector<geometry::Ball> of) : balls(std::move(of)), whole(geometry::properties_of_union(balls, 128)) {
    for (geometry::Ball& ball : balls) ball.centre -= whole.centre;
  }
};

const Template& tetrapod() {
  static const Template shape(geometry::tetrapod_balls(0.05, 2));
  return shape;
}

const Template& small_tetrapod() {
  static const Template shape(geometry::tetrapod_balls(0.02, 2));
  return shape;
}

/// Three balls that overlap by more than half, the outer ones as well.
const Template& bar() {
  static const Template shape({{{-0.006, 0, 0}, 0.01}, {{0, 0, 0}, 0.01}, {{0.006, 0, 0}, 0.01}});
  return shape;
}

methods::spheres::SphereStepper single(const Template& shape, const Cement& cement, Real step, const Vector3& velocity,
                             const Vector3& spin) {
  Bodies bodies(cement);
  bodies.add(shape.balls, shape.whole, {0.01, -0.02, 0.03},
             Eigen::Quaternion<Real>(Eigen::AngleAxis<Real>(0.3, Vector3::UnitY())), velocity, spin);
  return bodies.stepper({.restitution = 0.5, .friction = 0.3, .step = step});
}

TEST(bonded_bodies, at_rest_nothing_pushes_what_overlaps) {
  auto stepper = single(tetrapod(), {}, 1e-6, Vector3::Zero(), Vector3::Zero());
  stepper.start();
  advance(stepper, 1000);
  EXPECT_EQ(stepper.contacts(), 0);
  EXPECT_LT(stepper.energies().translation + stepper.energies().rotation, 1e-24);  // by round-off
}

/// In free flight momentum and angular momentum are those of the rigid body, and stay.
TEST(bonded_bodies, free_flight_keeps_momentum_angular_momentum_and_energy) {
  const Vector3 velocity(1, -2, 0.5), spin(20, 35, -10);
  auto stepper = single(tetrapod(), {}, 1e-6, velocity, spin);
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real mass = density * tetrapod().whole.volume, energy = stepper.energies().sum();
  const Matrix3 inertia = density * tetrapod().whole.inertia;
  EXPECT_LT((momentum - mass * velocity).norm(), 1e-12 * momentum.norm());
  const Vector3 rigid = mass * Vector3(0.01, -0.02, 0.03).cross(velocity) + inertia(0, 0) * spin;  // alike about all axes
  EXPECT_LT((turning - rigid).norm(), 2e-3 * rigid.norm());  // as far as the lines make them alike
  advance(stepper, 100000);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
  EXPECT_NEAR(stepper.energies().sum(), energy, 1e-4 * energy);
}

Bond link(Index first, Index second, bool broken) {
  Bond bond;
  bond.first = first;
  bond.second = second;
  bond.largest_use = broken ? 1 : 0;
  return bond;
}

TEST(bonded_bodies, are_in_pieces_where_no_chain_of_bonds_is_left) {
  const auto pieces = [](const std::array<bool, 5>& broken) {
    // A ring 1 2 3 4 beside a single sphere, and a pair; the last bond joins the two bodies.
    const Bonds bonds({link(1, 2, broken[0]), link(1, 4, broken[1]), link(2, 3, broken[2]), link(3, 4, broken[3]),
                       link(4, 5, false), link(5, 6, broken[4])},
                      {{infinite, infinite, 0, 1}});
    const BondedBodies bodies({-1, 0, 0, 0, 0, 1, 1}, bonds);
    std::vector<Index> piece;
    for (Index n = 0; n < 7; ++n) piece.push_back(bodies.piece(n));
    return std::pair(piece, std::array{bodies.is_whole(0), bodies.is_whole(1)});
  };
  using Pieces = std::vector<Index>;
  EXPECT_EQ(pieces({false, false, false, false, false}), std::pair(Pieces({-1, 1, 1, 1, 1, 5, 5}), std::array{true, true}));
  EXPECT_EQ(pieces({true, false, false, false, true}), std::pair(Pieces({-1, 1, 1, 1, 1, 5, 6}), std::array{true, false}));
  EXPECT_EQ(pieces({true, false, false, true, false}), std::pair(Pieces({-1, 1, 2, 2, 1, 5, 5}), std::array{false, true}));
}

/// A bar that whirls tears itself apart. What overlaps when it breaks is left alone: the pieces keep their velocities.
TEST(bonded_bodies, a_bar_that_is_torn_apart_does_not_burst) {
  auto stepper = single(bar(), {.strength = {1e5, infinite, 0, 1}}, 1e-7, Vector3::Zero(), {0, 0, 4000});
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  Real most = 0;
  for (int k = 0; k < 4000; ++k) {
    stepper.advance();
    stepper.evaluate_now();
    most = std::max(most, stepper.energies().elastic);
  }
  EXPECT_EQ(stepper.broken_bonds(), 2);
  EXPECT_LT(most, 1e-3 * energy);
  EXPECT_LE(stepper.energies().translation + stepper.energies().rotation, energy);
  EXPECT_GT((centre_of(stepper, 2) - centre_of(stepper, 0)).norm(), 0.02);  // they have come apart
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-12);
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
  EXPECT_NEAR(stepper.energies().sum(), energy, 1e-4 * energy);
}

/// A bond that is sheared off while it is pressed: its contact holds at most what the bond held, and pushes the pieces apart with
/// no more than that.
TEST(bonded_bodies, what_a_broken_bond_leaves_pressed_makes_no_energy) {
  const Template pair({{{-0.006, 0, 0}, 0.01}, {{0.006, 0, 0}, 0.01}});
  for (const Real press : {0.0, 2.0, 8.0}) {
    Bodies bodies({.strength = {infinite, 3e5, 0.2, 1}});
    bodies.add(pair.balls, pair.whole, Vector3::Zero(), Eigen::Quaternion<Real>::Identity(), Vector3::Zero(), Vector3::Zero());
    bodies.set_velocity(0, {press, 4, 0});
    bodies.set_velocity(1, {-press, -4, 0});
    auto stepper = bodies.stepper({.step = 2e-8});
    stepper.start();
    const Real energy = stepper.energies().sum();
    Real broke_with = -1;  // what breaking took
    for (int k = 0; k < 60000; ++k) {
      stepper.advance();
      stepper.evaluate_now();
      const auto now = stepper.energies();
      EXPECT_GE(now.fracture, -1e-12 * energy);
      if (stepper.broken_bonds() > 0 && broke_with < 0) broke_with = now.fracture;
    }
    EXPECT_GT(broke_with, 0) << press;
    EXPECT_NEAR(stepper.energies().sum(), energy, 2e-3 * energy) << press;
    EXPECT_EQ(stepper.contacts(), 0);  // they have flown apart
  }
}

/// A ring of four of which one bond breaks stays one piece. Where it broke its spheres touch again, also after new searches.
TEST(bonded_bodies, a_crack_that_parts_nothing_closes_again) {
  state::Spheres spheres;
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(0.018, 0, 0), Vector3(0.018, 0.018, 0), Vector3(0, 0.018, 0)})
    spheres.add(place, 0.01, density, 0);
  spheres.set_motion(0, {-1.5, 0, 0}, {0, 0, 100});  // the whole turns, so that pairs are sought anew
  spheres.set_motion(1, {1.5, 0, 0}, {0, 0, 100});
  std::vector<Bond> bonds;
  for (const auto& [first, second] : {std::pair<Index, Index>(0, 1), {0, 3}, {1, 2}, {2, 3}}) {
    Bond bond;
    bond.first = first;
    bond.second = second;
    bond.kind = bonds.empty() ? 0 : 1;
    bond.radius = 0.005;
    bond.stiffness = laws::beam_stiffness(0.018, bond.radius, modulus, poisson);
    bond.direction =
        (spheres.place[static_cast<std::size_t>(second)].centre() - spheres.place[static_cast<std::size_t>(first)].centre()) /
        0.018;
    bonds.push_back(bond);
  }
  const Bonds ring(bonds, {{1e5, infinite, 0, 1}, {infinite, infinite, 0, 1}});
  methods::spheres::SphereStepper stepper(spheres, table({}), {}, {5e-7, Vector3::Zero(), 2e-4, 5e-3}, ring, {},
                                BondedBodies({0, 0, 0, 0}, ring));
  stepper.start();
  const Real energy = stepper.energies().sum();
  Real most = 0;
  for (int k = 0; k < 20000; ++k) {
    stepper.advance();
    stepper.evaluate_now();
    most = std::max(most, stepper.energies().elastic);
  }
  EXPECT_EQ(stepper.broken_bonds(), 1);
  EXPECT_TRUE(stepper.bodies().is_whole(0));
  EXPECT_GT(stepper.searches(), 3);
  EXPECT_GT(most, 1e-3 * energy);
  EXPECT_LE(most, energy);
  EXPECT_NEAR(stepper.energies().sum(), energy, 2e-3 * energy);
}

Rules falling() { return {.restitution = 0.5, .friction = 0.4, .step = 1e-6, .gravity = {0, 0, -10}}; }

/// Tetrapods that fly into each other and break; with `small`, every third one is of less than half the size.
Bodies cloud(int across, bool small = false) {
  std::uint64_t state = 5;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state >> 11) / 4503599627370496.0 - 1;
  };
  Bodies bodies({.strength = {4e5, 4e5, 0.3, 1.3}, .damping = 0.05});
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k) {
        const Eigen::Quaternion<Real> turn = Eigen::Quaternion<Real>(random(), random(), random(), random()).normalized();
        const Vector3 velocity(random(), random(), random()), spin(random(), random(), random());
        const Template& shape = small && (i + j + k) % 3 == 0 ? small_tetrapod() : tetrapod();
        bodies.add(shape.balls, shape.whole, 0.056 * Vector3(i, j, k) + Vector3(0.03, 0.03, 0.03), turn, 8 * velocity,
                   200 * spin);
      }
  return bodies;
}

/// Tetrapods of two sizes, at two levels.
methods::spheres::SphereStepper two_sizes(int across, Rules rules, std::vector<Wall> walls = {}) {
  const Bodies bodies = cloud(across, true);
  rules.level = bodies.levels(0.7 * std::ranges::max(tetrapod().balls, {}, &geometry::Ball::radius).radius);
  return bodies.stepper(rules, std::move(walls));
}

test::MemoryArchive state_of(methods::spheres::SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

std::size_t broken_bodies(const methods::spheres::SphereStepper& stepper) {
  std::size_t broken = 0;
  for (std::size_t body = 0; body < stepper.bodies().count(); ++body) broken += stepper.bodies().is_whole(body) ? 0 : 1;
  return broken;
}

void expect_to_break_and_balance_energy(methods::spheres::SphereStepper stepper) {
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  advance(stepper, 8000);
  EXPECT_GT(broken_bodies(stepper), 3);
  EXPECT_LT(broken_bodies(stepper), 27);
  EXPECT_GT(stepper.energies().fracture, 1e-4 * energy);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-12 * stepper.spheres().size());
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
  EXPECT_NEAR(stepper.energies().sum(), energy, 2e-3 * energy);
}

TEST(bonded_bodies, break_each_other_and_energy_balances) {
  auto rules = falling();
  rules.gravity = Vector3::Zero();
  expect_to_break_and_balance_energy(cloud(3).stepper(rules));
}

TEST(bonded_bodies, of_several_levels_break_each_other_and_energy_balances) {
  auto rules = falling();
  rules.gravity = Vector3::Zero();
  auto stepper = two_sizes(3, rules);
  EXPECT_EQ(stepper.levels().finest(), 1);
  expect_to_break_and_balance_energy(std::move(stepper));
}

TEST(bonded_bodies, give_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads, bool levels) {
    parallel::set_threads(threads);
    auto stepper =
        levels ? two_sizes(7, falling(), {Wall{}}) : cloud(7).stepper(falling(), {Wall{}});  // 3087 spheres: four tiles
    stepper.start();
    advance(stepper, 1500);
    EXPECT_GT(stepper.searches(), 2);
    EXPECT_GT(broken_bodies(stepper), 5);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  for (const bool levels : {false, true}) {
    const auto alone = run(1, levels);
    for (const int threads : {2, 3}) EXPECT_TRUE(run(threads, levels) == alone) << threads << levels;
  }
}

/// Bodies part while forces are kept or not.
TEST(bonded_bodies, go_the_same_way_whether_or_not_one_looks_at_them) {
  auto watched = cloud(3).stepper(falling()), alone = cloud(3).stepper(falling());
  watched.start();
  alone.start();
  for (int step = 0; step < 4000; ++step) {
    watched.advance();
    watched.evaluate_now();
    alone.advance();
  }
  alone.evaluate_now();
  EXPECT_GT(broken_bodies(alone), 1);
  EXPECT_TRUE(state_of(watched) == state_of(alone));
}

TEST(bonded_bodies, go_on_from_a_checkpoint_as_if_nothing_had_been) {
  for (const bool levels : {false, true}) {
    const auto make = [&] { return levels ? two_sizes(3, falling(), {Wall{}}) : cloud(3).stepper(falling(), {Wall{}}); };
    auto through = make(), resumed = make();
    through.start();
    advance(through, 4000);
    EXPECT_GT(broken_bodies(through), 1);
    test::MemoryArchive checkpoint = state_of(through);
    checkpoint.turn_round();
    resumed.columns(checkpoint);
    EXPECT_EQ(broken_bodies(resumed), broken_bodies(through));
    advance(through, 3000);
    advance(resumed, 3000);
    EXPECT_TRUE(state_of(through) == state_of(resumed)) << levels;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
