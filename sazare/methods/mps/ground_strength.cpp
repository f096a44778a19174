#include "sazare/methods/mps/ground_strength.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 1024;  // particles
constexpr Real least_span = 0.05;           // of the spread of links over that of a whole neighbourhood

Real square(Real number) { return number * number; }

template <int D>
Rotation<D> rotation_of(const state::Particles<D>& particles, std::size_t i) {
  Rotation<D> rotation;
  if constexpr (D == 2) {
    rotation << particles.rotation[0][i], -particles.rotation[1][i], particles.rotation[1][i], particles.rotation[0][i];
  } else {
    for (std::size_t n = 0; n < 9; ++n) rotation(static_cast<int>(n / 3), static_cast<int>(n % 3)) = particles.rotation[n][i];
  }
  return rotation;
}

template <int D>
Rotation<D> read(const Tensors<D>& tensors, std::size_t i) {
  Rotation<D> tensor;
  for (int n = 0; n < D * D; ++n) tensor(n / D, n % D) = tensors[static_cast<std::size_t>(n)][i];
  return tensor;
}

template <int D>
void write(Tensors<D>& tensors, std::size_t i, const Rotation<D>& tensor) {
  for (int n = 0; n < D * D; ++n) tensors[static_cast<std::size_t>(n)][i] = tensor(n / D, n % D);
}

/// Largest and smallest principal stress of an elastic strain.
template <int D>
std::pair<Real, Real> extreme_stresses(const laws::Elasticity& elastic, const Rotation<D>& strain) {
  Real largest, smallest;
  if constexpr (D == 2) {
    const Real middle = 0.5 * (strain(0, 0) + strain(1, 1)),
               radius = std::sqrt(0.25 * square(strain(0, 0) - strain(1, 1)) + square(strain(0, 1)));
    largest = middle + radius;
    smallest = middle - radius;
  } else {
    const Vector<D> principal =
        Eigen::SelfAdjointEigenSolver<Rotation<D>>().computeDirect(strain, Eigen::EigenvaluesOnly).eigenvalues();
    largest = principal[D - 1];
    smallest = principal[0];
  }
  const Real pressure = elastic.lame * strain.trace();
  return {2 * elastic.shear_modulus * largest + pressure, 2 * elastic.shear_modulus * smallest + pressure};
}

}  // namespace

template <int D>
GroundStrength<D>::GroundStrength(const state::Particles<D>& particles, const LinkTable<D>& links,
                                  std::vector<StrengthOfGround> grounds, std::vector<Index> material)
    : grounds_(std::move(grounds)), material_(std::move(material)), slip_(particles.padded(), 0), flowed_(particles.padded(), 0) {
  for (auto* tensors : {&plastic_, &inverse_, &last_flow_})
    for (state::Column& column : *tensors) column.assign(particles.padded(), 0);
  for (Index i = 0; i < particles.count; ++i) measure(i, links);
}

