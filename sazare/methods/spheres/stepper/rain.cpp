/// Spheres and clumps that fall until they rest, while all others, and the walls, stand still.

#include <cmath>
#include <utility>

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr std::int64_t steps_between_looks = 64;

void stop(state::SphereKick& kick) { kick.vx = kick.vy = kick.vz = kick.wx = kick.wy = kick.wz = 0; }

/// The clumps of which all spheres are marked, by number.
state::Clumps clumps_of(const state::Clumps& all, const std::vector<std::uint8_t>& marked) {
  state::Clumps some;
  for (std::size_t c = 0; c < all.clumps.size(); ++c) {
    if (marked[static_cast<std::size_t>(all.members[all.begin_of(c)].sphere)] == 0) continue;
    some.clumps.push_back(all.clumps[c]);
    some.clumps.back().first_member = static_cast<std::int64_t>(some.members.size());
    some.members.insert(some.members.end(), all.members.begin() + static_cast<std::ptrdiff_t>(all.begin_of(c)),
                        all.members.begin() + static_cast<std::ptrdiff_t>(all.end_of(c)));
  }
  return some;
}

}  // namespace

RainEnd SphereStepper::rain(const RainRules& rules) {
  std::vector<state::SphereKick> kicks(spheres_.size());
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const auto number = static_cast<std::size_t>(spheres_.number[i]);
    kicks[number] = spheres_.kick[i];
    if (rules.rains[number] != 0) continue;
    spheres_.kick[i] = {};
    spheres_.set_motion(i, Vector3::Zero(), Vector3::Zero());
  }
  state::Clumps all = std::exchange(clumps_, clumps_of(clumps_, rules.rains));
  const bool drove = std::exchange(drives_, false);
  walls_.stand_still(true);
  water_.stand_still(true);
  start();
  const Real kept = std::exp(-rules.damping * rules_.step);
  RainEnd end{0, unrest(), true};
  while (end.unrest > 1 && end.steps < rules.most_steps && end.goes_on) {
    advance();
    step_ = 0;  // it rains before the beginning
    slow(kept);
    if (++end.steps % steps_between_looks != 0) continue;
    end.unrest = unrest();
    end.goes_on = rules.goes_on(end.steps, end.unrest);
  }
  walls_.stand_still(false);
  water_.stand_still(false);
  drives_ = drove;
  if (ranks_ != nullptr) clump_border_->share_for_good(clumps_);
  for (std::size_t c = 0, rained = 0; c < all.clumps.size(); ++c) {
    if (rules.rains[static_cast<std::size_t>(all.members[all.begin_of(c)].sphere)] == 0) continue;
    const std::int64_t first = all.clumps[c].first_member;
    all.clumps[c] = clumps_.clumps[rained++];
    all.clumps[c].first_member = first;
    all.clumps[c].velocity = all.clumps[c].angular_momentum = Vector3::Zero();
    all.clumps[c].impulse_ahead = all.clumps[c].turning_ahead = Vector3::Zero();
  }
  clumps_ = std::move(all);
  visit_known([&](std::size_t i) {
    state::SphereKick& kick = spheres_.kick[i];
    const auto number = static_cast<std::size_t>(spheres_.number[i]);
    kick = kicks[number];
    if (rules.rains[number] != 0) stop(kick);
    spheres_.set_motion(i, {kick.vx, kick.vy, kick.vz}, {kick.wx, kick.wy, kick.wz});
  });
  evaluated_ = false;
  return end;
}

/// All that moves keeps this share of its velocity.
void SphereStepper::slow(Real kept) {
  visit_known([&](std::size_t i) {
    state::SphereKick& kick = spheres_.kick[i];
    state::SpherePlace& place = spheres_.place[i];
    state::SphereSpin& spin = spheres_.spin[i];
    for (Real* part :
         {&kick.vx, &kick.vy, &kick.vz, &kick.wx, &kick.wy, &kick.wz, &place.vx, &place.vy, &place.vz, &spin.x, &spin.y, &spin.z})
      *part *= kept;
  });
  for (state::Clump& clump : clumps_.clumps) {
    clump.velocity = kept * clump.velocity;
    clump.angular_momentum = kept * clump.angular_momentum;
  }
}

void SphereStepper::add_unrest(std::size_t sphere, UnrestSums& sums) const {
  const state::SpherePlace& place = spheres_.place[sphere];
  sums.radius += place.radius;
  if (!(spheres_.kick[sphere].inverse_mass > 0)) return;
  sums.mass += place.mass;
  sums.square_forces += place.mass * acceleration(sphere).squaredNorm();
}

void SphereStepper::add_unrest_of_clump(std::size_t clump, UnrestSums& sums) const {
  const Real mass = clumps_.clumps[clump].mass;
  Vector3 force = mass * rules_.gravity;
  for (const auto& member : clumps_.members_of(clump)) {
    const state::SphereLoad load = this->load(static_cast<std::size_t>(place_[static_cast<std::size_t>(member.sphere)]));
    force += Vector3(load.fx, load.fy, load.fz);
  }
  sums.mass += mass;
  sums.square_forces += force.squaredNorm() / mass;
}

/// How far the body is from rest; 1 or less where it rests. Kinetic energy is compared with what lifts all by a millionth of the
/// mean radius, the mean acceleration, which does not forget what has just begun to fall, with a hundredth of gravity.
Real SphereStepper::unrest() {
  constexpr Real lifted_by = 1e-6, of_gravity = 1e-2;
  evaluate_now();
  auto all = sum_own<UnrestSums>([this](std::size_t i, UnrestSums& part) { add_unrest(i, part); });
  MotionEnergies motion = motion_energies();
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    if (owns_clump(c)) add_unrest_of_clump(c, all);
  if (ranks_ != nullptr) {
    all = ranks_->sum(all);
    motion = ranks_->sum(motion);
  }
  const Real mass = all.mass.value(), radius = all.radius.value() / static_cast<Real>(spheres_.size());
  const Real gravity = rules_.gravity.norm();
  return std::max((motion.translation.value() + motion.rotation.value()) / (lifted_by * mass * gravity * radius),
                  std::sqrt(all.square_forces.value() / mass) / (of_gravity * gravity));
}

}  // namespace sazare::methods::spheres
