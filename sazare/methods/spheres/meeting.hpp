#pragma once

/// Pairs of spheres in lanes: where and how fast they meet.

#include <array>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/triple.hpp"
#include "sazare/methods/spheres/sphere_at.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// Both spheres of as many pairs as there are lanes, but for their spins.
struct Meeting {
  Triple<Lanes> apart, velocity;  ///< of the second ones, seen from the first
  Lanes radius, second_radius, mass, second_mass;
};

#ifdef __AVX512F__

/// The vectors of eight records of four numbers, of which a register holds two: `two(lane)` those of a lane and the next but one.
template <class Two>
Triple<Lanes> vectors_of(const Two& two) {
  const Lanes zero = two(0), one = two(1), four = two(4), five = two(5), even = even_numbers(zero, one),
              even2 = even_numbers(four, five);
  return {even_pairs(even, even2), even_pairs(odd_numbers(zero, one), odd_numbers(four, five)), odd_pairs(even, even2)};
}

/// Of as many spheres as there are lanes; `sphere(lane)` is one of them, a SphereAt.
template <class Sphere>
Triple<Lanes> spins_of(const state::SphereSpin* spins, const Sphere& sphere) {
  return vectors_of([&](std::size_t lane) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(&sphere(lane).of(spins)->x)),
                              _mm256_load_pd(&sphere(lane + 2).of(spins)->x), 1);
  });
}

/// a w + b v of the spins w and v of both spheres of as many pairs as there are lanes. What is added up before it is turned into
/// lanes is turned once.
template <class First, class Second>
Triple<Lanes> sum_of_spins(const state::SphereSpin* spins, const First& first, const Lanes& a, const Second& second,
                           const Lanes& b) {
  const auto *const first_factor = reinterpret_cast<const Real*>(&a), *const second_factor = reinterpret_cast<const Real*>(&b);
  const auto sum = [&](std::size_t lane) {
    return _mm256_fmadd_pd(_mm256_set1_pd(second_factor[lane]), _mm256_load_pd(&second(lane).of(spins)->x),
                           _mm256_mul_pd(_mm256_set1_pd(first_factor[lane]), _mm256_load_pd(&first(lane).of(spins)->x)));
  };
  return vectors_of([&](std::size_t lane) { return _mm512_insertf64x4(_mm512_castpd256_pd512(sum(lane)), sum(lane + 2), 1); });
}

/// `first(lane)` and `second(lane)` are the spheres of a pair. A whole record is subtracted from another one at once, so that
/// their differences are turned into lanes once, and not what either sphere has.
template <class First, class Second>
Meeting meeting_of(const state::SpherePlace* places, const First& first, const Second& second) {
  std::array<Lanes, 4> even, odd, own, others;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto one = first(2 * i), next = first(2 * i + 1), other = second(2 * i), next_other = second(2 * i + 1);
    const Lanes a = load_lanes(&one.of(places)->x), b = load_lanes(&next.of(places)->x), a2 = load_lanes(&other.of(places)->x),
                b2 = load_lanes(&next_other.of(places)->x), from_a = a2 - a, from_b = b2 - b;
    even[i] = even_numbers(from_a, from_b);
    odd[i] = odd_numbers(from_a, from_b);
    own[i] = odd_numbers(a, b);
    others[i] = odd_numbers(a2, b2);
  }
  const Lanes x = even_pairs(even[0], even[1]), x2 = even_pairs(even[2], even[3]), y = even_pairs(odd[0], odd[1]),
              y2 = even_pairs(odd[2], odd[3]), z = odd_pairs(even[0], even[1]), z2 = odd_pairs(even[2], even[3]),
              sizes = odd_pairs(own[0], own[1]), sizes2 = odd_pairs(own[2], own[3]),
              second_sizes = odd_pairs(others[0], others[1]), second_sizes2 = odd_pairs(others[2], others[3]);
  return {{even_pairs(x, x2), even_pairs(y, y2), even_pairs(z, z2)},
          {odd_pairs(x, x2), odd_pairs(y, y2), odd_pairs(z, z2)},
          even_pairs(sizes, sizes2),
          even_pairs(second_sizes, second_sizes2),
          odd_pairs(sizes, sizes2),
          odd_pairs(second_sizes, second_sizes2)};
}

#else

template <class First, class Second>
Meeting meeting_of(const state::SpherePlace* places, const First& first, const Second& second) {
  const auto place = load_quads([&](std::size_t lane) { return &first(lane).of(places)->x; }),
             second_place = load_quads([&](std::size_t lane) { return &second(lane).of(places)->x; }),
             motion = load_quads([&](std::size_t lane) { return &first(lane).of(places)->vx; }),
             second_motion = load_quads([&](std::size_t lane) { return &second(lane).of(places)->vx; });
  const auto vector = [](const std::array<Lanes, 4>& quad) { return Triple<Lanes>{quad[0], quad[1], quad[2]}; };
  return {vector(second_place) - vector(place),
          vector(second_motion) - vector(motion),
          place[3],
          second_place[3],
          motion[3],
          second_motion[3]};
}

template <class Sphere>
Triple<Lanes> spins_of(const state::SphereSpin* spins, const Sphere& sphere) {
  const auto spin = load_quads([&](std::size_t lane) { return &sphere(lane).of(spins)->x; });
  return {spin[0], spin[1], spin[2]};
}

template <class First, class Second>
Triple<Lanes> sum_of_spins(const state::SphereSpin* spins, const First& first, const Lanes& a, const Second& second,
                           const Lanes& b) {
  return add_product(b, spins_of(spins, second), a * spins_of(spins, first));
}

#endif

}  // namespace sazare::methods::spheres
