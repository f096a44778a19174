#pragma once

/// Ground that flows: each particle remembers a plastic strain, to which its links relax. It flows where it reaches a strength,
/// or degrades with strain (degrading_ground.hpp).

#include <optional>

#include "sazare/laws/mohr_coulomb.hpp"
#include "sazare/methods/mps/degrading_ground.hpp"
#include "sazare/methods/mps/softening.hpp"

namespace sazare::methods::mps {

/// What the particles of one material are made of.
struct StrengthOfGround {
  bool yields = false;  ///< else it is elastic whatever happens
  laws::MohrCoulomb law;
  laws::Elasticity elastic;
  Real density = 0;         ///< [kg/m3]
  Real rupture_strain = 0;  ///< slip at which links break [-]
  std::vector<laws::OverlayPart> parts = {};  ///< of soil that degrades with strain, without a strength; else none
  std::optional<Softening> softening = {};    ///< of the law with slip

  /// The strength after a share of its fall.
  laws::MohrCoulomb strength(Real share) const { return softening ? softening->law.at(law, share) : law; }
  /// What large strains leave; broken ground has its friction.
  laws::MohrCoulomb residual_strength() const { return strength(1); }
};

/// Strain of a particle since its unstressed state and its stress, in space.
template <int D>
struct ParticleTensors {
  Rotation<D> strain = Rotation<D>::Zero();  ///< [-]
  Rotation<D> stress = Rotation<D>::Zero();  ///< tension is positive [Pa]
  Real across = 0;                           ///< stress across the plane, in 2-D [Pa]
};

/// Strains of particles from their links, and the plastic strains that keep the stresses within the strength.
///
///     e = sym(R^T H S^-1) - 1 - e_p,   H = sum_j g r r0^T,   S = sum_j g r0 r0^T,   g = d w/(n0 |r0|^2)
///
/// is exact for any homogeneous strain, with however many links a particle has left. A particle whose links no longer span the
/// space has no strain to tell, and does not flow. The frame of a particle is A = R (1 + e_p): a link relaxes to the mean plastic
/// strain of its particles. The strain of a particle takes its own alone; with the mean of the links instead, every second
/// particle would flow, twice as much.
template <int D>
class GroundStrength {
public:
  static constexpr std::size_t numbers = static_cast<std::size_t>(D) * D;

  /// `material` says by particle which of the grounds it is made of.
  GroundStrength(const state::Particles<D>& particles, const LinkTable<D>& links, std::vector<StrengthOfGround> grounds,
                 std::vector<Index> material);

  const StrengthOfGround& ground(Index particle) const {
    return grounds_[static_cast<std::size_t>(material_[static_cast<std::size_t>(particle)])];
  }

  void make_frames(const state::Particles<D>& particles, Frames<numbers>& frames) const;

  /// Lets every particle flow whose stress is beyond its strength; `stretch` as measure_stretch gives it.
  void flow(const state::Particles<D>& particles, const Tensors<D>& stretch);

  /// Which particles have flowed in the last call of `flow`: a byte each, 1 of ground that may break, 2 of ground that degrades,
  /// else 0.
  const std::vector<std::uint8_t>& flowed() const { return flowed_; }

  /// e_p of a particle [-].
  Rotation<D> plastic(Index particle) const;
  /// Engineering shear strain of e_p: the difference of its largest and its smallest part [-].
  Real plastic_shear(Index particle) const;
  /// What `flow` has added to e_p of the particles that have flowed [-].
  const Tensors<D>& last_flow() const { return last_flow_; }

  /// Stress of a particle, in space; none where its links do not span the space.
  Rotation<D> stress(const state::Particles<D>& particles, const Tensors<D>& stretch, Index particle) const;
  /// The same with the strain, which is all of it, elastic and plastic.
  ParticleTensors<D> tensors(const state::Particles<D>& particles, const Tensors<D>& stretch, Index particle) const;

  /// To be called when links of a particle have changed.
  void measure(Index particle, const LinkTable<D>& links);

  /// Slip of ground that flows without links.
  void add_slip(Index particle, Real slip) { slip_[at(particle)] += slip; }
  bool is_ruptured(Index particle) const;

  const state::Column& slip() const { return slip_; }  ///< of each particle, summed up [-]
  const DegradingGround<D>& degrading() const { return degrading_; }

  void columns(Archive& archive);

private:
  Rotation<D> elastic_strain(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t i) const;
  void degrade(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t pack);
  bool flow_one(const state::Particles<D>& particles, const Tensors<D>& stretch, std::size_t i);

  std::vector<StrengthOfGround> grounds_;
  std::vector<Index> material_;
  Tensors<D> plastic_;  ///< e_p [-]
  Tensors<D> inverse_;  ///< S^-1; zero where the links do not span the space
  Tensors<D> last_flow_;  ///< of particles that have flowed [-]
  state::Column slip_;
  state::Column fallen_;  ///< share of the fall of the strength [-]; empty where nothing softens
  std::vector<std::uint8_t> flowed_;
  DegradingGround<D> degrading_;
  bool any_yields_ = false;
};

extern template class GroundStrength<2>;
extern template class GroundStrength<3>;

}  // namespace sazare::methods::mps
