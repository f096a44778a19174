#pragma once

/// Contact of ground with a surface of triangles whose nodes move (geometry/nodal_surface.hpp).
///
/// A particle is a ball as wide as the spacing, a disc of thickness 1 in the plane. It touches the surface in points that count
/// so that the force has an energy (geometry/facets/complex.hpp). Springs are the ground between a particle's centre and the
/// surface, half a cell, so that the ground is as stiff up to the surface as within:
///
///     N = k_n d - c v_n >= 0     k_n = 2 (lambda + 2 mu), times the spacing in 3-D     d    overlap [m]
///     T = k_t s, |T| <= f N      k_t = 2 mu, times the spacing in 3-D                  s    stretch by sliding since it stuck
///     [m]
///
/// The dashpot is that of loose particles (laws/sphere_contact.hpp). What a ball overlaps when it first meets the surface gives
/// no force until they part.
///
/// Friction on a particle that has links acts where it touches, and turns it. Broken ground has no links that would hold it
/// against rolling, and is a continuum that slides: there the force acts in the particle's centre.
///
/// What dashpots and friction take in a step is the mean of their forces at its ends times the way, as the stepper counts work.

#include <functional>
#include <span>

#include "sazare/geometry/facets/points.hpp"
#include "sazare/geometry/nodal_surface.hpp"
#include "sazare/laws/sphere_contact.hpp"
#include "sazare/methods/mps/particle_places.hpp"

namespace sazare::methods::mps {

struct SurfaceRules {
  Real step = 0;           ///< [s]
  Real damping_ratio = 0;  ///< of the dashpots, over critical [-]
  Real friction = 0;       ///< between ground and surface [-]
};

/// Of the ground of a particle [m/s].
struct WaveVelocities {
  Real p = 0, s = 0;
};

/// k_n/m of a particle by the P-wave velocity, k_t/m by the S-wave velocity, whatever part of a cell it is [1/s2].
inline Real stiffness_over_mass(Real wave_velocity, Real spacing) {
  return 2 * wave_velocity * wave_velocity / (spacing * spacing);
}

template <int D>
class SurfaceContacts {
public:
  /// The surface at rest [m], faces by numbers of nodes. `particles` as they are at the beginning, `waves` of each.
  SurfaceContacts(const state::Particles<D>& particles, std::span<const WaveVelocities> waves, const SurfaceRules& rules,
                  std::vector<Vector3> nodes, std::vector<std::array<Index, 3>> faces);

  /// From the last evaluation on the nodes go from these places with these velocities [m; m/s].
  void lead(std::vector<Vector3> from, std::vector<Vector3> with);
  /// Before the beginning: the nodes stand here from now on [m].
  void put(std::vector<Vector3> nodes);

  /// All forces, a step after those before; `is_linked(particle)`: whether it has links.
  void evaluate(const state::Particles<D>& particles, const std::function<bool(Index)>& is_linked);
  /// Adds the accelerations that they give, times a factor.
  void add_forces(Real factor, state::FreedomColumns<D>& acceleration) const;

  const geometry::SurfaceNodes& nodes() const { return surface_; }
  Index touching() const;                          ///< particles at the last evaluation
  Real energy() const;                             ///< in the springs at the last evaluation [J; J/m in 2-D]
  Real dissipated() const { return dissipated_; }  ///< by friction and dashpots [J; J/m in 2-D]
  /// Work of the surface on the particles [J; J/m in 2-D].
  Real work() const { return past_work_ + surface_.work(); }

  /// Throws UserError where a checkpoint does not fit.
  void columns(Archive& archive);

private:
  /// What a point remembers: of the dashpot, and the force of the spring that slides, on the particle [N].
  struct Memory {
    laws::SphereMemory along;
    Vector3 across = Vector3::Zero();

    void turn(const Vector3& normal, const Vector3& tilt, Real angle) {
      across = laws::PlaneTurn<Real>(normal, tilt, angle).carried(across);
    }
  };
  struct Touch {
    Index is_touching = 0;
    Index unused = 0;                  ///< no gap, for checkpoints
    Vector3 normal = Vector3::Zero();  ///< from the surface to the particle
    Memory memory;
    Vector3 dashpot = Vector3::Zero(), friction = Vector3::Zero();  ///< on the particle at the last evaluation [N]
    Real stored = 0;                                                ///< in the spring that slides, then [J]
  };
  /// What the surface has got in a point of it.
  struct Push {
    std::array<Index, 3> nodes{};
    std::array<Real, 3> shares{};
    Vector3 on_particle = Vector3::Zero();  ///< [N]
  };
  /// A particle near the surface.
  struct Near {
    Index particle = 0;
    Index is_known = 0;        ///< whether its initial overlap is known
    Real initial_overlap = 0;  ///< overlap when it met the surface, as far as they have not parted since [m]
    std::vector<Index> faces;
    std::vector<Touch> touches;
    std::vector<Push> pushes;
    Vector3 acceleration = Vector3::Zero(), turning = Vector3::Zero();  ///< [m/s2], [rad/s2]
    Real energy = 0, loss = 0;                                          ///< loss: of the last step [J]
  };
  struct Moving;

  void search(const state::Particles<D>& particles);
  bool must_search(const state::Particles<D>& particles) const;
  void evaluate(const state::Particles<D>& particles, bool is_linked, Near& near) const;
  Real find_faces(const Vector3& centre, const Near& near, std::vector<geometry::NearFacet>& found) const;
  void check(std::size_t particles) const;
  void push(const Moving& particle, const geometry::FacetPoint& point, Real overlap, Real contacts, Near& near) const;

  SurfaceRules rules_;
  Real spacing_;
  state::Column along_, across_;  ///< k_n and k_t by particle [N/m; N/m2 in 2-D]
  geometry::NodalSurface surface_;
  geometry::FacetComplex complex_;
  Real time_ = 0;   ///< since the nodes were led last [s]
  Real drift_ = 0;  ///< of any node since the last search, at most [m]
  bool searched_ = false;
  PlaceColumns<D> searched_at_;  ///< displacements at the last search [m]
  std::vector<Near> near_;       ///< in the order of particles
  Real dissipated_ = 0;
  Real past_work_ = 0;  ///< until the nodes were led last [J]
};

extern template class SurfaceContacts<2>;
extern template class SurfaceContacts<3>;

}  // namespace sazare::methods::mps
