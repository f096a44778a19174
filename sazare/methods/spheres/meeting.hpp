#pragma once

/// Pairs of spheres in lanes: where and how fast they meet.

#include "sazare/core/lane_records.hpp"
#include "sazare/methods/spheres/sphere_at.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// Both spheres of as many pairs as there are lanes, but for their spins.
struct Meeting {
  LaneVector apart, velocity;  ///< of the second ones, seen from the first
  Lanes radius, second_radius, mass, second_mass;
};

/// The spins of as many spheres as there are lanes; `sphere(lane)` is one of them, a SphereAt.
template <class Sphere>
LaneVector spins_of(const state::SphereSpin* spins, const Sphere& sphere) {
  const auto spin = load_quads([&](std::size_t lane) { return &sphere(lane).of(spins)->x; });
  return {spin[0], spin[1], spin[2]};
}

/// a w + b v of the spins w and v of both spheres of as many pairs as there are lanes. What is added up before it is turned into
/// lanes is turned once.
template <class First, class Second>
LaneVector sum_of_spins(const state::SphereSpin* spins, const First& first, const Lanes& a, const Second& second,
                        const Lanes& b) {
  const auto *const first_factor = reinterpret_cast<const Real*>(&a), *const second_factor = reinterpret_cast<const Real*>(&b);
  using Four = RegisterOf<4>;
  const auto sum = lanes_of_quads([&](std::size_t lane) {
    const Quad share = Four::broadcast(first_factor[lane]) * load_half(&first(lane).of(spins)->x);
    return Four::add_product(Four::broadcast(second_factor[lane]), load_half(&second(lane).of(spins)->x), share);
  });
  return {sum[0], sum[1], sum[2]};
}

/// `first(lane)` and `second(lane)` are the spheres of a pair.
template <class First, class Second>
Meeting meeting_of(const state::SpherePlace* places, const First& first, const Second& second) {
  const PairsOfRecords pairs = load_pairs([&](std::size_t lane) { return &first(lane).of(places)->x; },
                                          [&](std::size_t lane) { return &second(lane).of(places)->x; });
  const auto& apart = pairs.difference;
  return {.apart = {apart[0], apart[1], apart[2]},
          .velocity = {apart[4], apart[5], apart[6]},
          .radius = pairs.first[3],
          .second_radius = pairs.second[3],
          .mass = pairs.first[7],
          .second_mass = pairs.second[7]};
}

}  // namespace sazare::methods::spheres
