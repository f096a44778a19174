#include "sazare/engine/sphere_motion.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "sazare/core/lane_math.hpp"

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

Real square_of(const Quad& vector) {
  const Quad squares = vector * vector;
  return squares[0] + squares[1] + squares[2];
}

/// The largest speeds of spheres that come one after the other, compared in lanes: each would wait for the one before.
class LargestSpeeds {
public:
  void take(const Quad& from_drift, const Quad& velocity) {
    from_drift_[now_] = square_of(from_drift);
    squares_[now_] = square_of(velocity);
    if (++now_ == lane_count) compare();
  }

  SphereSpeeds speeds() {
    for (; now_ > 0 && now_ < lane_count; ++now_) from_drift_[now_] = squares_[now_] = 0;
    if (now_ > 0) compare();
    SphereSpeeds all;
    for (int lane = 0; lane < lane_count; ++lane)
      all.take({std::sqrt(first_[lane]), std::sqrt(second_[lane]), std::sqrt(largest_[lane])});
    for (int lane = 0; lane < lane_count; ++lane)
      if (!(sum_[lane] <= std::numeric_limits<Real>::max())) all.first = sum_[lane];
    return all;
  }

private:
  void compare() {
    const Lanes from_drift = load_lanes(from_drift_.data());
    second_ = maximum(second_, Lanes(from_drift < first_ ? from_drift : first_));
    first_ = maximum(first_, from_drift);
    largest_ = maximum(largest_, load_lanes(squares_.data()));
    sum_ += from_drift;
    now_ = 0;
  }

  std::array<Real, lane_count> from_drift_, squares_;  // of those that are to be compared next
  int now_ = 0;
  Lanes first_{}, second_{}, largest_{};
  Lanes sum_{};  // tells what is no number, which comparisons lose
};

/// What loads give a sphere in a kick, and what is foreseen besides for its next time.
struct Impulses {
  Quad force, force_ahead, moment, moment_ahead;
};

/// `impulses(i)` are those of the sphere at place i.
template <class ImpulsesOn>
SphereSpeeds fly(state::Spheres& spheres, std::size_t begin, std::size_t end, const SphereFlight& flight,
                 const ImpulsesOn& impulses) {
  const Real half = 0.5 * flight.step;
  const Quad falls = quad(flight.gravity), drifts = quad(flight.drift);
  LargestSpeeds speeds;
  for (std::size_t i = begin; i < end; ++i) {
    state::SphereKick& kick = spheres.kick[i];
    state::SpherePlace& place = spheres.place[i];
    state::SphereSpin& spin = spheres.spin[i];
    const Impulses given = impulses(i);
    // The further number of a load and of gravity is 0, so those of the velocities stay what they are.
    Quad moves = read(kick.vx), turns = read(kick.wx);
    const Quad gravity = moves[3] > 0 ? falls : Quad{};
    const Quad ahead = moves[3] * given.force_ahead + half * gravity, turning_ahead = turns[3] * given.moment_ahead;
    moves += moves[3] * given.force + flight.step * gravity;
    turns += turns[3] * given.moment;
    write(kick.vx, moves);
    write(kick.wx, turns);
    write(place.x, read(place.x) + with_number_of(Quad{}, flight.step * moves));
    write(place.vx, with_number_of(read(place.vx), moves + ahead));
    write(spin.x, with_number_of(read(spin.x), turns + turning_ahead));
    speeds.take(moves - drifts, moves);
  }
  return speeds.speeds();
}

}  // namespace

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, const state::SphereLoad* loads,
                            const SphereFlight& flight) {
  return fly(spheres, begin, end, flight, [&](std::size_t i) {
    const Quad force = read(loads[i - begin].fx), moment = read(loads[i - begin].mx);
    const Real step = flight.step, half = 0.5 * step;
    return Impulses{step * force, half * force, step * moment, half * moment};
  });
}

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, std::span<const TimedLoads> loads,
                            const SphereFlight& flight) {
  return fly(spheres, begin, end, flight, [&](std::size_t i) {
    Impulses all{};
    for (const TimedLoads& level : loads) {
      const Quad force = read(level.loads[i - begin].fx), moment = read(level.loads[i - begin].mx);
      all.force += level.given * force;
      all.force_ahead += level.foreseen * force;
      all.moment += level.given * moment;
      all.moment_ahead += level.foreseen * moment;
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
  Real work = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const state::SphereKick& kick = spheres.kick[i];
    const state::SphereLoad& load = loads[i - begin];
    if (kick.inverse_mass > 0) continue;
    work -= step * (load.fx * kick.vx + load.fy * kick.vy + load.fz * kick.vz + load.mx * kick.wx + load.my * kick.wy +
                    load.mz * kick.wz);
  }
  return work;
}

}  // namespace sazare::engine
