/// Partial slip of Hertz contacts: the curves and loops of Mindlin and Deresiewicz, and springs in a row that are so many that
/// they are the theory.

#include "sazare/laws/slip_bands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sazare/core/twin_lanes.hpp"
#include "sazare/laws/granular_contact.hpp"

namespace sazare::laws {
namespace {

constexpr Real friction = 0.3, radius = 0.005, step = 1e-7, deepest = 2e-6;

ContactConstants<Real> constants(Real restitution = 1, Real coefficient = friction) {
  const GrainElasticity glass{70e9, 0.25};
  return MindlinDeresiewicz::constants({glass, glass, restitution, {coefficient}}, {});
}

ContactMotion<Real> touching(Real overlap) {
  ContactMotion<Real> at{};
  at.overlap = overlap;
  at.radius = Reduced<Real>::alone(radius);
  at.mass = Reduced<Real>::alone(0.01);
  at.normal = {0, 0, 1};
  at.step = step;
  return at;
}

Real width_of(Real overlap) { return std::sqrt(radius * overlap); }
Real stiffness_of(Real overlap) { return constants().tangential * width_of(overlap); }
Real limit_of(Real overlap) { return friction * constants().normal * width_of(overlap) * overlap; }

/// A contact that is pressed and sheared in small steps, each of a way.
class Sheared {
public:
  explicit Sheared(const ContactConstants<Real>& of = constants()) : constants_(of) {}

  ContactForce<Real> go(Real overlap, const Vector3& way) {
    // The memory lags by half a step, so that a way counts half in the step where it is made and half in the next one.
    ContactMotion<Real> at = touching(overlap);
    at.velocity = way / step;
    contact_force<MindlinDeresiewicz, false>(constants_, at, memory_, &bands_);
    at.velocity.setZero();
    return contact_force<MindlinDeresiewicz, false>(constants_, at, memory_, &bands_);
  }
  ContactForce<Real> press(Real from, Real to, int steps = 200) {
    ContactForce<Real> force{};
    for (int n = 0; n <= steps; ++n) force = go(from + (to - from) * n / steps, Vector3::Zero());
    return force;
  }

