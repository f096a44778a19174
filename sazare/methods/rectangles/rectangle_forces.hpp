#pragma once

/// All forces between pseudo-rectangle elements and their supports.

#include <optional>
#include <vector>

#include "sazare/methods/rectangles/contacts.hpp"
#include "sazare/methods/rectangles/face_links.hpp"
#include "sazare/methods/rectangles/surface_contacts.hpp"
#include "sazare/particles/particle_forces.hpp"

namespace sazare::methods::rectangles {

/// A plate below all elements drags them while it moves: friction of each element's area in the direction of its motion on the
/// plate, turning counted as r theta'. [Matsui1999], eq. (21). Where a step's friction would turn that motion round, only as
/// much acts as stops it.
struct BaseFriction {
  Real coefficient = 0;                                    ///< mu_B; 0: no plate
  geometry::Vector2 velocity = geometry::Vector2::Zero();  ///< of the plate [m/s]
  Real gravity = 9.81;                                     ///< that presses the elements on it [m/s2]
};

/// Energies so far [J].
struct EnergyParts {
  Real elastic = 0;
  SpringLosses links;
  SpringLosses contacts;   ///< nothing breaks there
  Real base_friction = 0;  ///< work of the plate on the elements
  Real supports = 0;       ///< work of moved supports on the elements
  Real surface = 0;        ///< work of a surface with nodes on the elements

  Real lost() const { return links.dashpot + links.friction + links.fracture + contacts.dashpot + contacts.friction; }
};

class RectangleForces : public particles::ParticleForces<2> {
public:
  struct Parts {
    state::Outlines outlines;  ///< supports last
    std::vector<FaceKind> kinds;
    std::vector<FaceLink> links;
    std::vector<FacetLink> facets;
    ContactRules contact;
    BaseFriction base_friction;
    Index supports = 0;  ///< how many of the outlines are supports
  };

  RectangleForces(const state::Particles<2>& particles, Parts parts, Real step);

  void evaluate(const state::Particles<2>& particles, state::FreedomColumns<2>& acceleration) override;
  Real energy(const state::Particles<2>& particles) override;
  void columns(Archive& archive) override;

  /// Adds a surface that moves with its nodes, before the first evaluation or a resume; one at most. Places in m.
  void add_surface(const state::Particles<2>& particles, const std::vector<Vector3>& nodes,
                   std::vector<SurfaceContacts::Segment> segments);
  /// From the last evaluation on its nodes go from these places with these velocities [m; m/s].
  void lead(std::vector<Vector3> from, std::vector<Vector3> with) { surface_->lead(step_, std::move(from), std::move(with)); }
  /// Nullptr where there is none.
  const SurfaceContacts* surface() const { return surface_ ? &*surface_ : nullptr; }

  EnergyParts energy_parts(const state::Particles<2>& particles) const;
  const state::Outlines& outlines() const { return outlines_; }
  const FaceLinks& links() const { return links_; }
  const Contacts& contacts() const { return contacts_; }

  /// Force on a support [N], moment [N m].
  const std::array<Real, 3>& support_force(Index support) const { return support_force_[static_cast<std::size_t>(support)]; }

  /// Faces of the links that are open can touch something from now on.
  static void expose(const FaceLinks& links, std::span<const Index> opened, state::Outlines& outlines);

private:
  bool is_touched(std::size_t element) const { return contacts_.has_pairs(element) || (surface_ && surface_->has(element)); }
  void gather(const state::Particles<2>& particles, state::FreedomColumns<2>& acceleration);
  void add_base_friction(const state::Particles<2>& particles, std::size_t pack, std::array<Lanes, 3>& sum);
  void sum_up_supports(const state::Particles<2>& particles);

  state::Outlines outlines_;
  FaceLinks links_;
  Contacts contacts_;
  BaseFriction base_friction_;
  std::optional<SurfaceContacts> surface_;
  Real step_ = 0;
  bool begun_ = false;
  state::Column radius_;                  ///< r of (21), padded [m]
  state::Column base_work_, base_power_;  ///< of the plate by element [J], and when last evaluated [W]
  state::FreedomColumns<2> base_force_;   ///< its last forces and moments [N], [N m]
  std::vector<std::array<Real, 3>> support_force_;
  std::vector<std::array<Real, 3>> support_place_;  ///< displacements and angle when its force was last summed up
  Real support_work_ = 0;
};

}  // namespace sazare::methods::rectangles
