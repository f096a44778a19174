#include "sazare/methods/mps/linear_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace sazare::methods::mps {

namespace {

/// rotation x arm, from the rotations that follow D translations.
std::array<Real, 2> turned(const Real* rotation, const std::array<Real, 2>& arm) {
  return {-rotation[0] * arm[1], rotation[0] * arm[0]};
}
std::array<Real, 3> turned(const Real* rotation, const std::array<Real, 3>& arm) {
  return {rotation[1] * arm[2] - rotation[2] * arm[1], rotation[2] * arm[0] - rotation[0] * arm[2],
          rotation[0] * arm[1] - rotation[1] * arm[0]};
}

/// Adds factor * arm x force.
void add_moment(Real* torque, Real factor, const std::array<Real, 2>& arm, const std::array<Real, 2>& force) {
  torque[0] += factor * (arm[0] * force[1] - arm[1] * force[0]);
}
void add_moment(Real* torque, Real factor, const std::array<Real, 3>& arm, const std::array<Real, 3>& force) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
    torque[i] += factor * (arm[next] * force[last] - arm[last] * force[next]);
  }
}

template <std::size_t D>
Real along(const std::array<Real, D>& start, const std::array<Real, D>& vector) {
  Real square = 0, product = 0;
  for (std::size_t i = 0; i < D; ++i) {
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
std::array<Real, D> LinearStiffness<D>::deformation(const laws::LinkDirection<D>& law, std::size_t i, std::size_t j) const {
  const Real *own = &motion_[freedoms * i], *other = &motion_[freedoms * j];
  const std::array<Real, D> first = turned(own + D, law.start), second = turned(other + D, law.start);
  std::array<Real, D> u;
  for (std::size_t axis = 0; axis < D; ++axis) u[axis] = other[axis] - own[axis] - 0.5 * (first[axis] + second[axis]);
  return u;
}

template <int D>
void LinearStiffness<D>::add_force(const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j,
                                   std::span<Real> y) const {
  const Real spring = share * law.spring * 0.5 * (particles_.shear_modulus[i] + particles_.shear_modulus[j]);
  const Real push = share * law.divergence * (pressure_[i] + pressure_[j]);
  std::array<Real, D> force = deformation(law, i, j);
  Real length = 0;
  for (std::size_t axis = 0; axis < D; ++axis) length += law.start[axis] * law.start[axis];
  length = std::sqrt(length);
  for (std::size_t axis = 0; axis < D; ++axis) force[axis] = spring * force[axis] + push * law.start[axis] / length;
  for (std::size_t axis = 0; axis < D; ++axis) y[freedoms * i + axis] -= force[axis];
  add_moment(&y[freedoms * i + D], -0.5, law.start, force);
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
    pressure_[i] += share * law.divergence * along(law.start, deformation(law, i, j));
  });
  for (std::size_t i = 0; i < pressure_.size(); ++i) pressure_[i] *= particles_.volume() * particles_.lame[i];
  std::ranges::fill(y, 0);
  each_link([&](const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j) { add_force(law, share, i, j, y); });
  for (std::size_t row = 0; row < scale_.size(); ++row) y[row] *= scale_[row];
}

template class LinearStiffness<2>;
template class LinearStiffness<3>;

}  // namespace sazare::methods::mps
