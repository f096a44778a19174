#pragma once

/// Ground that degrades with strain (laws/soil/overlay_pack.hpp): what its particles remember, by packs.
///
/// Links are elastic and relax to the plastic strain e_p of their particles. With the mean plastic strain p of the parts by their
/// stiffness,
///
///     s = C (e - p)        e_p = p in space, p + nu p_zz 1 in the plane
///
/// is the stress of all parts, in the plane its part in it. They store elastically, beyond the energy of the links,
///
///     H = V (sum of G_i |p_i - p|^2/2 + E p_zz^2/2)       the last part in the plane only
///
///     C, G0, E, nu   elasticity of the ground      V   volume of a particle, as far as its links tell of it
///
/// and dissipate what the flow of e_p takes from the links less the growth of H.

#include <optional>

#include "sazare/laws/mohr_coulomb.hpp"
#include "sazare/laws/soil/overlay_pack.hpp"
#include "sazare/laws/soil/overlay_plasticity.hpp"
#include "sazare/methods/mps/link_forces.hpp"

namespace sazare::methods::mps {

/// A ground as its packs need it.
struct DegradingSoil {
  laws::Elasticity elastic;
  std::vector<laws::OverlayPart> parts;  ///< none where it does not degrade
};

template <int D>
class DegradingGround {
public:
  using Tensor = std::array<Lanes, static_cast<std::size_t>(D) * D>;

  DegradingGround() = default;

  /// `material` says by particle which of the soils it is made of; `volume` is V.
  DegradingGround(std::span<const DegradingSoil> soils, std::span<const Index> material, std::vector<Real> volume);

  bool empty() const { return kinds_.empty(); }
  bool holds(std::size_t pack) const { return !empty() && kind_[pack] >= 0; }
  bool holds_particle(Index particle) const {
    const auto i = static_cast<std::size_t>(particle);
    return holds(i / lane_count) && kinds_[at(kind_[i / lane_count])].is_soil[i % lane_count] != 0;
  }

  /// Takes a pack to a strain, by rows; `spans` marks the particles that have one. Whether one flows: then `grown` is left with
  /// what e_p of each has grown by, and the size of the flow is added to `slip`.
  bool flow(std::size_t pack, const Tensor& strain, LaneMask spans, Real* slip, Tensor& grown);

  Real stored() const;  ///< H of all particles [J; J/m in 2-D]

  Real peak(Index particle) const;  ///< largest shear strain so far [-]

  void columns(Archive& archive);

private:
  using Pack = laws::OverlayPack<D>;
  /// What the soils of the particles of a pack are.
  struct Kind {
    std::array<Index, lane_count> material{};
    laws::PartsOfPack parts;
    LaneMask is_soil{};
    Lanes shear_modulus{}, poisson_ratio{};
  };

  Index kind_of(std::span<const DegradingSoil> soils, const std::array<Index, lane_count>& material);

  std::vector<Kind> kinds_;
  std::vector<Index> kind_;         ///< by pack; -1 where nothing degrades
  std::vector<std::size_t> begin_;  ///< by pack: its memory
  std::vector<Real> volume_;        ///< by particle, padded [m3; m2 in 2-D]
  state::Column memory_;
  state::Column square_of_peak_;  ///< by particle, padded [-]
};

extern template class DegradingGround<2>;
extern template class DegradingGround<3>;

}  // namespace sazare::methods::mps
