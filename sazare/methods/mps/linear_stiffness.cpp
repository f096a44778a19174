#include "sazare/methods/mps/linear_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace sazare::methods::mps {

namespace {

/// The part of a vector along `start`.
template <int D>
Real along(const Vector<D>& start, const Vector<D>& vector) {
  Real square = 0, product = 0;
  for (int i = 0; i < D; ++i) {
    square += start[i] * start[i];
    product += start[i] * vector[i];
  }
  return product / std::sqrt(square);
}

}  // namespace

template <int D>
LinearStiffness<D>::LinearStiffness(const state::Particles<D>& particles, const LinkTable<D>& links,
                                    const particles::ParticleSupports<D>& supports)
    : particles_(particles),
      links_(links),
      scale_(freedoms * particles.size()),
      motion_(scale_.size()),
      pressure_(particles.size()) {
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t freedom = 0; freedom < freedoms; ++freedom)
      scale_[freedoms * i + freedom] = std::sqrt(particles.inverse_inertia_of(freedom)[i]);
  const auto hold = [&](Index particle, int freedom) {
    scale_[freedoms * static_cast<std::size_t>(particle) + static_cast<std::size_t>(freedom)] = 0;
  };
  for (const auto& held : supports.held) hold(held.particle, held.freedom);
  for (const auto& driven : supports.driven) hold(driven.particle, driven.freedom);
}

template <int D>
Vector<D> LinearStiffness<D>::deformation(const laws::LinkDirection<D>& law, std::size_t i, std::size_t j) const {
  using Translation = Eigen::Map<const Vector<D>>;
  using Turn = Eigen::Map<const Angular<D>>;
  const Real *own = &motion_[freedoms * i], *other = &motion_[freedoms * j];
  const Vector<D> first = turned(Angular<D>(Turn(own + D)), law.start), second = turned(Angular<D>(Turn(other + D)), law.start);
  return Translation(other) - Translation(own) - 0.5 * (first + second);
}

template <int D>
void LinearStiffness<D>::add_force(const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j,
                                   std::span<Real> y) const {
  const Real spring = share * law.spring * 0.5 * (particles_.shear_modulus[i] + particles_.shear_modulus[j]);
  const Real push = share * law.divergence * (pressure_[i] + pressure_[j]);
  const Real length = std::sqrt(laws::product<D, Real>(law.start, law.start));
  const Vector<D> force = spring * deformation(law, i, j) + push * law.start / length;
  Eigen::Map<Vector<D>>(&y[freedoms * i]) -= force;
  Eigen::Map<Angular<D>>(&y[freedoms * i + D]) -= 0.5 * moment(law.start, force);
}

template <int D>
void LinearStiffness<D>::apply(std::span<const Real> x, std::span<Real> y) {
  for (std::size_t row = 0; row < scale_.size(); ++row) motion_[row] = scale_[row] * x[row];
  const auto each_link = [&](auto&& visit) {
    for (std::size_t i = 0; i < particles_.size(); ++i)
      for (std::size_t n = 0; n < links_.directions.size(); ++n)
        if (const Real share = links_.share(n, static_cast<Index>(i)); share > 0)
          visit(links_.directions[n].law, share, i, static_cast<std::size_t>(links_.directions[n].neighbor[i]));
  };
  std::ranges::fill(pressure_, 0);
  each_link([&](const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j) {
    pressure_[i] += share * law.divergence * along<D>(law.start, deformation(law, i, j));
  });
  for (std::size_t i = 0; i < pressure_.size(); ++i) pressure_[i] *= particles_.volume() * particles_.lame[i];
  std::ranges::fill(y, 0);
  each_link([&](const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j) { add_force(law, share, i, j, y); });
  for (std::size_t row = 0; row < scale_.size(); ++row) y[row] *= scale_[row];
}

template class LinearStiffness<2>;
template class LinearStiffness<3>;

}  // namespace sazare::methods::mps
