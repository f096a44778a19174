#include "sazare/methods/mps/ground_strength.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 1024;  // particles
constexpr std::size_t serial_packs = 128;
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

template <int D>
using LaneTensor = std::array<Lanes, static_cast<std::size_t>(D) * D>;

template <int D>
LaneTensor<D> load(const Tensors<D>& tensors, std::size_t first) {
  LaneTensor<D> tensor;
  for (std::size_t n = 0; n < tensor.size(); ++n) tensor[n] = load_lanes(&tensors[n][first]);
  return tensor;
}

template <int D>
LaneTensor<D> turn_of(const state::Particles<D>& particles, std::size_t first) {
  if constexpr (D == 2) {
    const Lanes cosine = load_lanes(&particles.rotation[0][first]), sine = load_lanes(&particles.rotation[1][first]);
    return {cosine, -sine, sine, cosine};
  } else {
    return load<D>(particles.rotation, first);
  }
}

template <int D>
LaneTensor<D> transposed(const LaneTensor<D>& tensor) {
  LaneTensor<D> result;
  for (std::size_t row = 0; row < D; ++row)
    for (std::size_t column = 0; column < D; ++column) result[D * row + column] = tensor[D * column + row];
  return result;
}

template <int D>
LaneTensor<D> product(const LaneTensor<D>& a, const LaneTensor<D>& b) {
  LaneTensor<D> result{};
  for (std::size_t row = 0; row < D; ++row)
    for (std::size_t column = 0; column < D; ++column)
      for (std::size_t k = 0; k < D; ++k) result[D * row + column] += a[D * row + k] * b[D * k + column];
  return result;
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

/// Sum over the links of a particle of d w/(n0 |r0|^2) r0 r0^T: 1 for a whole neighbourhood.
template <int D>
Rotation<D> spread_of(const LinkTable<D>& links, Index particle) {
  Rotation<D> spread = Rotation<D>::Zero();
  for (std::size_t n = 0; n < links.directions.size(); ++n) {
    const laws::LinkDirection<D>& law = links.directions[n].law;
    const Vector<D>& start = law.start;
    spread += links.share(n, particle) * law.divergence / start.norm() * start * start.transpose();
  }
  return spread;
}

/// Volume of each particle as far as its links tell of it: all of an inner one's, less at a surface.
template <int D>
std::vector<Real> volumes_told(const state::Particles<D>& particles, const LinkTable<D>& links) {
  std::vector<Real> volumes(particles.padded(), 0);
  for (Index i = 0; i < particles.count; ++i) volumes[at(i)] = particles.volume() * spread_of<D>(links, i).trace() / D;
  return volumes;
}

}  // namespace

template <int D>
GroundStrength<D>::GroundStrength(const state::Particles<D>& particles, const LinkTable<D>& links,
                                  std::vector<StrengthOfGround> grounds, std::vector<Index> material)
    : grounds_(std::move(grounds)), material_(std::move(material)), slip_(particles.padded(), 0), flowed_(particles.padded(), 0) {
  for (auto* tensors : {&plastic_, &inverse_, &last_flow_})
    for (state::Column& column : *tensors) column.assign(particles.padded(), 0);
  for (Index i = 0; i < particles.count; ++i) measure(i, links);
  any_yields_ = std::ranges::any_of(grounds_, &StrengthOfGround::yields);
  const auto softens = [](const StrengthOfGround& ground) { return ground.softening.has_value(); };
  if (std::ranges::any_of(grounds_, softens)) fallen_.assign(particles.padded(), 0);
  std::vector<DegradingSoil> soils;
  for (const StrengthOfGround& ground : grounds_) soils.push_back({ground.elastic, ground.parts});
  degrading_ = DegradingGround<D>(soils, material_, volumes_told(particles, links));
  for (Index i = 0; i < particles.count; ++i)
    if (degrading_.holds_particle(i)) flowed_[at(i)] = 2;
}

