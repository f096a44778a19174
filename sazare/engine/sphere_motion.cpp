#include "sazare/engine/sphere_motion.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/triple.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::engine {

namespace {

/// Half a record: three parts of a vector and one number more.
using Quad = Real __attribute__((vector_size(32)));

Quad read(const Real& from) {
  Quad quad;
  std::memcpy(&quad, &from, sizeof(Quad));
  return quad;
}

void write(Real& to, const Quad& quad) { std::memcpy(&to, &quad, sizeof(Quad)); }

Quad quad(const Vector3& vector) { return Quad{vector.x(), vector.y(), vector.z(), 0}; }

/// The vector of one record with the further number of another.
Quad with_number_of(const Quad& other, const Quad& vector) { return __builtin_shufflevector(vector, other, 0, 1, 2, 7); }

/// The largest speeds of spheres, compared in lanes: one by one each would wait for the one before.
class LargestSpeeds {
public:
  explicit LargestSpeeds(const Vector3& drift) : drift_{broadcast(drift.x()), broadcast(drift.y()), broadcast(drift.z())} {}

  /// Of `count` spheres that stand one after the other, as many as there are lanes at most.
  void take(const state::SphereKick* kicks, std::size_t count) {
    std::array<const Real*, lane_count> from;
    for (std::size_t lane = 0; lane < lane_count; ++lane) from[lane] = &kicks[lane < count ? lane : 0].vx;
    const auto kick = load_quads(from);
    const Triple<Lanes> velocity{kick[0], kick[1], kick[2]}, from_drift = velocity - drift_;
    Lanes seen = dot(from_drift, from_drift), square = dot(velocity, velocity);
    for (std::size_t lane = count; lane < lane_count; ++lane) seen[lane] = square[lane] = 0;
    second_ = maximum(second_, Lanes(seen < first_ ? seen : first_));
    first_ = maximum(first_, seen);
    largest_ = maximum(largest_, square);
    sum_ += seen;
  }

  SphereSpeeds speeds() const {
    SphereSpeeds all;  // of squares, until roots are taken of the three that are left
    for (int lane = 0; lane < lane_count; ++lane) all.take({first_[lane], second_[lane], largest_[lane]});
    all = {std::sqrt(all.first), std::sqrt(all.second), std::sqrt(all.largest)};
    for (int lane = 0; lane < lane_count; ++lane)
      if (!(sum_[lane] <= std::numeric_limits<Real>::max())) all.first = sum_[lane];
    return all;
  }

private:
  Triple<Lanes> drift_;
  Lanes first_{}, second_{}, largest_{};
  Lanes sum_{};  // tells what is no number, which comparisons lose
};

/// What loads give a sphere in a kick, and what is foreseen besides for its next time.
struct Impulses {
  Quad force, force_ahead, moment, moment_ahead;
};

/// A sphere's next velocities and place.
void fly(state::SphereKick& kick, state::SpherePlace& place, state::SphereSpin& spin, const Impulses& given, const Quad& falls,
         Real step) {
  // The further number of a load and of gravity is 0, so those of the velocities stay what they are.
  Quad moves = read(kick.vx), turns = read(kick.wx);
  const Real inverse_mass = kick.inverse_mass, inverse_inertia = kick.inverse_inertia;
  const Quad gravity = inverse_mass > 0 ? step * falls : Quad{};
  moves += inverse_mass * given.force + gravity;
  turns += inverse_inertia * given.moment;
  write(kick.vx, moves);
  write(kick.wx, turns);
  write(place.x, read(place.x) + with_number_of(Quad{}, step * moves));
  write(place.vx, with_number_of(read(place.vx), moves + (inverse_mass * given.force_ahead + 0.5 * gravity)));
  write(spin.x, with_number_of(read(spin.x), turns + inverse_inertia * given.moment_ahead));
}

/// `impulses(i)` are those of the sphere at place i.
template <class ImpulsesOn>
SphereSpeeds fly(state::Spheres& spheres, std::size_t begin, std::size_t end, const SphereFlight& flight, ImpulsesOn impulses) {
  const Quad falls = quad(flight.gravity);
  const Real step = flight.step;
  state::SphereKick* const kicks = spheres.kick.data();
  state::SpherePlace* const places = spheres.place.data();
  state::SphereSpin* const spins = spheres.spin.data();
  LargestSpeeds speeds(flight.drift);
  for (std::size_t first = begin; first < end; first += lane_count) {
    const std::size_t last = std::min<std::size_t>(first + lane_count, end);
    for (std::size_t i = first; i < last; ++i) fly(kicks[i], places[i], spins[i], impulses(i), falls, step);
    speeds.take(&kicks[first], last - first);
  }
  return speeds.speeds();
}

}  // namespace

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, state::SphereLoad* loads,
                            const SphereFlight& flight) {
  return fly(spheres, begin, end, flight, [=, step = flight.step, half = 0.5 * flight.step](std::size_t i) {
    state::SphereLoad& load = loads[i - begin];
    const Quad force = read(load.fx), moment = read(load.mx);
    load = {};
    return Impulses{step * force, half * force, step * moment, half * moment};
  });
}

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, std::span<const TimedLoads> loads,
                            const SphereFlight& flight) {
  const auto by_level = [=](const TimedLoads& level, std::size_t i) {
    const Quad force = read(level.loads[i - begin].fx), moment = read(level.loads[i - begin].mx);
    return Impulses{level.given * force, level.foreseen * force, level.given * moment, level.foreseen * moment};
  };
  return fly(spheres, begin, end, flight, [&](std::size_t i) {
    Impulses all = by_level(loads.front(), i);
    for (const TimedLoads& level : loads.subspan(1)) {
      const Impulses more = by_level(level, i);
      all.force += more.force;
      all.force_ahead += more.force_ahead;
      all.moment += more.moment;
      all.moment_ahead += more.moment_ahead;
    }
    return all;
  });
}

void turn(state::Spheres& spheres, std::size_t begin, std::size_t end, Real step) {
  const Real half = 0.5 * step;
  for (std::size_t i = begin; i < end; ++i) {
    const state::SphereKick& kick = spheres.kick[i];
    state::SphereTurn& turn = spheres.turn[i];
    const Real x = half * kick.wx, y = half * kick.wy, z = half * kick.wz;
    const state::SphereTurn old = turn;
    turn = {old.w - x * old.x - y * old.y - z * old.z, old.x + x * old.w + y * old.z - z * old.y,
            old.y + y * old.w + z * old.x - x * old.z, old.z + z * old.w + x * old.y - y * old.x};
    const Real shrink = 1 / std::sqrt(turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    turn = {shrink * turn.w, shrink * turn.x, shrink * turn.y, shrink * turn.z};
  }
}

Real work_of_driven(const state::Spheres& spheres, std::size_t begin, std::size_t end, const state::SphereLoad* loads,
                    Real step) {
  constexpr std::size_t together = methods::spheres::LoadTable::together;
  Real work = 0;
  for (std::size_t first = begin; first < end; first += together) {
    Real of_some = 0;
    for (std::size_t i = first; i < std::min(first + together, end); ++i) {
      const state::SphereKick& kick = spheres.kick[i];
      const state::SphereLoad& load = loads[i - begin];
      if (kick.inverse_mass > 0) continue;
      of_some -= step * (load.fx * kick.vx + load.fy * kick.vy + load.fz * kick.vz + load.mx * kick.wx + load.my * kick.wy +
                         load.mz * kick.wz);
    }
    work += of_some;
  }
  return work;
}

}  // namespace sazare::engine
