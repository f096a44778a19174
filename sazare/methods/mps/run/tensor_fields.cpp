#include "sazare/methods/mps/run/tensor_fields.hpp"

#include <cmath>

#include "sazare/methods/mps/run/columns.hpp"
#include "sazare/observe/column.hpp"

namespace sazare::runs {

namespace {

/// xy, yz, zx; xy alone in the plane.
template <int D>
Vector3 off_diagonal(const Rotation<D>& tensor) {
  if constexpr (D == 2)
    return {tensor(0, 1), 0, 0};
  else
    return {tensor(0, 1), tensor(1, 2), tensor(2, 0)};
}

template <int D>
Vector3 diagonal(const Rotation<D>& tensor, Real across) {
  if constexpr (D == 2)
    return {tensor(0, 0), tensor(1, 1), across};
  else
    return tensor.diagonal();
}

/// The square of the size of a deviator: of its diagonal, and of what stands beside it.
Real square_of_deviator(const Vector3& normal, const Vector3& shear) {
  const Vector3 deviator = normal.array() - normal.mean();
  return deviator.squaredNorm() + 2 * shear.squaredNorm();
}

}  // namespace

template <int D>
const methods::mps::GroundStrength<D>& TensorFields<D>::ground() {
  if (model_->failing != nullptr) return model_->failing->strength();
  if (!elastic_)
    elastic_.emplace(model_->stepper->particles(), *model_->links,
                     strengths_of(*mps_, softening_place<D>(*mps_, *model_->links, model_->filling, model_->material)),
                     model_->material);
  return *elastic_;
}

/// Broken ground in the plane is taken to be elastic across it, as all ground that yields is.
template <int D>
methods::mps::ParticleTensors<D> TensorFields<D>::tensors(const methods::mps::GroundStrength<D>& ground, Index particle) const {
  if (model_->failing == nullptr || !model_->failing->gathered().holds(particle))
    return ground.tensors(model_->stepper->particles(), stretch_, particle);
  methods::mps::ParticleTensors<D> found;
  found.stress = model_->failing->gathered().state_of(particle).stress;
  const auto [mu, lambda] = ground.ground(particle).elastic;
  found.across = 0.5 * lambda / (lambda + mu) * found.stress.trace();
  return found;
}

template <int D>
void TensorFields<D>::write(std::size_t i, const methods::mps::ParticleTensors<D>& tensors) {
  normal_stress_[i] = diagonal<D>(tensors.stress, tensors.across);
  shear_stress_[i] = off_diagonal<D>(tensors.stress);
  pressure_[i] = -normal_stress_[i].mean();
  von_mises_[i] = std::sqrt(1.5 * square_of_deviator(normal_stress_[i], shear_stress_[i]));
  normal_strain_[i] = diagonal<D>(tensors.strain, 0);
  const Vector3 half = off_diagonal<D>(tensors.strain);
  shear_strain_[i] = 2 * half;
  equivalent_[i] = std::sqrt(2 * square_of_deviator(normal_strain_[i], half));
}

template <int D>
std::vector<observe::CellData> TensorFields<D>::measure() {
  const auto& particles = model_->stepper->particles();
  for (state::Column& column : stretch_) column.resize(particles.padded());
  for (auto* vectors : {&normal_stress_, &shear_stress_, &normal_strain_, &shear_strain_}) vectors->resize(particles.size());
  for (auto* numbers : {&pressure_, &von_mises_, &equivalent_}) numbers->resize(particles.size());
  methods::mps::measure_stretch(*model_->links, particles, stretch_);
  const auto& of_ground = ground();
  for (std::size_t i = 0; i < particles.size(); ++i) write(i, tensors(of_ground, static_cast<Index>(i)));
  return observe::cell_data(columns::mps::tensors, normal_stress_, shear_stress_, pressure_, von_mises_, normal_strain_,
                            shear_strain_, equivalent_);
}

template class TensorFields<2>;
template class TensorFields<3>;

}  // namespace sazare::runs
