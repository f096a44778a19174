#include "sazare/methods/spheres/stepper/clump_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sazare::methods::spheres {

namespace {

/// A turn about one of the clump's own axes comes before its turn.
void turn_about(state::Clump& clump, int axis, Real time) {
  const Vector3 own = clump.into(clump.angular_momentum);
  const Real half = 0.5 * time * own[axis] / clump.inertia[axis], cosine = std::cos(half), sine = std::sin(half);
  const Turn<Real> old = clump.turn;
  if (axis == 0)
    clump.turn = {cosine * old.w - sine * old.x, cosine * old.x + sine * old.w, cosine * old.y + sine * old.z,
                  cosine * old.z - sine * old.y};
  else if (axis == 1)
    clump.turn = {cosine * old.w - sine * old.y, cosine * old.x - sine * old.z, cosine * old.y + sine * old.w,
                  cosine * old.z + sine * old.x};
  else
    clump.turn = {cosine * old.w - sine * old.z, cosine * old.x + sine * old.y, cosine * old.y - sine * old.x,
                  cosine * old.z + sine * old.w};
}

Vector3 momentum_at_its_time(const state::Clump& clump) { return clump.angular_momentum + clump.turning_ahead; }

}  // namespace

ClumpImpulse gather(state::Clump& clump, std::span<const state::ClumpMember> members, std::span<const TimedTable> loads,
                    const SphereFlight& flight, std::span<const Index> place) {
  const Vector3 fall = flight.step * clump.mass * flight.gravity;
  ClumpImpulse given{.linear = fall};
  clump.impulse_ahead = 0.5 * fall;
  clump.turning_ahead = Vector3::Zero();
  for (const TimedTable& level : loads) {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    for (const state::ClumpMember& member : members) {
      const state::SphereLoad& load = level.loads->of(static_cast<std::size_t>(place[static_cast<std::size_t>(member.sphere)]));
      const Vector3 push{load.fx, load.fy, load.fz};
      force = force + push;
      moment = moment + Vector3{load.mx, load.my, load.mz} + cross(clump.out(member.place), push);
    }
    given.linear = given.linear + level.given * force;
    given.turning = given.turning + level.given * moment;
    clump.impulse_ahead = clump.impulse_ahead + level.predicted * force;
    clump.turning_ahead = clump.turning_ahead + level.predicted * moment;
  }
  return given;
}

void kick(state::Clump& clump, const ClumpImpulse& impulse) {
  clump.velocity = clump.velocity + 1 / clump.moved_mass() * impulse.linear;
  clump.angular_momentum = clump.angular_momentum + impulse.turning;
}

void drift(state::Clump& clump, Real step) {
  clump.centre = clump.centre + step * clump.velocity;
  for (const auto& [axis, share] : {std::pair(0, 0.5), {1, 0.5}, {2, 1.0}, {1, 0.5}, {0, 0.5}})
    turn_about(clump, axis, share * step);
  Turn<Real>& turn = clump.turn;
  const Real shrink = 1 / std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  turn = {shrink * turn.w, shrink * turn.x, shrink * turn.y, shrink * turn.z};
}

void place_members(const state::Clump& clump, std::span<const state::ClumpMember> members, std::span<const Index> place,
                   state::Spheres& spheres) {
  const Vector3 spin = clump.spin_of(momentum_at_its_time(clump)), moves = velocity(clump);
  for (const state::ClumpMember& member : members) {
    const auto i = static_cast<std::size_t>(place[static_cast<std::size_t>(member.sphere)]);
    const Vector3 arm = clump.out(member.place), centre = clump.centre + arm, at = moves + cross(spin, arm);
    state::SpherePlace& sphere = spheres.place[i];
    sphere = {centre[0], centre[1], centre[2], sphere.radius, at[0], at[1], at[2], sphere.mass};
    spheres.spin[i] = {spin[0], spin[1], spin[2], spheres.spin[i].material};
  }
}

Real turning_speed(const state::Clump& clump, std::span<const state::ClumpMember> members) {
  constexpr Real rounded_up = 1.01;  // the spin changes a little within a step
  Real reach = 0;
  for (const state::ClumpMember& member : members) reach = std::max(reach, dot(member.place, member.place));
  const Vector3 spin = clump.spin_of(clump.angular_momentum);
  return rounded_up * std::sqrt(reach * dot(spin, spin));
}

Vector3 velocity(const state::Clump& clump) { return clump.velocity + 1 / clump.moved_mass() * clump.impulse_ahead; }

ClumpEnergies energies(const state::Clump& clump, const Vector3& gravity) {
  const Vector3 momentum = momentum_at_its_time(clump);
  return {0.5 * clump.mass * velocity(clump).squaredNorm(), 0.5 * dot(momentum, clump.spin_of(momentum)),
          -clump.mass * gravity.dot(clump.centre)};
}

Vector3 angular_momentum(const state::Clump& clump) {
  return clump.mass * clump.centre.cross(velocity(clump)) + momentum_at_its_time(clump);
}

}  // namespace sazare::methods::spheres
