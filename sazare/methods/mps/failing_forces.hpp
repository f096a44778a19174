#pragma once

/// Forces between particles of ground that has a strength: elastic links, plastic flow, broken ground.

#include "sazare/methods/mps/gathered_ground.hpp"
#include "sazare/methods/mps/loose_contacts.hpp"
#include "sazare/particles/particle_forces.hpp"

namespace sazare::methods::mps {

/// What failing has cost so far [J; J/m in 2-D].
struct FailureWork {
  Real flow = 0;     ///< dissipated by plastic flow
  Real rupture = 0;  ///< elastic energy that links lost, less what broken ground took over
  Real contact = 0;  ///< dissipated by friction and dashpots of contacts, and by those of broken ground
};

/// Every evaluation first lets the ground flow by what is beyond its strength, and then evaluates the links as they have relaxed.
/// (With the flow of the step before, the overshoot would act as a dashpot and make the stable step shorter.) A particle breaks
/// when its slip reaches its rupture strain: all its links break, and it is broken ground from then on (gathered_ground.hpp).
///
/// Plastic flow de_p of a linked particle dissipates (q + q')/2 : de_p, with q = -dE/de_p before the step and q' after it: with
/// the work of the forces, the mean of both ends times the displacement, it closes the energy balance. Ground that degrades keeps
/// a part of it as elastic energy of its own (degrading_ground.hpp).
template <int D>
class FailingForces final : public particles::ParticleForces<D> {
public:
  /// `links` as the ground is at the beginning; the strength stands for each particle.
  FailingForces(const state::Particles<D>& particles, LinkTable<D> links, GroundStrength<D> strength, const LooseRules& rules);

  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override;
  Real energy(const state::Particles<D>& particles) override;
  void columns(Archive& archive) override;

  const LinkTable<D>& links() const { return links_; }
  const GroundStrength<D>& strength() const { return strength_; }
  const GatheredGround<D>& gathered() const { return gathered_; }
  FailureWork work() const {
    return {flow_ - strength_.degrading().stored() + gathered_.flow(), rupture_ + gathered_.lost(),
            contacts_.dissipated() + gathered_.drag()};
  }
  Index broken_links() const { return static_cast<Index>(cut_.size()); }
  Index contacts() const { return contacts_.touching(); }

  /// Share of the links at the beginning that a particle has lost [-].
  Real broken_fraction(Index particle) const;

private:
  /// A link that broke, and what it was.
  struct CutLink {
    std::size_t direction = 0;
    Index particle = 0;
    Real share = 0, opposite_share = 0;  ///< see LinkTable
  };

  std::vector<Index> ruptured() const;
  void break_ground(const state::Particles<D>& particles, std::span<const Index> broken);
  void cut_links(Index particle);
  void set_link(const CutLink& link, Real share, Real opposite_share);
  void restore_links();
  void add_work_of_flow(const state::Particles<D>& particles);
  Real energy_around(const state::Particles<D>& particles, std::span<const Index> broken) const;

  LinkTable<D> links_;
  GroundStrength<D> strength_;
  LooseContacts<D> contacts_;
  GatheredGround<D> gathered_;
  Frames<GroundStrength<D>::numbers> frames_;
  Tensors<D> stretch_;      ///< see measure_stretch
  Tensors<D> virial_;       ///< see evaluate_links
  /// q of every particle at the last evaluation: its diagonal, and the sums of both parts off it [N m; N in 2-D].
  std::array<state::Column, static_cast<std::size_t>(D) * (D + 1) / 2> relief_;
  state::Column pressure_;  ///< see evaluate_links
  std::vector<Index> whole_links_;  ///< by particle, at the beginning
  std::vector<Index> lost_links_;   ///< by particle
  std::vector<CutLink> cut_;        ///< in the order in which they broke
  state::Column work_;              ///< by particle, of its last flow [J; J/m in 2-D]
  Real flow_ = 0;                   ///< what plastic flow has taken from the links so far [J; J/m in 2-D]
  Real rupture_ = 0;
};

extern template class FailingForces<2>;
extern template class FailingForces<3>;

}  // namespace sazare::methods::mps
