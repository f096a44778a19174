#pragma once

/// Particles of the moving-particle method, all of one size: named columns, padded with particles that have no mass to move so
/// that lanes can always be read in full.

#include <array>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/lanes.hpp"
#include "sazare/core/rotation.hpp"
#include "sazare/core/time.hpp"

namespace sazare::state {

/// Degrees of freedom of a particle: first the translations, then the rotations.
template <int D>
inline constexpr int particle_freedoms = D + angular_dimension<D>;

/// Numbers that hold a rotation: cosine and sine in 2-D, a matrix by rows in 3-D.
template <int D>
inline constexpr int rotation_numbers = D == 2 ? 2 : 9;

/// One number of every particle; `count` padded to whole lanes.
using Column = std::vector<Real>;

template <int D>
using FreedomColumns = std::array<Column, particle_freedoms<D>>;

template <int D>
struct Particles {
  Index count = 0;                     ///< without the padding
  Real spacing = 0;                    ///< D [m]
  std::array<Column, D> start;         ///< [m]
  std::array<Column, D> displacement;  ///< from there [m]
  Column angle;                        ///< 2-D only: angle from which the rotation follows [rad]
  std::array<Column, rotation_numbers<D>> rotation;
  FreedomColumns<D> velocity;  ///< [m/s], [rad/s]
  Column inverse_mass;         ///< [1/kg; m/kg in 2-D]
  Column inverse_inertia;      ///< of rotation [1/(kg m2); 1/(kg m) in 2-D]
  Column shear_modulus;        ///< mu [Pa]
  Column lame;                 ///< lambda [Pa]
  Column damping_ratio;        ///< h [-]

  std::size_t size() const { return static_cast<std::size_t>(count); }
  std::size_t padded() const { return (size() + lane_count - 1) / lane_count * lane_count; }
  Real volume() const { return D == 2 ? spacing * spacing : spacing * spacing * spacing; }

  /// Gives a particle the mass of its volume, and the rotational inertia of a square or a cube: I = m D^2/6. [Yoshida2010],
  /// (A14).
  void set_density(Index particle, Real density) {
    const auto i = static_cast<std::size_t>(particle);
    inverse_mass[i] = 1 / (density * volume());
    inverse_inertia[i] = 6 / (spacing * spacing) * inverse_mass[i];
  }

  /// Inverse mass or inertia, whatever moves along a degree of freedom.
  const Column& inverse_inertia_of(std::size_t freedom) const { return freedom < D ? inverse_mass : inverse_inertia; }

  Real position(std::size_t axis, std::size_t particle) const { return start[axis][particle] + displacement[axis][particle]; }

  /// All columns at their size: at rest, unturned, of mass and inertia 1.
  void resize(Index particles) {
    count = particles;
    const std::size_t n = padded();
    for (auto* group : {&start, &displacement})
      for (Column& column : *group) column.assign(n, 0);
    for (Column& column : rotation) column.assign(n, 0);
    for (std::size_t i = 0; i < rotation.size(); i += D + 1) rotation[i].assign(n, 1);
    for (Column& column : velocity) column.assign(n, 0);
    angle.assign(D == 2 ? n : 0, 0);
    inverse_mass.assign(n, 1);
    inverse_inertia.assign(n, 1);
    for (Column* column : {&shear_modulus, &lame, &damping_ratio}) column->assign(n, 0);
  }

  /// What moves.
  void columns(Archive& archive) {
    for (std::size_t i = 0; i < D; ++i) archive("displacement" + std::to_string(i), displacement[i]);
    for (std::size_t i = 0; i < rotation.size(); ++i) archive("rotation" + std::to_string(i), rotation[i]);
    for (std::size_t i = 0; i < velocity.size(); ++i) archive("velocity" + std::to_string(i), velocity[i]);
    archive("angle", angle);
  }
};

}  // namespace sazare::state
