#include "sazare/engine/sphere_motion.hpp"

#include <cmath>
#include <cstring>

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

}  // namespace

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, const state::SphereLoad* loads,
                            const Vector3& gravity, const Vector3& drift, Real step) {
  const Real half = 0.5 * step;
  const Quad falls = quad(gravity), drifts = quad(drift);
  Real first = 0, second = 0, largest = 0;
  for (std::size_t i = begin; i < end; ++i) {
    state::SphereKick& kick = spheres.kick[i];
    state::SpherePlace& place = spheres.place[i];
    state::SphereSpin& spin = spheres.spin[i];
    const state::SphereLoad& load = loads[i - begin];
    // The further number of a load and of gravity is 0, so those of the velocities stay what they are.
    Quad moves = read(kick.vx), turns = read(kick.wx);
    const Quad acceleration = moves[3] * read(load.fx) + (moves[3] > 0 ? falls : Quad{});
    const Quad angular = turns[3] * read(load.mx);
    moves += step * acceleration;
    turns += step * angular;
    write(kick.vx, moves);
    write(kick.wx, turns);
    const Quad centre = read(place.x), far = step * moves;
    write(place.x, centre + with_number_of(Quad{}, far));
    write(place.vx, with_number_of(read(place.vx), moves + half * acceleration));
    write(spin.x, with_number_of(read(spin.x), turns + half * angular));
    const Real square = square_of(moves - drifts);
    second = std::max(second, std::min(first, square));
    first = square <= first ? first : square;  // what is no number stays
    largest = std::max(largest, square_of(moves));
  }
  return {std::sqrt(first), std::sqrt(second), std::sqrt(largest)};
}

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, std::span<const TimedLoads> loads,
                            const SphereFlight& flight) {
  const Real half = 0.5 * flight.step;
  const Quad falls = quad(flight.gravity), drifts = quad(flight.drift);
  Real first = 0, second = 0, largest = 0;
  for (std::size_t i = begin; i < end; ++i) {
    state::SphereKick& kick = spheres.kick[i];
    state::SpherePlace& place = spheres.place[i];
    state::SphereSpin& spin = spheres.spin[i];
    Quad impulse{}, ahead{}, turning{}, turning_ahead{};
    for (const TimedLoads& level : loads) {
      const state::SphereLoad& load = level.loads[i - begin];
      const Quad force = read(load.fx), moment = read(load.mx);
      impulse += level.given * force;
      ahead += level.foreseen * force;
      turning += level.given * moment;
      turning_ahead += level.foreseen * moment;
    }
    Quad moves = read(kick.vx), turns = read(kick.wx);
    const Quad gravity = moves[3] > 0 ? falls : Quad{};
    ahead = moves[3] * ahead + half * gravity;
    turning_ahead = turns[3] * turning_ahead;
    moves += moves[3] * impulse + flight.step * gravity;
    turns += turns[3] * turning;
    write(kick.vx, moves);
    write(kick.wx, turns);
    write(place.x, read(place.x) + with_number_of(Quad{}, flight.step * moves));
    write(place.vx, with_number_of(read(place.vx), moves + ahead));
    write(spin.x, with_number_of(read(spin.x), turns + turning_ahead));
    const Real square = square_of(moves - drifts);
    second = std::max(second, std::min(first, square));
    first = square <= first ? first : square;  // what is no number stays
    largest = std::max(largest, square_of(moves));
  }
  return {std::sqrt(first), std::sqrt(second), std::sqrt(largest)};
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
