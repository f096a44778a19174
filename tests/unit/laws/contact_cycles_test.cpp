/// Contacts that are pressed, sheared, rolled, twisted, unloaded and turned in any order: they never yield work, and two bodies
/// that turn as one keep their forces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sazare/laws/granular_contact.hpp"

namespace sazare::laws {
namespace {

constexpr Real step = 1e-7, deepest = 2e-6;
constexpr int steps_of_a_move = 400;

template <class Law>
ContactConstants<Real> constants_of(Real restitution, const GrainFriction& friction) {
  const GrainElasticity glass{70e9, 0.25};
  if constexpr (std::is_same_v<Law, Linear>)
    return Law::constants({{}, {}, restitution, friction}, {1e6, 8e5});
  else if constexpr (std::is_same_v<Law, Jkr>)
    return Law::constants({glass, glass, restitution, friction}, {0.5});
  else
    return Law::constants({glass, glass, restitution, friction}, {});
}

/// How a contact moves for a while.
struct Move {
  Real opening = 0;                   ///< [m/s]
  Vector3 sliding = Vector3::Zero();  ///< in the frame of the contact, whose third axis is the normal [m/s]
  Vector3 rolling = Vector3::Zero();  ///< [m/s]
  Real twisting = 0;                  ///< [m/s]
  Vector3 spin = Vector3::Zero();     ///< of both bodies together [rad/s]
};

/// A contact that is led along a path, and the work that this takes.
template <class Law>
class LedContact {
public:
  LedContact(const ContactConstants<Real>& constants, Real overlap) : constants_(constants), overlap_(overlap) {
    evaluate({}, 0);
    stored_ = force_.elastic_energy;
  }

  void go(const Move& move, int steps = steps_of_a_move) {
    for (int n = 0; n < steps; ++n) evaluate(move, step);
  }

  Real overlap() const { return overlap_; }
  /// Work done on the contact since the beginning [J].
  Real work() const { return work_; }
  /// The part of the work that was done on the sliders [J].
  Real sliding_work() const { return sliding_work_; }
  /// The part of the work that is not stored in the contact [J].
  Real lost() const { return work_ - (force_.elastic_energy + force_.sliding_energy - stored_); }
  const ContactForce<Real>& force() const { return force_; }
  Vector3 friction_in_frame() const { return frame_.transpose() * force_.friction; }

private:
  void evaluate(const Move& move, Real seconds) {
    overlap_ -= 0.5 * seconds * (before_.opening + move.opening);
    const Real rate = move.spin.norm();
    if (rate * seconds > 0) frame_ = Eigen::AngleAxis<Real>(rate * seconds, move.spin / rate) * frame_;
    const Vector3 normal = frame_.col(2), tilt = seconds * move.spin.cross(normal);
    const auto in_space = [&](const Vector3& of) { return Vector3(frame_ * of); };
    ContactMotion<Real> at{.overlap = overlap_,
                           .radius = Reduced<Real>::of(0.007, 0.0175),
                           .mass = Reduced<Real>::alone(0.01),
                           .normal = normal,
                           .velocity = in_space(move.sliding + Vector3{0, 0, move.opening}),
                           .rolling = in_space(move.rolling),
                           .twisting = move.twisting,
                           .step = step,
                           .tilt = tilt,
                           .turn = seconds * move.spin.dot(normal)};
    force_ = contact_force<Law, true>(constants_, at, memory_, &bands_);
    const Real sliding_power = force_.sliding_power, power = sliding_power - force_.normal * move.opening;
    work_ += 0.5 * seconds * (power_ + power);
    sliding_work_ += 0.5 * seconds * (sliding_power_ + sliding_power);
    power_ = power;
    sliding_power_ = sliding_power;
    before_ = move;
  }

  ContactConstants<Real> constants_;
  Real overlap_;
  ContactMemory<Real> memory_{};
  SlipBands<Real> bands_;
  ContactForce<Real> force_{};
  Move before_;
  Matrix3 frame_ = Matrix3::Identity();
  Real power_ = 0, sliding_power_ = 0, work_ = 0, sliding_work_ = 0, stored_ = 0;
};

class RandomMoves {
public:
  explicit RandomMoves(unsigned seed) : engine_(seed) {}

  Real number(Real most) { return most * std::uniform_real_distribution<Real>(-1, 1)(engine_); }