  const SlipBands<Real>& bands() const { return bands_; }

private:
  ContactConstants<Real> constants_;
  ContactMemory<Real> memory_;
  SlipBands<Real> bands_;
};

/// Mindlin: the way at which T/(mu N) is reached, over that at which all slides, and the other way round.
Real way_of(Real share) { return 1 - std::pow(1 - share, 2.0 / 3); }
Real share_of(Real way) { return way < 1 ? 1 - std::pow(1 - way, 1.5) : 1; }

/// Overlaps at which the outermost band is from nearly nothing to as wide as it gets.
std::vector<Real> some_overlaps() {
  std::vector<Real> all;
  for (int n = 0; n < 12; ++n) all.push_back(deepest * std::pow(SlipBands<Real>::growth, -2.0 * n / 12));
  return all;
}

/// What a band that slips as a whole may make of the curve: most where the outermost is as wide as it gets, see below.
constexpr Real of_bands = 0.0096;

/// The bound above: a band holds G w x until it slips at its mean limit, where the springs that it stands for slip one after the
/// other.
TEST(slip_bands, miss_the_curve_of_mindlin_by_most_where_the_outermost_slips) {
  const Real begins = 1 / SlipBands<Real>::growth, limit = 1 - 0.5 * begins * (3 - begins * begins),
             way = limit / (1.5 * (1 - begins)), slips_from = std::sqrt(1 - way),
             exact = 1.5 * way * (slips_from - begins) + 1 - 0.5 * slips_from * (3 - slips_from * slips_from);
  EXPECT_NEAR(limit - exact, of_bands, 1e-4);
}

TEST(slip_bands, follow_the_curve_of_mindlin) {
  Real worst = 0;
  for (const Real overlap : some_overlaps()) {
    Sheared contact;
    contact.press(0.02 * deepest, overlap);
    const Real longest = 1.5 * limit_of(overlap) / stiffness_of(overlap);
    for (int n = 1; n <= 240; ++n) {
      const Real force = -contact.go(overlap, {longest / 200, 0, 0}).friction[0] / limit_of(overlap);
      worst = std::max(worst, std::abs(force - share_of(n / 200.0)));
      if (n >= 200) {
        EXPECT_NEAR(force, 1, 1e-12);
      }
    }
  }
  EXPECT_LT(worst, of_bands);
  EXPECT_GT(worst, 0.8 * of_bands);  // full slip alone would be off by 0.19
}

TEST(slip_bands, begin_with_the_stiffness_of_mindlin) {
  for (const Real overlap : some_overlaps()) {
    Sheared contact;
    contact.press(0.02 * deepest, overlap);
    const Real way = 1e-6 * limit_of(overlap) / stiffness_of(overlap);
    EXPECT_NEAR(-contact.go(overlap, {way, 0, 0}).friction[0], stiffness_of(overlap) * way, 1e-9 * stiffness_of(overlap) * way);
  }
}

/// A loop between two ways: unloading and reloading follow the curve at twice its size (Masing).
struct Loop {
  Real worst = 0;       ///< difference to the curve, over mu N
  Real work = 0;        ///< of a closed loop [J]
  Real of_sliders = 0;  ///< what the bands lose as sliders that each slip at their limit [J]
};

/// By the share of mu N at which the curve of Mindlin turns back.
Loop loop_of(Real overlap, Real share) {
  Sheared contact;
  contact.press(0.02 * deepest, overlap);
  const Real longest = 1.5 * limit_of(overlap) / stiffness_of(overlap), far = way_of(share) * longest;
  constexpr int steps = 400;
  Loop loop;
  Real before = 0;
  for (int n = 0; n < steps; ++n) before = -contact.go(overlap, {far / steps, 0, 0}).friction[0];
  const Real top = before;
  for (const Real side : {-1.0, 1.0})
    for (int n = 1; n <= 2 * steps; ++n) {
      const Real way = far / steps, now = -contact.go(overlap, {side * way, 0, 0}).friction[0];
      loop.work += side * way * 0.5 * (before + now);
      before = now;
      const Real masing = -side * (share - 2 * share_of(0.5 * n * way / longest));
      loop.worst = std::max(loop.worst, std::abs(now / limit_of(overlap) - masing));
    }
  EXPECT_NEAR(before, top, 1e-9 * top);
  Real outer = 1;
  for (std::size_t band = 0; band < SlipBands<Real>::count; ++band) {
    const Real inner =
        band + 1 == SlipBands<Real>::count
            ? 0
            : contact.bands().inner * std::pow(SlipBands<Real>::growth, -static_cast<Real>(band)) / width_of(overlap);
    const Real limit = limit_of(overlap) * 0.5 * (outer * (3 - outer * outer) - inner * (3 - inner * inner));
    loop.of_sliders += 4 * limit * std::max(far - limit / (stiffness_of(overlap) * (outer - inner)), 0.0);
    outer = inner;
  }
  return loop;
}

/// Mindlin and Deresiewicz (1953): energy dissipated in a loop between +T and -T, T being a share of mu N.
Real loop_of_theory(Real overlap, Real share) {
  const Real rest = 1 - share, limit = limit_of(overlap);
  return 7.2 * limit * limit / stiffness_of(overlap) *
         (1 - std::pow(rest, 5.0 / 3) - 5.0 / 6 * share * (1 + std::pow(rest, 2.0 / 3)));
}

/// Bands lose a little more than the theory, since they slip at their mean limits. How much more hangs on how wide the outermost
/// is; below 0.1 mu N it may not slip at all.
TEST(slip_bands, unload_and_reload_as_mindlin_and_deresiewicz_have_it) {
  for (const auto& [share, off] : {std::pair{0.3, 0.25}, {0.5, 0.13}, {0.7, 0.07}, {0.9, 0.035}}) {
    Real mean = 0;
    for (const Real overlap : some_overlaps()) {
      const Loop loop = loop_of(overlap, share);
      EXPECT_LT(loop.worst, 3 * of_bands) << share;  // the curve at twice its size, from a top that is off by once
      EXPECT_NEAR(loop.work, loop.of_sliders, 5e-3 * loop_of_theory(overlap, share)) << share;  // of steps
      mean += loop.work / loop_of_theory(overlap, share) / static_cast<Real>(some_overlaps().size());
    }
    EXPECT_NEAR(mean, 1, off) << share;
  }
}

/// Springs that come in when the contact grows are not stretched, so pressing leaves the force as it is.
TEST(slip_bands, pressing_a_sheared_contact_leaves_its_force) {
  Sheared contact(constants(1, 1e9));
  contact.press(0.02 * deepest, 0.3 * deepest);
  const Real force = contact.go(0.3 * deepest, {1e-9, 0, 0}).friction[0],
             pressed = contact.press(0.3 * deepest, deepest).friction[0];
  EXPECT_LT(force, 0);
  EXPECT_NEAR(pressed, force, 1e-12 * std::abs(force));
}

/// The theory: a row of springs that stay where they are, each with its own limit.
class Springs {
public:
  explicit Springs(std::size_t count) : stretch_(count, Vector3::Zero()) {}

