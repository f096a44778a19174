#include "sazare/methods/spheres/stepper/motion.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/octets.hpp"
#include "sazare/core/vector_of.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::methods::spheres {

namespace {

/// The largest speeds of spheres, compared in lanes: one by one each would wait for the one before.
class LargestSpeeds {
public:
  explicit LargestSpeeds(const Vector3& drift) : drift_(broadcast(drift)) {}

  /// Takes in `count` spheres that stand one after the other, as many as there are lanes at most.
  void take(const state::SphereKick* kicks, std::size_t count) {
    if (count == lane_count) return take(load_quads([&](std::size_t lane) { return &kicks[lane].vx; }), all_lanes);
    take(load_quads([&](std::size_t lane) { return &kicks[lane < count ? lane : 0].vx; }),
         static_cast<LaneBits>((1u << count) - 1));
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
  void take(const std::array<Lanes, 4>& kick, LaneBits those) {
    const LaneVector velocity{kick[0], kick[1], kick[2]}, from_drift = velocity - drift_;
    Lanes seen = dot(from_drift, from_drift), square = dot(velocity, velocity);
    if (those != all_lanes) {
      seen = select(mask_of(those), seen, Lanes{});
      square = select(mask_of(those), square, Lanes{});
    }
    second_ = maximum(second_, Lanes(seen < first_ ? seen : first_));
    first_ = maximum(first_, seen);
    largest_ = maximum(largest_, square);
    sum_ += seen;
  }

  LaneVector drift_;
  Lanes first_{}, second_{}, largest_{};
  Lanes sum_{};  // tells what is no number, which comparisons lose
};

/// What loads give a sphere in a kick, force and moment, and what is predicted besides for its next time.
struct Impulses {
  Octet given, ahead;
};

/// A step of spheres, and what gravity gives them in it.
class Flight {
public:
  explicit Flight(const SphereFlight& flight)
      : falls_(flight.step * Octet(Quad{flight.gravity.x(), flight.gravity.y(), flight.gravity.z(), 0}, Quad{})),
        way_(Quad{flight.step, flight.step, flight.step, 0}, Quad{1, 1, 1, 0}) {}

  /// A sphere's next velocities and place. The further numbers of impulses and of gravity are 0, so those of a record stay what
  /// they are: a mass and an inertia, a radius and a mass.
  void fly(state::SphereKick& kick, state::SpherePlace& place, state::SphereSpin& spin, const Impulses& impulses) const {
    const Octet before = Octet::load(&kick.vx), inverse = before.numbers(), gravity = falls_.where_above_zero(inverse);
    const Octet moves = add_product(inverse, impulses.given, before + gravity);
    const Octet predicted = add_product(inverse, impulses.ahead, add_product(half_, gravity, moves));
    moves.store(&kick.vx);
    add_product(way_, firsts(moves, predicted), Octet::load(&place.x).without_second_vector()).store(&place.x);
    store_half(&spin.x, with_number_of(load_half(&spin.x), predicted.second()));
  }

private:
  Octet falls_, way_;
  Octet half_{RegisterOf<4>::broadcast(0.5), RegisterOf<4>::broadcast(0.5)};
};

/// `impulses(i)` are those of the sphere at place i.
template <class ImpulsesOn>
[[gnu::flatten]] SphereSpeeds fly(state::Spheres& spheres, std::size_t begin, std::size_t end, const SphereFlight& rules,
                                  ImpulsesOn impulses) {
  const Flight flight(rules);
  state::SphereKick* const kicks = spheres.kick.data();
  state::SpherePlace* const places = spheres.place.data();
  state::SphereSpin* const spins = spheres.spin.data();
  LargestSpeeds speeds(rules.drift);
  for (std::size_t first = begin; first < end; first += lane_count) {
    const std::size_t last = std::min<std::size_t>(first + lane_count, end);
    for (std::size_t i = first; i < last; ++i) flight.fly(kicks[i], places[i], spins[i], impulses(i));
    speeds.take(&kicks[first], last - first);
  }
  return speeds.speeds();
}

}  // namespace

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, state::SphereLoad* loads,
                            const SphereFlight& flight) {
  return fly(spheres, begin, end, flight, [=, step = flight.step, half = 0.5 * flight.step](std::size_t i) {
    Real* const numbers = &loads[i - begin].fx;
    const Octet load = Octet::load(numbers);
    Octet{}.store(numbers);
    return Impulses{step * load, half * load};
  });
}

SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, std::span<const TimedLoads> loads,
                            const SphereFlight& flight) {
  const auto by_level = [=](const TimedLoads& level, std::size_t i) {
    const Octet load = Octet::load(&level.loads[i - begin].fx);
    return Impulses{level.given * load, level.predicted * load};
  };
  return fly(spheres, begin, end, flight, [&](std::size_t i) {
    Impulses all = by_level(loads.front(), i);
    for (const TimedLoads& level : loads.subspan(1)) {
      const Impulses more = by_level(level, i);
      all = {all.given + more.given, all.ahead + more.ahead};
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

}  // namespace sazare::methods::spheres
