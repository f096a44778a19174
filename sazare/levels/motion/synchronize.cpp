#include "sazare/levels/motion/synchronize.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sazare/core/lane_records.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::motion {

namespace {

template <int D>
void find_momentum(const state::Bodies<D>& bodies, std::size_t body, state::Impulse<D> given, const state::Pose<D>& pose,
                   Vector<D>& velocity, Angular<D>& angular_momentum) {
  const auto& motion = bodies.motion[body];
  given = given.about(pose.position - bodies.pole);
  clear_locked(given, bodies.locks[body]);
  velocity = motion.velocity + given.linear_lead / bodies.inertia[body].mass;
  angular_momentum = motion.angular_momentum + given.angular_lead;
}

template <int D>
void find_energy(const state::Bodies<D>& bodies, std::size_t body, const state::Pose<D>& pose, const Vector<D>& velocity,
                 const Angular<D>& angular_momentum, Real& energy, state::MeanMotion<D>& ahead) {
  const auto& motion = bodies.motion[body];
  const auto& inertia = bodies.inertia[body];
  const state::Locks locks = bodies.locks[body];
  const Angular<D> mean_momentum = 0.5 * (motion.angular_momentum + angular_momentum);
  const state::MeanMotion<D> mean{0.5 * (motion.velocity + velocity), spin_of(pose.rotation, inertia, locks, mean_momentum)};
  ahead = mean.at(bodies.pole - pose.position);
  energy = kinetic_energy<D>(pose.rotation, inertia, locks, velocity, angular_momentum);
}

/// Records side by side, one in each lane; where they are too few, idle lanes repeat the last.
template <class Record>
LanePointers<Record> in_lanes(std::span<Record> records) {
  LanePointers<Record> lanes;
  for (std::size_t lane = 0; lane < lane_count; ++lane) lanes[lane] = &records[std::min(lane, records.size() - 1)];
  return lanes;
}

LaneVector load_some(std::span<const Vector3> vectors) {
  if (vectors.size() >= lane_count) return load_vectors(vectors.data());
  std::array<Vector3, lane_count> all;
  for (std::size_t lane = 0; lane < lane_count; ++lane) all[lane] = vectors[std::min(lane, vectors.size() - 1)];
  return load_vectors(all.data());
}

void store_some(const LaneVector& lanes, std::span<Vector3> vectors) {
  if (vectors.size() >= lane_count) return store_vectors(lanes, vectors.data());
  std::array<Vector3, lane_count> all;
  store_vectors(lanes, all.data());
  std::copy_n(all.begin(), vectors.size(), vectors.begin());
}

/// Finds the momenta of at most as many bodies as there are lanes.
[[gnu::flatten]] void find_some_momenta(const state::Bodies<3>& bodies, std::size_t first,
                                        std::span<const state::Impulse<3>> given, const MotionFound<3>& now) {
  const auto motions = in_lanes(std::span(bodies.motion).subspan(first, given.size()));
  const auto inertias = in_lanes(std::span(bodies.inertia).subspan(first, given.size()));
  const auto impulses = in_lanes(given);
  std::uint64_t translations = 0, rotations = 0;  // a byte each
  for (std::size_t lane = 0; lane < given.size(); ++lane) {
    translations |= std::uint64_t{bodies.locks[first + lane].translation} << 8 * lane;
    rotations |= std::uint64_t{bodies.locks[first + lane].rotation} << 8 * lane;
  }
  const auto v = load_quad(motions, 18), l = load_quad(motions, 20), p = load_quad(in_lanes(now.pose), 0);
  const auto lead = load_quad(impulses, 8), last = load_quad(impulses, 12);
  const LaneVector linear{{lead[0], lead[1], lead[2]}}, about_pole{{lead[3], last[0], last[1]}};
  const LaneVector centre = LaneVector{{p[0], p[1], p[2]}} - broadcast(bodies.pole);
  const LaneVector angular = state::without(spread_bytes(rotations), add_cross(linear, centre, about_pole));
  const Lanes inverse_mass = 1.0 / load_quad(inertias, 4)[3];
  const LaneVector velocity{{v[0], v[1], v[2]}}, momentum{{l[1], l[2], l[3]}};
  store_some(velocity + inverse_mass * state::without(spread_bytes(translations), linear), now.velocity);
  store_some(momentum + angular, now.angular_momentum);
}

/// Finds the energies of at most as many bodies as there are lanes; they do not hold where rotations are locked.
[[gnu::flatten]] void find_some_energies(const state::Bodies<3>& bodies, std::size_t first, const MotionSeen<3>& now,
                                         std::span<Real> energy, std::span<state::MeanMotion<3>> ahead) {
  const auto motions = in_lanes(std::span(bodies.motion).subspan(first, energy.size()));
  const auto v = load_quad(motions, 18), l = load_quad(motions, 20);
  const auto i = load_quad(in_lanes(std::span(bodies.inertia).subspan(first, energy.size())), 4);
  const auto [position, rotation] = state::load_places(in_lanes(now.pose));
  const LaneVector velocity = load_some(now.velocity), velocity_before{{v[0], v[1], v[2]}}, momentum_before{{l[1], l[2], l[3]}};
  const auto spin_of = [&](const LaneVector& own) { return LaneVector{{own[0] * i[0], own[1] * i[1], own[2] * i[2]}}; };
  const Lanes half = broadcast(0.5);
  const LaneVector own = transposed(rotation, load_some(now.angular_momentum)),
                   own_before = transposed(rotation, momentum_before);
  const LaneVector spin = rotation * spin_of(half * (own_before + own));
  const LaneVector at_pole = add_cross(spin, broadcast(bodies.pole) - position, half * (velocity_before + velocity));
  const auto to = in_lanes(ahead);
  store_quad({at_pole[0], at_pole[1], at_pole[2], spin[0]}, to, 0);
  store_quad({spin[1], spin[2], Lanes{}, Lanes{}}, to, 4);
  const Lanes found = half * (i[3] * dot(velocity, velocity) + dot(own, spin_of(own)));
  for (std::size_t lane = 0; lane < energy.size(); ++lane) energy[lane] = found[static_cast<int>(lane)];
}

/// Calls f(begin, size) for batches of as many as there are lanes, the last one shorter.
template <class F>
void in_batches(std::size_t count, F&& f) {
  for (std::size_t begin = 0; begin < count; begin += lane_count) f(begin, std::min<std::size_t>(lane_count, count - begin));
}

}  // namespace