  /// Friction [N] and the energy of all [J].
  std::pair<Vector3, Real> go(Real overlap, const Vector3& way) {
    const Real width = width_of(overlap), apart = width_of(deepest) / static_cast<Real>(stretch_.size());
    const Real stiffness = constants().tangential * apart, load = 1.5 * limit_of(overlap) * apart / width;
    Vector3 force = Vector3::Zero();
    Real energy = 0;
    for (std::size_t n = 0; n < stretch_.size(); ++n) {
      Vector3& stretch = stretch_[n];
      const Real share = (static_cast<Real>(n) + 0.5) * apart / width, limit = load * (1 - share * share) / stiffness;
      if (!(limit > 0)) {
        stretch.setZero();
        continue;
      }
      stretch += way;
      if (stretch.norm() > limit) stretch *= limit / stretch.norm();
      force -= stiffness * stretch;
      energy += 0.5 * stiffness * stretch.squaredNorm();
    }
    return {force, energy};
  }

private:
  std::vector<Vector3> stretch_;
};

/// Pressed and sheared at once, to all sides: the bands stay near the theory, wherever the contact has been.
TEST(slip_bands, stay_near_the_theory_on_any_path) {
  const Real longest = 1.5 * limit_of(deepest) / stiffness_of(deepest);
  Real worst = 0, squares = 0, forces = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 engine(seed);
    const auto random = [&](Real from, Real to) { return std::uniform_real_distribution<Real>(from, to)(engine); };
    Sheared contact;
    Springs springs(2000);
    Real overlap = 0.02 * deepest;
    for (int move = 0; move < 30; ++move) {
      constexpr int steps = 100;
      const Real next = deepest * random(0.05, 1);
      const Vector3 way = longest / steps * Vector3(random(-1, 1), random(-1, 1), 0);
      const Real deeper = (next - overlap) / steps;
      for (int n = 0; n < steps; ++n) {
        overlap += deeper;
        const Vector3 ours = contact.go(overlap, way).friction, theirs = springs.go(overlap, way).first;
        worst = std::max(worst, (ours - theirs).norm() / limit_of(deepest));
        squares += (ours - theirs).squaredNorm();
        forces += theirs.squaredNorm();
      }
    }
  }
  EXPECT_LT(worst, 3 * of_bands);
  EXPECT_LT(std::sqrt(squares / forces), of_bands);
}

/// The force is the derivative of the energy where nothing slips.
TEST(slip_bands, force_is_the_slope_of_the_energy) {
  Sheared contact(constants(1, 1e9));
  contact.press(0.02 * deepest, deepest);
  const Real small = 1e-11;
  const auto less = contact.go(deepest, {1e-9 - small, 0, 0}), at = contact.go(deepest, {small, 0, 0}),
             more = contact.go(deepest, {small, 0, 0});
  EXPECT_NEAR(-at.friction[0], (more.sliding_energy - less.sliding_energy) / (2 * small), 1e-7 * std::abs(at.friction[0]));
}

/// A contact that becomes quite another in a step, and one that is wider by far than it was, begin anew.
TEST(slip_bands, begin_anew_where_nothing_is_left) {
  Sheared contact;
  contact.press(0.02 * deepest, deepest);
  contact.go(deepest, {1e-9, 0, 0});
  EXPECT_EQ(contact.go(1e-6 * deepest, Vector3::Zero()).friction[0], 0);
  EXPECT_EQ(contact.go(deepest, Vector3::Zero()).friction[0], 0);
}

TEST(slip_bands, in_lanes_compute_what_one_number_does) {
  const ContactConstants<Real> one_law = constants(0.7);
  ContactConstants<TwinLanes> law;
  law.normal = one_law.normal;
  law.tangential = one_law.tangential;
  law.normal_damping = one_law.normal_damping;
  law.tangential_damping = one_law.tangential_damping;
  law.friction = one_law.friction;
  constexpr int count = TwinLanes::count;
  std::vector<ContactMemory<Real>> memory(count);
  std::vector<SlipBands<Real>> bands(count);
  ContactMemory<TwinLanes> lane_memory;
  SlipBands<TwinLanes> lane_bands;
  std::mt19937 engine(3);
  std::uniform_real_distribution<Real> random(-1, 1);
  for (int n = 0; n < 200; ++n) {
    ContactMotion<TwinLanes> lanes{};
    std::vector<ContactForce<Real>> alone;
    for (int lane = 0; lane < count; ++lane) {
      ContactMotion<Real> at = touching(deepest * (0.6 + 0.5 * std::sin(0.02 * (lane + 1) * n)));
      at.velocity = {0.05 * random(engine), 0.05 * random(engine), 0.01 * random(engine)};
      lanes.overlap.set(lane, at.overlap);
      lanes.radius.product.set(lane, at.radius.product);
      lanes.radius.sum.set(lane, at.radius.sum);
      lanes.mass.product.set(lane, at.mass.product);
      lanes.mass.sum.set(lane, at.mass.sum);
      lanes.normal[2].set(lane, 1);
      for (int axis = 0; axis < 3; ++axis) lanes.velocity[axis].set(lane, at.velocity[axis]);
      lanes.step.set(lane, step);
      const auto l = static_cast<std::size_t>(lane);
      alone.push_back(contact_force<MindlinDeresiewicz, false>(one_law, at, memory[l], &bands[l]));
    }
    const auto together = contact_force<MindlinDeresiewicz, false>(law, lanes, lane_memory, &lane_bands);
    for (int lane = 0; lane < count; ++lane) {
      const ContactForce<Real>& one = alone[static_cast<std::size_t>(lane)];
      const Real scale = 1e-11 * (1e-3 * limit_of(deepest) + std::abs(one.normal));  // roots are not rounded alike
      EXPECT_NEAR(together.friction[0][lane], one.friction[0], scale);
      EXPECT_NEAR(together.friction[1][lane], one.friction[1], scale);
      EXPECT_NEAR(together.sliding_energy[lane], one.sliding_energy, scale * 1e-6);
    }
  }
}

}  // namespace
}  // namespace sazare::laws
