#pragma once

/// Forces between particles of ground that has a strength: elastic links, plastic flow, links that break, contacts where they
/// broke.

#include "sazare/methods/mps/loose_contacts.hpp"
#include "sazare/particles/particle_forces.hpp"

namespace sazare::methods::mps {

/// What failing has cost so far [J; J/m in 2-D].
struct FailureWork {
  Real flow = 0;     ///< dissipated by plastic flow
  Real rupture = 0;  ///< elastic energy that links lost when they broke, less what contacts took over
  Real contact = 0;  ///< dissipated by friction and dashpots of contacts
};

/// Every evaluation first lets the ground flow by what is beyond its strength, and then evaluates the links as they have relaxed.
/// (With the flow of the step before, the overshoot would act as a dashpot and make the stable step shorter.) A link breaks when
/// the mean slip of its particles reaches the mean of their rupture strains.
template <int D>
class FailingForces final : public particles::ParticleForces<D> {
public:
  /// `links` as the ground is at the beginning; the strength stands for each particle.
  FailingForces(const state::Particles<D>& particles, LinkTable<D> links, GroundStrength<D> strength, const LooseRules& rules);

  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override;
  Real energy(const state::Particles<D>& particles) override;
  void columns(Archive& archive) override;

  const GroundStrength<D>& strength() const { return strength_; }
  FailureWork work() const { return {strength_.dissipated(), rupture_, contacts_.dissipated()}; }
  Index broken_links() const { return static_cast<Index>(broken_.size()); }
  Index contacts() const { return contacts_.touching(); }

  /// Share of the links at the beginning that a particle has lost [-].
  Real broken_fraction(Index particle) const;

private:
  struct Link {
    Index first = 0, second = 0;
    std::int64_t direction = 0;  ///< that of the first
    Real length = 0;             ///< without stress, when it broke [m]
  };

  void break_links(const state::Particles<D>& particles);
  void find_ruptured(Index particle, std::vector<Link>& found) const;
  void cut(const Link& link);
  Real unstressed_length(const Link& link) const;
  Real share_of_column(const laws::LinkDirection<D>& law) const;
  Real energy_around(const state::Particles<D>& particles, const std::vector<Link>& links) const;

  LinkTable<D> links_;
  GroundStrength<D> strength_;
  LooseContacts<D> contacts_;
  Real spacing_ = 0;  ///< [m]
  Frames<GroundStrength<D>::numbers> frames_;
  Tensors<D> stretch_;      ///< see measure_stretch
  state::Column pressure_;  ///< see evaluate_links
  std::vector<Link> broken_;
  std::vector<Index> whole_links_;  ///< by particle, at the beginning
  std::vector<Index> lost_links_;   ///< by particle
  Real rupture_ = 0;
};

extern template class FailingForces<2>;
extern template class FailingForces<3>;

}  // namespace sazare::methods::mps
