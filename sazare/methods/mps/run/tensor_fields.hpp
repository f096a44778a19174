#pragma once

/// Stresses and strains of all particles, as snapshots have them.

#include <optional>

#include "sazare/methods/mps/run/model.hpp"
#include "sazare/observe/vtkhdf.hpp"

namespace sazare::runs {

/// Linked particles have the strain of their links and the stress of their law, broken ones the stress that they carry
/// (ground_strength.hpp, gathered_ground.hpp).
template <int D>
class TensorFields {
public:
  TensorFields(const cases::MpsCase& mps, const MpsModel<D>& model) : mps_(&mps), model_(&model) {}

  /// Of all particles as they are now; what was told before is no longer valid.
  std::vector<observe::CellData> measure();

private:
  const methods::mps::GroundStrength<D>& ground();
  methods::mps::ParticleTensors<D> tensors(const methods::mps::GroundStrength<D>& ground, Index particle) const;
  void write(std::size_t i, const methods::mps::ParticleTensors<D>& tensors);

  const cases::MpsCase* mps_;
  const MpsModel<D>* model_;
  std::optional<methods::mps::GroundStrength<D>> elastic_;  ///< of a model without a strength
  methods::mps::Tensors<D> stretch_;
  std::vector<Vector3> normal_stress_, shear_stress_, normal_strain_, shear_strain_;
  std::vector<Real> pressure_, von_mises_, equivalent_;
};

extern template class TensorFields<2>;
extern template class TensorFields<3>;

}  // namespace sazare::runs
