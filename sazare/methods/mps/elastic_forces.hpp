#pragma once

#include <vector>

#include "sazare/methods/mps/link_table.hpp"
#include "sazare/terms/particle_forces.hpp"

namespace sazare::methods::mps {

/// How the rotation is taken out of a link's deformation.
enum class RotationRemoval {
  mean_rotation,  ///< by the mean of the two rotations, (12)
  mean_angle,     ///< by the rotation of the mean angle, (11); 2-D only
};

/// Elastic forces of all links (laws/particle_link.hpp). Each particle evaluates all its own links, in the order of the table, in
/// two passes: volume strains, then forces. Results do not depend on the number of threads.
template <int D>
class ElasticForces final : public terms::ParticleForces<D> {
 public:
  ElasticForces(LinkTable<D> links, RotationRemoval removal);

  void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) override;
  Real energy(const state::Particles<D>& particles) override;
  void columns(Archive&) override {}

  const LinkTable<D>& links() const { return links_; }

 private:
  template <RotationRemoval removal>
  void evaluate_with(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration);

  LinkTable<D> links_;
  RotationRemoval removal_;
  state::Column pressure_;  ///< V lambda div of every particle [N m; N in 2-D]
};

extern template class ElasticForces<2>;
extern template class ElasticForces<3>;

}  // namespace sazare::methods::mps
