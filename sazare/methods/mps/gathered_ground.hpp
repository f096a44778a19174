#pragma once

/// Broken ground: particles that have no links any more.
///
/// The stress of such a particle (laws/ground_flow.hpp) follows from the motion of the particles that are now near it, whoever they
/// are, and acts on them (updated Lagrangian):
///
///     g_j = c_j b (1 - r_j^2/R^2)^2,   S = sum_j g_j r_j r_j^T,   G = sum_j g_j (u_j - u) r_j^T S^-1
///     f_j = -V g_j s S^-1 r_j                     on the neighbour j, the opposite on the particle itself
///
///     r_j  from the particle to j [m]               u  displacement in the step [m]        G  their gradient [-]
///     R    2.4 D                                    s  stress [Pa]                         V  volume [m3; m2 in 2-D]
///     b    makes S of a whole neighbourhood of the lattice 1
///     c_j  1; 2 for a neighbour that is not broken; half of it for two particles on boundaries that cut them in half
///
/// G is exact for any homogeneous motion, whatever the neighbours. The forces are its adjoint: their power is -V s : G, so stress,
/// stored energy and dissipation are those of the continuum; momentum and angular momentum are kept. A neighbour that is not broken has no other half to give: its
/// links end there as at a free surface. So the broken particle has both, c_j = 2, and the volume that belongs to them, V times
/// the sum of g_j r_j^2 over that with c_j = 1. What passes over the border is the stress of the broken ground, within its strength, so
/// broken ground slides on whole ground, on rock and on supports with its own friction, and never tears at them.
///
/// Motions of single particles that no gradient shows would not be resisted. A dashpot acts on what the neighbours' velocities
/// differ from the linear field that fits them best with the weights g,
///
///     h_j = -(g_j/sum g) d z m c_p/(sqrt(2) D) (v_j - v - G_v r_j),      z the damping ratio, m the mass, c_p the P-wave velocity,
///
/// which is zero for every homogeneous motion, and takes energy from all others. (Least squares make sum_j h_j r_j^T zero, so it
/// keeps angular momentum, too.)
///
/// Where the neighbours hardly span the space, smallest eigenvalue l of S, strain and force fade: the strain is f sym(G) and the
/// force comes of f s, f = min(1, l/l_min), and less where the particle would else be too stiff for the step. A rigid rotation still
/// has no strain. A particle whose neighbours do not span the space at all is alone: without stress, and open.
///
/// Stress tells how distances change, not how large they are. That no particle slips between others, two repel each other with k =
/// lambda + 2 mu, times D in 3-D, when they are nearer than 0.7 D, which the motion of a continuum does not bring about.

#include "sazare/laws/ground_flow.hpp"
#include "sazare/methods/mps/ground_strength.hpp"
#include "sazare/methods/mps/loose_contacts.hpp"

namespace sazare::methods::mps {

template <int D>
class GatheredGround {
public:
  GatheredGround(const state::Particles<D>& particles, const GroundStrength<D>& strength, const LooseRules& rules);

  bool empty() const { return members_.empty(); }
  bool holds(Index particle) const { return member_[at(particle)] >= 0; }

  /// Takes a particle in with the stress that it has, and the volume strain of its gaps. A search must follow.
  void add(Index particle, const Rotation<D>& stress, Real opening);

  /// Stresses from the motion since the last forces; the slip is added to that of `strength`.
  void advance(const state::Particles<D>& particles, GroundStrength<D>& strength);

  /// Whether lists of neighbours must be made anew, when nobody is added.
  bool must_search(const state::Particles<D>& particles) const;

  /// Makes lists of neighbours.
  void search(const state::Particles<D>& particles, const GroundStrength<D>& strength);

  void add_forces(const state::Particles<D>& particles, const GroundStrength<D>& strength, state::FreedomColumns<D>& acceleration);

  Real energy(const GroundStrength<D>& strength) const;  ///< at the last forces [J; J/m in 2-D]
  Real flow() const { return flow_; }  ///< dissipated by plastic flow [J; J/m in 2-D]
  Real drag() const { return drag_; }  ///< dissipated by the dashpots [J; J/m in 2-D]
  Real lost() const { return lost_; }  ///< elastic energy of volume that has passed to others [J; J/m in 2-D]

  /// Stress and opening of a gathered particle.
  const laws::GroundState<D>& state_of(Index particle) const { return members_[at(member_[at(particle)])].state; }
  std::vector<Index> particles() const;

  void columns(Archive& archive);

private:
  struct Member {
    Index particle = 0;
    Index is_new = 1;  ///< has had no forces yet
    Real volume = 0;   ///< V with what belongs to neighbours that are not broken [m3; m2 in 2-D]
    laws::GroundState<D> state;
  };
  struct Neighbor {
    Index particle = 0;
    Real share = 1;  ///< c
  };
  /// What the displacements or velocities around a particle are like: S^-1, f and the gradient.
  struct Around {
    Rotation<D> inverse = Rotation<D>::Zero();
    Real fade = 0;  ///< f
    Rotation<D> gradient = Rotation<D>::Zero();
    Real weights = 0;  ///< sum of g [1/m2]
    Real volume = 1;   ///< over that of the particle
    bool is_alone = true;
  };
  struct Push {
    Vector<D> stress = Vector<D>::Zero();  ///< on the neighbour, by stress and repulsion [N]
    Vector<D> drag = Vector<D>::Zero();    ///< by dashpots [N]
    Real core = 0;                         ///< energy of the repulsion of two particles that are too near [J]
  };

  Real weight(Real square, Real share) const;
  template <class Way, class Change>
  Around look_around(std::size_t member, Real wave_velocity, Way&& way, Change&& change) const;
  laws::GroundStep<D> advance_one(const state::Particles<D>& particles, const GroundStrength<D>& strength, std::size_t member);
  Real push_from(const state::Particles<D>& particles, const GroundStrength<D>& strength, std::size_t member);
  void list_neighbors();

  LooseRules rules_;
  Real spacing_ = 0;                    ///< [m]
  Real whole_ = 0;                      ///< factor of g [-]
  std::array<state::Column, D> start_;  ///< of all particles [m]
  std::vector<Member> members_;
  std::vector<Index> member_;         ///< by particle: which member it is, or -1
  std::vector<std::uint8_t> is_cut_;  ///< by particle: whether half of it lies beyond a boundary
  std::vector<Neighbor> neighbors_;
  std::vector<std::size_t> begin_;  ///< by member: first of its neighbours; one more
  std::vector<Push> pushes_;        ///< by neighbour
  std::vector<Real> volumes_;       ///< by member, of the last forces
  std::vector<laws::GroundStep<D>> steps_;  ///< by member, of the last `advance`
  std::array<state::Column, D> searched_at_;  ///< displacements at the last search [m]
  std::array<state::Column, D> last_;         ///< displacements at the last forces [m]
  std::array<state::Column, D> drag_force_;   ///< by particle, of the last forces [N]
  ParticleGrid<D> grid_;
  Real flow_ = 0, drag_ = 0, lost_ = 0;
};

extern template class GatheredGround<2>;
extern template class GatheredGround<3>;

}  // namespace sazare::methods::mps
