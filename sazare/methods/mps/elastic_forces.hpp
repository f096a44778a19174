#pragma once

#include "sazare/methods/mps/link_forces.hpp"
#include "sazare/particles/particle_forces.hpp"

namespace sazare::methods::mps {

/// Elastic forces of all links (laws/particle_link.hpp).
template <int D>
class ElasticForces final : public particles::ParticleForces<D> {
public:
  ElasticForces(LinkTable<D> links, RotationRemoval removal);

  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override;
  Real energy(const state::Particles<D>& particles) override;
  void columns(Archive&) override {}

  const LinkTable<D>& links() const { return links_; }

private:
  LinkTable<D> links_;
  RotationRemoval removal_;
  state::Column pressure_;  ///< see evaluate_links
};

extern template class ElasticForces<2>;
extern template class ElasticForces<3>;

}  // namespace sazare::methods::mps
