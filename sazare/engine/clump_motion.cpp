#include "sazare/engine/clump_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sazare::engine {

namespace {

/// A turn about one of the clump's own axes comes before its turn.
void turn_about(state::Clump& clump, int axis, Real time) {
  const Triple<Real> own = clump.into(clump.angular_momentum);
  const Real momentum = axis == 0 ? own.x : axis == 1 ? own.y : own.z;
  const Real inertia = axis == 0 ? clump.inertia.x : axis == 1 ? clump.inertia.y : clump.inertia.z;
  const Real half = 0.5 * time * momentum / inertia, cosine = std::cos(half), sine = std::sin(half);
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

Triple<Real> momentum_at(const state::Clump& clump, Real step) { return clump.angular_momentum + 0.5 * step * clump.moment; }

}  // namespace

void gather_loads(state::Clumps& clumps, std::size_t clump, const methods::spheres::LoadTable& loads,
                  std::span<const Index> place) {
  state::Clump& body = clumps.clumps[clump];
  body.force = body.moment = {};
  for (std::size_t m = clumps.begin_of(clump); m < clumps.end_of(clump); ++m) {
    const state::ClumpMember& member = clumps.members[m];
    const state::SphereLoad& load = loads.of(static_cast<std::size_t>(place[static_cast<std::size_t>(member.sphere)]));
    const Triple<Real> force{load.fx, load.fy, load.fz};
    body.force = body.force + force;
    body.moment = body.moment + Triple<Real>{load.mx, load.my, load.mz} + cross(body.out(member.place), force);
  }
}

void kick(state::Clump& clump, const Vector3& gravity, Real time) {
  clump.velocity = clump.velocity + time * (1 / clump.mass * clump.force + triple(gravity));
  clump.angular_momentum = clump.angular_momentum + time * clump.moment;
}

void drift(state::Clump& clump, Real step) {
  clump.centre = clump.centre + step * clump.velocity;
  for (const auto& [axis, share] : {std::pair(0, 0.5), {1, 0.5}, {2, 1.0}, {1, 0.5}, {0, 0.5}})
    turn_about(clump, axis, share * step);
  Turn<Real>& turn = clump.turn;
  const Real shrink = 1 / std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  turn = {shrink * turn.w, shrink * turn.x, shrink * turn.y, shrink * turn.z};
}

void place_members(const state::Clumps& clumps, std::size_t clump, const Vector3& gravity, Real step,
                   std::span<const Index> place, state::Spheres& spheres) {
  const state::Clump& body = clumps.clumps[clump];
  const Triple<Real> spin = body.spin_of(momentum_at(body, step)), moves = triple(velocity(body, gravity, step));
  for (std::size_t m = clumps.begin_of(clump); m < clumps.end_of(clump); ++m) {
    const state::ClumpMember& member = clumps.members[m];
    const auto i = static_cast<std::size_t>(place[static_cast<std::size_t>(member.sphere)]);
    const Triple<Real> arm = body.out(member.place), centre = body.centre + arm, at = moves + cross(spin, arm);
    state::SpherePlace& sphere = spheres.place[i];
    sphere = {centre.x, centre.y, centre.z, sphere.radius, at.x, at.y, at.z, sphere.mass};
    spheres.spin[i] = {spin.x, spin.y, spin.z, spheres.spin[i].material};
  }
}

Real turning_speed(const state::Clumps& clumps, std::size_t clump) {
  constexpr Real rounded_up = 1.01;  // the spin changes a little within a step
  const state::Clump& body = clumps.clumps[clump];
  Real reach = 0;
  for (std::size_t m = clumps.begin_of(clump); m < clumps.end_of(clump); ++m)
    reach = std::max(reach, dot(clumps.members[m].place, clumps.members[m].place));
  const Triple<Real> spin = body.spin_of(body.angular_momentum);
  return rounded_up * std::sqrt(reach * dot(spin, spin));
}

Vector3 velocity(const state::Clump& clump, const Vector3& gravity, Real step) {
  return vector(clump.velocity) + 0.5 * step * (vector(clump.force) / clump.mass + gravity);
}

ClumpEnergies energies(const state::Clump& clump, const Vector3& gravity, Real step) {
  const Triple<Real> momentum = momentum_at(clump, step);
  return {0.5 * clump.mass * velocity(clump, gravity, step).squaredNorm(), 0.5 * dot(momentum, clump.spin_of(momentum)),
          -clump.mass * gravity.dot(vector(clump.centre))};
}

Vector3 angular_momentum(const state::Clump& clump, const Vector3& gravity, Real step) {
  return clump.mass * vector(clump.centre).cross(velocity(clump, gravity, step)) + vector(momentum_at(clump, step));
}

}  // namespace sazare::engine