template <int D>
void GroundStrength<D>::measure(Index particle, const LinkTable<D>& links) {
  const Rotation<D> spread = spread_of<D>(links, particle);
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
void GroundStrength<D>::degrade(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t pack) {
  const std::size_t first = pack * lane_count;
  const LaneTensor<D> turn = turn_of(particles, first),
                      gradient = product<D>(transposed<D>(turn), product<D>(load<D>(stretch, first), load<D>(inverse_, first)));
  LaneTensor<D> strain;
  for (std::size_t row = 0; row < D; ++row)
    for (std::size_t column = 0; column < D; ++column)
      strain[D * row + column] = 0.5 * (gradient[D * row + column] + gradient[D * column + row]) - (row == column ? 1.0 : 0.0);
  LaneTensor<D> flowed{};
  const bool flows = degrading_.flow(pack, strain, load_lanes(&inverse_[0][first]) != 0.0, &slip_[first], flowed);
  for (std::size_t n = 0; n < numbers; ++n) {
    store_lanes(&last_flow_[n][first], flowed[n]);
    if (flows) store_lanes(&plastic_[n][first], load_lanes(&plastic_[n][first]) + flowed[n]);
  }
}

template <int D>
bool GroundStrength<D>::flow_one(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t i) {
  const StrengthOfGround& ground = grounds_[at(material_[i])];
  if (inverse_[0][i] == 0) return false;
  const Rotation<D> elastic = elastic_strain(particles, stretch, i);
  const auto [largest, smallest] = extreme_stresses<D>(ground.elastic, elastic);
  const laws::MohrCoulomb strength = ground.softening ? ground.strength(fallen_[i]) : ground.law;
  if (strength.bears(largest, smallest)) return false;
  Eigen::SelfAdjointEigenSolver<Rotation<D>> solver;
  solver.computeDirect(elastic);
  std::array<Real, D> strain;
  for (int axis = 0; axis < D; ++axis) strain[static_cast<std::size_t>(axis)] = solver.eigenvalues()[axis];
  laws::PlasticFlow<D> flow;
  if (ground.softening) {
    const Real softening_strain = ground.softening->strain(ground.law, strength, -0.5 * (largest + smallest));
    flow = laws::softening_flow<D>(ground.law, ground.softening->law, ground.elastic, fallen_[i], softening_strain, strain);
    fallen_[i] = std::min(fallen_[i] + flow.slip / softening_strain, Real{1});
  } else {
    flow = laws::plastic_flow<D>(ground.law, ground.elastic, strain);
  }
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
  if (!degrading_.empty())
    parallel::parallel_for(particles.padded() / lane_count, serial_packs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t pack = begin; pack < end; ++pack)
        if (degrading_.holds(pack)) degrade(particles, stretch, pack);
    });
  if (!any_yields_) return;
  parallel::parallel_for(particles.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (grounds_[at(material_[i])].yields) flowed_[i] = flow_one(particles, stretch, i) ? 1 : 0;
  });
}

template <int D>
Rotation<D> GroundStrength<D>::plastic(Index particle) const {
  return read<D>(plastic_, at(particle));
}

template <int D>
Real GroundStrength<D>::plastic_shear(Index particle) const {
  const Eigen::SelfAdjointEigenSolver<Rotation<D>> solver(plastic(particle), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[D - 1] - solver.eigenvalues()[0];
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

/// Of soil that degrades e_p holds p + nu p_zz 1 (degrading_ground.hpp), whose trace is -(1 - 2 nu) p_zz.
template <int D>
ParticleTensors<D> GroundStrength<D>::tensors(const state::Particles<D>& particles, const Tensors<D>& stretch,
                                              Index particle) const {
  const std::size_t i = at(particle);
  if (inverse_[0][i] == 0) return {};
  const Rotation<D> elastic = elastic_strain(particles, stretch, i), rotation = rotation_of(particles, i);
  ParticleTensors<D> found;
  found.strain = rotation * (elastic + read<D>(plastic_, i)) * rotation.transpose();
  found.stress = stress(particles, stretch, particle);
  if constexpr (D == 2) {
    const auto [mu, lambda] = ground(particle).elastic;
    found.across = lambda * elastic.trace();
    if (degrading_.holds_particle(particle)) {
      const Real poisson_ratio = 0.5 * lambda / (lambda + mu);
      found.across += 2 * mu * (1 + poisson_ratio) * plastic(particle).trace() / (1 - 2 * poisson_ratio);  // -E p_zz
    }
  }
  return found;
}

template <int D>
bool GroundStrength<D>::is_ruptured(Index particle) const {
  return ground(particle).yields && slip_[at(particle)] >= ground(particle).rupture_strain;
}

template <int D>
void GroundStrength<D>::columns(Archive& archive) {
  for (std::size_t n = 0; n < numbers; ++n) archive("plastic" + std::to_string(n), plastic_[n]);
  archive("slip", slip_);
  if (!fallen_.empty()) archive("fallen", fallen_);
  archive.folder("degrading", [&] { degrading_.columns(archive); });
}

template class GroundStrength<2>;
template class GroundStrength<3>;

}  // namespace sazare::methods::mps
