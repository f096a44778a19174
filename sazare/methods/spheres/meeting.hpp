#pragma once

/// Pairs of spheres in lanes: where and how fast they meet.

#include <array>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/time.hpp"
#include "sazare/core/triple.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// Both spheres of as many pairs as there are lanes.
struct Meeting {
  Triple<Lanes> apart, velocity;  ///< of the second ones, seen from the first
  Lanes radius, second_radius, mass, second_mass;
  Triple<Lanes> spin, second_spin;
};

#ifdef __AVX512F__

using FourRegisters = std::array<Lanes, 4>;

// Steps of turning records into lanes: what two registers have at some places, side by side.
inline Lanes low_pairs(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13); }
inline Lanes high_pairs(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15); }
inline Lanes lower_halves(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11); }
inline Lanes upper_halves(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15); }
inline Lanes even_numbers(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); }
inline Lanes odd_numbers(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); }

/// The vectors of eight records of four numbers, two in each register.
inline Triple<Lanes> vectors_of(const FourRegisters& two_each) {
  const Lanes even = even_numbers(two_each[0], two_each[1]), even2 = even_numbers(two_each[2], two_each[3]),
              odd = odd_numbers(two_each[0], two_each[1]), odd2 = odd_numbers(two_each[2], two_each[3]);
  const auto firsts = [](const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 4, 1, 5, 8, 12, 9, 13); };
  const auto thirds = [](const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 2, 6, 3, 7, 10, 14, 11, 15); };
  return {firsts(even, even2), firsts(odd, odd2), thirds(even, even2)};
}

inline Lanes two_spins(const state::SphereSpin& a, const state::SphereSpin& b) {
  return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(&a.x)), _mm256_load_pd(&b.x), 1);
}

/// `first(lane)` and `second(lane)` are the places of a pair. A whole record is subtracted from another one at once, so that
/// their differences are turned into lanes once, and not what either sphere has.
template <class First, class Second>
Meeting meeting_of(const state::SpherePlace* places, const state::SphereSpin* spins, const First& first, const Second& second) {
  FourRegisters even, odd, own, others, spin, second_spin;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t one = first(2 * i), next = first(2 * i + 1), other = second(2 * i), next_other = second(2 * i + 1);
    const Lanes a = load_lanes(&places[one].x), b = load_lanes(&places[next].x), a2 = load_lanes(&places[other].x),
                b2 = load_lanes(&places[next_other].x), from_a = a2 - a, from_b = b2 - b;
    spin[i] = two_spins(spins[one], spins[next]);
    second_spin[i] = two_spins(spins[other], spins[next_other]);
    even[i] = even_numbers(from_a, from_b);
    odd[i] = odd_numbers(from_a, from_b);
    own[i] = odd_numbers(a, b);
    others[i] = odd_numbers(a2, b2);
  }
  const Lanes x = low_pairs(even[0], even[1]), x2 = low_pairs(even[2], even[3]), y = low_pairs(odd[0], odd[1]),
              y2 = low_pairs(odd[2], odd[3]), z = high_pairs(even[0], even[1]), z2 = high_pairs(even[2], even[3]),
              sizes = high_pairs(own[0], own[1]), sizes2 = high_pairs(own[2], own[3]),
              second_sizes = high_pairs(others[0], others[1]), second_sizes2 = high_pairs(others[2], others[3]);
  return {{lower_halves(x, x2), lower_halves(y, y2), lower_halves(z, z2)},
          {upper_halves(x, x2), upper_halves(y, y2), upper_halves(z, z2)},
          lower_halves(sizes, sizes2),
          lower_halves(second_sizes, second_sizes2),
          upper_halves(sizes, sizes2),
          upper_halves(second_sizes, second_sizes2),
          vectors_of(spin),
          vectors_of(second_spin)};
}

#else

template <class First, class Second>
Meeting meeting_of(const state::SpherePlace* places, const state::SphereSpin* spins, const First& first, const Second& second) {
  const auto place = load_quads([&](std::size_t lane) { return &places[first(lane)].x; }),
             second_place = load_quads([&](std::size_t lane) { return &places[second(lane)].x; }),
             motion = load_quads([&](std::size_t lane) { return &places[first(lane)].vx; }),
             second_motion = load_quads([&](std::size_t lane) { return &places[second(lane)].vx; }),
             spin = load_quads([&](std::size_t lane) { return &spins[first(lane)].x; }),
             second_spin = load_quads([&](std::size_t lane) { return &spins[second(lane)].x; });
  const auto vector = [](const std::array<Lanes, 4>& quad) { return Triple<Lanes>{quad[0], quad[1], quad[2]}; };
  return {vector(second_place) - vector(place),
          vector(second_motion) - vector(motion),
          place[3],
          second_place[3],
          motion[3],
          second_motion[3],
          vector(spin),
          vector(second_spin)};
}

#endif

}  // namespace sazare::methods::spheres
