#pragma once

#include <span>
#include <vector>

#include "sazare/methods/mps/link_table.hpp"
#include "sazare/particles/particle_supports.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::methods::mps {

/// M^-1/2 K M^-1/2 of a model at rest in its start positions; symmetric. Rows of degrees of freedom that are held or driven are
/// zero. Vectors hold the degrees of freedom of a particle one after the other.
template <int D>
class LinearStiffness {
public:
  LinearStiffness(const state::Particles<D>& particles, const LinkTable<D>& links,
                  const particles::ParticleSupports<D>& supports);

  std::size_t rows() const { return scale_.size(); }
  void apply(std::span<const Real> x, std::span<Real> y);

private:
  static constexpr std::size_t freedoms = state::particle_freedoms<D>;

  Vector<D> deformation(const laws::LinkDirection<D>& law, std::size_t i, std::size_t j) const;
  void add_force(const laws::LinkDirection<D>& law, Real share, std::size_t i, std::size_t j, std::span<Real> y) const;

  const state::Particles<D>& particles_;
  const LinkTable<D>& links_;
  std::vector<Real> scale_;  ///< M^-1/2, 0 where held
  std::vector<Real> motion_;
  std::vector<Real> pressure_;
};

extern template class LinearStiffness<2>;
extern template class LinearStiffness<3>;

}  // namespace sazare::methods::mps