  /// One of press or unload, shear, roll, twist and turn, or all of them at once; the overlap stays between a twentieth of the
  /// deepest and the deepest.
  Move next(Real overlap) {
    const Real seconds = steps_of_a_move * step, way = 0.3 * deepest;
    Move move;
    const int kind = std::uniform_int_distribution<int>(0, 5)(engine_);
    const auto is = [&](int which) { return kind == which || kind == 5; };
    if (is(0)) move.opening = (overlap - std::clamp(overlap + number(deepest), 0.05 * deepest, deepest)) / seconds;
    if (is(1)) move.sliding = {number(way) / seconds, number(way) / seconds, 0};
    if (is(2)) move.rolling = {number(way) / seconds, number(way) / seconds, 0};
    if (is(3)) move.twisting = number(way) / seconds;
    if (is(4)) move.spin = Vector3(number(1), number(1), number(1)) / seconds;
    return move;
  }

private:
  std::mt19937 engine_;
};

template <class Law>
void expect_loss_in_any_order() {
  for (const Real restitution : {1.0, 0.4})
    for (const GrainFriction& friction :
         {GrainFriction{0.4}, GrainFriction{1e9}, GrainFriction{0.4, 0.1}, GrainFriction{0.4, 1e9, 0.2}, GrainFriction{0, 0, 0.1}})
      for (unsigned seed = 1; seed <= 4; ++seed) {
        LedContact<Law> contact(constants_of<Law>(restitution, friction), 0.5 * deepest);
        RandomMoves moves(seed);
        Real held = 0, most = 0, lost = 0;
        for (int n = 0; n < 60; ++n) {
          contact.go(moves.next(contact.overlap()));
          held = std::max(held, contact.force().elastic_energy);
          most = std::max(most, contact.sliding_work());
          // Work is summed by the trapezoidal rule, which errs by some 1/n^2 where a speed jumps after n steps.
          EXPECT_GE(contact.lost(), lost - 2e-5 * held) << seed;
          lost = std::max(lost, contact.lost());
          EXPECT_GE(contact.sliding_work(), -1e-4 * most - 1e-15 * held) << seed;
        }
        EXPECT_GT(most, 0);
      }
}

TEST(contact_cycles, lose_work_in_any_order) {
  expect_loss_in_any_order<Hertz>();
  expect_loss_in_any_order<Linear>();
  expect_loss_in_any_order<Jkr>();
  expect_loss_in_any_order<MindlinDeresiewicz>();
}

/// Pressed, sheared, pressed more, sheared back and unloaded, the contact is where it was.
template <class Law>
Real work_of_cycle(const Vector3& sliding, const Vector3& rolling, Real twisting) {
  const Real seconds = steps_of_a_move * step, press = 0.5 * deepest / seconds;
  LedContact<Law> contact(constants_of<Law>(1, {1e9, 1e9, 1e9}), 0.1 * deepest);
  const auto back = [](const Vector3& of) { return -of; };
  for (const Move& move : {Move{.opening = -press}, Move{.sliding = sliding, .rolling = rolling, .twisting = twisting},
                           Move{.opening = -press}, Move{.sliding = back(sliding), .rolling = back(rolling), .twisting = -twisting},
                           Move{.opening = press}, Move{.opening = press}})
    contact.go(move);
  contact.go({}, 1);
  EXPECT_NEAR(contact.overlap(), 0.1 * deepest, 1e-9 * deepest);
  return contact.work() - contact.force().sliding_energy;
}

TEST(contact_cycles, pressing_a_sheared_contact_fills_it_with_nothing) {
  const Real speed = 0.3 * deepest / (steps_of_a_move * step);
  const auto expect_none = [&]<class Law>(Law) {
    LedContact<Law> sheared(constants_of<Law>(1, {1e9}), 0.6 * deepest);
    sheared.go({.sliding = {speed, 0, 0}});
    const Real scale = sheared.work();
    EXPECT_GT(scale, 0);
    const Vector3 none = Vector3::Zero();
    EXPECT_NEAR(work_of_cycle<Law>({speed, 0, 0}, none, 0), 0, 1e-4 * scale);
    EXPECT_NEAR(work_of_cycle<Law>(none, {0, speed, 0}, 0), 0, 1e-4 * scale);
    EXPECT_NEAR(work_of_cycle<Law>(none, none, speed), 0, 1e-4 * scale);
  };
  expect_none(Hertz{});
  expect_none(Linear{});
  expect_none(Jkr{});
}

/// Friction that a rigid turn about any axis leaves as it was, seen from the two bodies.
template <class Law>
void expect_same_forces_of_bodies_that_turn_as_one() {
  const Real seconds = steps_of_a_move * step, speed = 0.2 * deepest / seconds;
  for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0.3, -0.5, 0.8), Vector3(0.6, 0.6, 0.1)}) {
    LedContact<Law> still(constants_of<Law>(0.8, {0.4, 0.1, 0.1}), 0.5 * deepest), turning = still;
    const Move shear{.sliding = {speed, 0.5 * speed, 0}, .rolling = {0.3 * speed, speed, 0}};
    Move turned = shear;
    turned.spin = 3 * axis.normalized() / seconds;
    for (int n = 0; n < 3; ++n) {
      still.go(n == 0 ? shear : Move{});
      turning.go(n == 0 ? turned : Move{.spin = turned.spin});
    }
    const Vector3 expected = still.friction_in_frame(), found = turning.friction_in_frame();
    EXPECT_GT(expected.norm(), 0);
    const Real angle_of_step = 3.0 / steps_of_a_move;
    EXPECT_LT((found - expected).norm(), angle_of_step * angle_of_step * expected.norm()) << axis.transpose();
    EXPECT_NEAR(turning.force().sliding_energy, still.force().sliding_energy, 1e-5 * still.force().sliding_energy);
  }
}

TEST(contact_cycles, bodies_that_turn_as_one_keep_their_forces) {
  expect_same_forces_of_bodies_that_turn_as_one<Hertz>();
  expect_same_forces_of_bodies_that_turn_as_one<MindlinDeresiewicz>();
}

/// However fast both turn, nothing is lengthened.
TEST(contact_cycles, a_turn_of_the_plane_lengthens_no_stretch) {
  for (const Real turn : {1e-6, 1e-3, 0.1, 0.5, 1.0, -0.7}) {
    const Vector3 turned = PlaneTurn<Real>({0, 0, 1}, Vector3::Zero(), turn).carried({3, 4, 0});
    EXPECT_LE(std::sqrt(dot(turned, turned)), 5 * (1 + 1e-15));
    EXPECT_NEAR(std::atan2(turned.y(), turned.x()) - std::atan2(4, 3), turn, 0.04 * std::pow(std::abs(turn), 3) + 1e-15);
  }
}

}  // namespace
}  // namespace sazare::laws