void find_momenta(const state::Bodies<3>& bodies, std::size_t first, std::span<const state::Impulse<3>> given,
                  const MotionFound<3>& now) {
  in_batches(given.size(), [&](std::size_t begin, std::size_t size) {
    const auto some = [&](auto span) { return span.subspan(begin, size); };
    find_some_momenta(bodies, first + begin, some(given), {some(now.pose), some(now.velocity), some(now.angular_momentum)});
  });
}

void find_momenta(const state::Bodies<2>& bodies, std::size_t first, std::span<const state::Impulse<2>> given,
                  const MotionFound<2>& now) {
  for (std::size_t i = 0; i < given.size(); ++i)
    find_momentum(bodies, first + i, given[i], now.pose[i], now.velocity[i], now.angular_momentum[i]);
}

void find_energies(const state::Bodies<3>& bodies, std::size_t first, const MotionSeen<3>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<3>> ahead) {
  in_batches(energy.size(), [&](std::size_t begin, std::size_t size) {
    const auto some = [&](auto span) { return span.subspan(begin, size); };
    find_some_energies(bodies, first + begin, {some(now.pose), some(now.velocity), some(now.angular_momentum)}, some(energy),
                       some(ahead));
  });
  for (std::size_t i = 0; i < energy.size(); ++i)
    if (bodies.locks[first + i].rotation != 0)
      find_energy(bodies, first + i, now.pose[i], now.velocity[i], now.angular_momentum[i], energy[i], ahead[i]);
}

void find_energies(const state::Bodies<2>& bodies, std::size_t first, const MotionSeen<2>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<2>> ahead) {
  for (std::size_t i = 0; i < energy.size(); ++i)
    find_energy(bodies, first + i, now.pose[i], now.velocity[i], now.angular_momentum[i], energy[i], ahead[i]);
}

}  // namespace sazare::motion
