#pragma once

/// Spheres of a granular body: records that lanes read as a whole, in the order in which they stand in memory.

#include <cstdint>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/time.hpp"

namespace sazare::state {

/// What a pair looks at: one line of the cache. The velocity is that predicted for the time of the place.
struct alignas(64) SpherePlace {
  Real x = 0, y = 0, z = 0;     ///< centre [m]
  Real radius = 0;              ///< [m]
  Real vx = 0, vy = 0, vz = 0;  ///< [m/s]
  Real mass = 0;                ///< [kg]

  Vector3 centre() const { return {x, y, z}; }
  Vector3 velocity() const { return {vx, vy, vz}; }
};

struct alignas(32) SphereSpin {
  Real x = 0, y = 0, z = 0;  ///< predicted like the velocity [rad/s]
  Real material = 0;         ///< its number, as lanes read it

  Vector3 spin() const { return {x, y, z}; }
};

/// Rotation since the start, as a unit quaternion.
struct alignas(32) SphereTurn {
  Real w = 1, x = 0, y = 0, z = 0;
};

/// Velocity and spin half a step back, and what resists their change; 0 where a sphere is held.
struct alignas(64) SphereKick {
  Real vx = 0, vy = 0, vz = 0;  ///< [m/s]
  Real inverse_mass = 0;        ///< [1/kg]
  Real wx = 0, wy = 0, wz = 0;  ///< [rad/s]
  Real inverse_inertia = 0;     ///< [1/(kg m2)]
};

/// Force and moment on a sphere.
struct alignas(64) SphereLoad {
  Real fx = 0, fy = 0, fz = 0, unused = 0;      ///< [N]
  Real mx = 0, my = 0, mz = 0, unused_too = 0;  ///< [N m]
};

/// A box that is periodic along some axes; length 0 along the others.
struct PeriodicBox {
  Vector3 lower = Vector3::Zero();   ///< [m]
  Vector3 length = Vector3::Zero();  ///< [m]

  bool repeats() const { return length.maxCoeff() > 0; }
  Vector3 inverse() const { return (length.array() > 0).select(length.cwiseMax(1e-300).cwiseInverse(), 0.0); }
  /// From one place to the nearest image of another, of which any image is given.
  Vector3 nearest(const Vector3& apart) const {
    return apart - (length.array() * (apart.array() * inverse().array()).round()).matrix();
  }
  /// The periodic image of a place within the box.
  Vector3 wrapped(const Vector3& place) const { return wrapped(place, inverse()); }
  /// For many places: with `inverse()`, worked out once.
  Vector3 wrapped(const Vector3& place, const Vector3& inverse) const {
    return place - (length.array() * ((place - lower).array() * inverse.array()).floor()).matrix();
  }
};

struct Spheres {
  std::vector<SpherePlace> place;
  std::vector<SphereSpin> spin;
  std::vector<SphereKick> kick;
  std::vector<SphereTurn> turn;  ///< empty where nothing asks for it
  std::vector<Index> number;     ///< by which the case and its outputs know a sphere
  PeriodicBox box;

  std::size_t size() const { return place.size(); }

  /// A sphere at rest; a held one does not move.
  void add(const Vector3& centre, Real radius, Real density, Index material, bool held = false) {
    constexpr Real volume_of_unit = 4.18879020478639098462;
    const Real mass = density * volume_of_unit * radius * radius * radius;
    number.push_back(static_cast<Index>(size()));
    place.push_back({centre.x(), centre.y(), centre.z(), radius, 0, 0, 0, mass});
    spin.push_back({0, 0, 0, static_cast<Real>(material)});
    kick.push_back({0, 0, 0, held ? 0 : 1 / mass, 0, 0, 0, held ? 0 : 2.5 / (mass * radius * radius)});
  }

  /// A sphere that is part of a body of bonded spheres has its share of the mass and of the inertia of the whole.
  void set_share(std::size_t i, Real mass, Real inertia) {
    place[i].mass = mass;
    kick[i].inverse_mass = 1 / mass;
    kick[i].inverse_inertia = 1 / inertia;
  }

  Real inertia(std::size_t i) const {
    const Real inverse = kick[i].inverse_inertia;
    return inverse > 0 ? 1 / inverse : 0.4 * place[i].mass * place[i].radius * place[i].radius;
  }

  /// Velocity and spin of a sphere, at all its times at once: before the first step.
  void set_motion(std::size_t i, const Vector3& velocity, const Vector3& turning) {
    place[i].vx = kick[i].vx = velocity.x();
    place[i].vy = kick[i].vy = velocity.y();
    place[i].vz = kick[i].vz = velocity.z();
    spin[i].x = kick[i].wx = turning.x();
    spin[i].y = kick[i].wy = turning.y();
    spin[i].z = kick[i].wz = turning.z();
  }

  void columns(Archive& archive) {
    archive("place", place);
    archive("spin", spin);
    archive("kick", kick);
    archive("turn", turn);
    archive("number", number);
  }
};

}  // namespace sazare::state