template <int D>
void GroundStrength<D>::measure(Index particle, const LinkTable<D>& links) {
  Rotation<D> spread = Rotation<D>::Zero();
  for (std::size_t n = 0; n < links.directions.size(); ++n) {
    const laws::LinkDirection<D>& law = links.directions[n].law;
    const Vector<D>& start = law.start;
    spread += links.share(n, particle) * law.divergence / start.norm() * start * start.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Rotation<D>> solver(spread);  // the spread of a whole neighbourhood is 1 on every axis
  write<D>(inverse_, at(particle),
           solver.eigenvalues()[0] > least_span ? Rotation<D>(spread.inverse()) : Rotation<D>(Rotation<D>::Zero()));
}

template <int D>
void GroundStrength<D>::make_frames(const state::Particles<D>& particles, Frames<numbers>& frames) const {
  parallel::parallel_for(particles.padded(), serial_below, [&](std::size_t begin, std::size_t end) {
    if constexpr (D == 2) {
      const Real *c = particles.rotation[0].data(), *s = particles.rotation[1].data();
      const Real *xx = plastic_[0].data(), *xy = plastic_[1].data(), *yy = plastic_[3].data();
      Real *a = frames[0].data(), *b = frames[1].data(), *d = frames[2].data(), *e = frames[3].data();
      for (std::size_t i = begin; i < end; ++i) {
        a[i] = c[i] * (1 + xx[i]) - s[i] * xy[i];
        b[i] = c[i] * xy[i] - s[i] * (1 + yy[i]);
        d[i] = s[i] * (1 + xx[i]) + c[i] * xy[i];
        e[i] = s[i] * xy[i] + c[i] * (1 + yy[i]);
      }
      return;
    }
    for (std::size_t i = begin; i < end; ++i)
      write<D>(frames, i, rotation_of(particles, i) * (Rotation<D>::Identity() + read<D>(plastic_, i)));
  });
}

template <int D>
Rotation<D> GroundStrength<D>::elastic_strain(const state::Particles<D>& particles, const Tensors<D>& stretch,
                                              std::size_t i) const {
  const Rotation<D> gradient = rotation_of(particles, i).transpose() * read<D>(stretch, i) * read<D>(inverse_, i);
  return 0.5 * (gradient + gradient.transpose()) - Rotation<D>::Identity() - read<D>(plastic_, i);
}

template <int D>
bool GroundStrength<D>::flow_one(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t i) {
  const StrengthOfGround& ground = grounds_[at(material_[i])];
  if (!ground.yields) return false;
  if (inverse_[0][i] == 0) return false;
  const Rotation<D> elastic = elastic_strain(particles, stretch, i);
  const auto [largest, smallest] = extreme_stresses<D>(ground.elastic, elastic);
  if (ground.law.bears(largest, smallest)) return false;
  Eigen::SelfAdjointEigenSolver<Rotation<D>> solver;
  solver.computeDirect(elastic);
  std::array<Real, D> strain;
  for (int axis = 0; axis < D; ++axis) strain[static_cast<std::size_t>(axis)] = solver.eigenvalues()[axis];
  const auto flow = laws::plastic_flow<D>(ground.law, ground.elastic, strain);
  if (!(flow.slip > 0)) return false;
  Vector<D> part;
  for (std::size_t axis = 0; axis < D; ++axis) part[static_cast<int>(axis)] = flow.strain[axis];
  const Rotation<D>& axes = solver.eigenvectors();
  const Rotation<D> flowed = axes * part.asDiagonal() * axes.transpose();
  write<D>(last_flow_, i, flowed);
  write<D>(plastic_, i, read<D>(plastic_, i) + flowed);
  slip_[i] += flow.slip;
  return true;
}

template <int D>
void GroundStrength<D>::flow(const state::Particles<D>& particles, const Tensors<D>& stretch) {
  parallel::parallel_for(particles.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) flowed_[i] = flow_one(particles, stretch, i) ? 1 : 0;
  });
}

template <int D>
Rotation<D> GroundStrength<D>::plastic(Index particle) const {
  return read<D>(plastic_, at(particle));
}

template <int D>
Rotation<D> GroundStrength<D>::last_flow(Index particle) const {
  return read<D>(last_flow_, at(particle));
}

template <int D>
Rotation<D> GroundStrength<D>::stress(const state::Particles<D>& particles, const Tensors<D>& stretch, Index particle) const {
  const std::size_t i = at(particle);
  if (inverse_[0][i] == 0) return Rotation<D>::Zero();
  const Rotation<D> strain = elastic_strain(particles, stretch, i), rotation = rotation_of(particles, i);
  const laws::Elasticity& elastic = ground(particle).elastic;
  const Rotation<D> own = 2 * elastic.shear_modulus * strain + elastic.lame * strain.trace() * Rotation<D>::Identity();
  return rotation * own * rotation.transpose();
}

template <int D>
bool GroundStrength<D>::is_ruptured(Index particle) const {
  return ground(particle).yields && slip_[at(particle)] >= ground(particle).rupture_strain;
}

template <int D>
void GroundStrength<D>::columns(Archive& archive) {
  for (std::size_t n = 0; n < numbers; ++n) archive("plastic" + std::to_string(n), plastic_[n]);
  archive("slip", slip_);
}

template class GroundStrength<2>;
template class GroundStrength<3>;

}  // namespace sazare::methods::mps
