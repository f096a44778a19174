#pragma once

/// Soil that degrades with strain: elastic-perfectly plastic parts in parallel, of one elastic volume.
///
///     s = K tr(e) 1 + sum 2 G_i (e' - p_i)
///     |e' - p_i| <= g_i,  |x|^2 = 2 x:x                      von Mises: in simple shear |x| is engineering shear strain
///     p_i  grows along e' - p_i, back to g_i where it is beyond      radial return, exact where the strain keeps its direction
///
///     s   stress [Pa]           K    bulk modulus [Pa]            G_i  shear modulus of a part [Pa]
///     e   strain, e' its deviator [-]     p_i  plastic strain [-]     g_i  shear strain at which a part yields [-]
///
/// G_i are the changes of slope of a backbone curve (backbone_curve.hpp) at its corners g_i: the sum of the parts is that polygon
/// in a first loading, and follows Masing's rules afterwards. Each part dissipates 2 G_i (e' - p_i):dp_i, never less than 0, also
/// with the mean of the stresses before and after; no closed path of strain gains energy, from whatever state. Iwan, J. Appl.
/// Mech. 34 (1967) 612-617; in space, each part is that of von Mises: Besseling, J. Appl. Mech. 25 (1958) 529-536.
///
/// Columns of strain: xx, yy, zz, xy and with N = 6 also yz, zx, shear strains are engineering ones; of stress the same with
/// tensor's parts.

#include <span>

#include "sazare/laws/mohr_coulomb.hpp"
#include "sazare/laws/soil/backbone_curve.hpp"

namespace sazare::laws {

struct OverlayPart {
  Real shear_modulus = 0;  ///< G_i [Pa]
  Real yield_strain = 0;   ///< g_i [-]
};

struct OverlayEnergies {
  Real elastic = 0;  ///< stored [J/m3]
  Real plastic = 0;  ///< dissipated between two states [J/m3]
};

template <int N>
class OverlayModel {
  static_assert(N == 4 || N == 6);

public:
  using Column = Eigen::Matrix<Real, N, 1>;
  using Square = Eigen::Matrix<Real, N, N>;

  OverlayModel() = default;
  OverlayModel(const Elasticity& elastic, const BackboneCurve& curve)
      : bulk_modulus_(elastic.lame + 2 * elastic.shear_modulus / 3), shear_modulus_(elastic.shear_modulus) {
    const auto& slope = curve.slope();
    for (std::size_t i = 0; i < slope.size(); ++i)
      parts_.push_back({slope[i] - (i + 1 < slope.size() ? slope[i + 1] : 0), curve.corner_strain()[i]});
  }

  const std::vector<OverlayPart>& parts() const { return parts_; }

  /// Numbers that a point remembers: the plastic strain of each part, then `slip` and `peak`.
  std::size_t memory_size() const { return parts_.size() * N + 2; }

  /// Shear strain of the plastic flow so far, of all parts by their stiffness [-].
  Real slip(std::span<const Real> memory) const { return memory[parts_.size() * N]; }
  /// Largest shear strain |e'| so far [-].
  Real peak(std::span<const Real> memory) const { return memory[parts_.size() * N + 1]; }

  /// Stress of a strain, and the memory that it leaves; `tangent`, where asked for, is that of the stress by the strain,
  /// symmetric.
  Column respond(const Column& strain, std::span<const Real> before, std::span<Real> after, Square* tangent) const {
    const Column deviator = deviator_of(strain);
    Column sum = Column::Zero(), flow = Column::Zero();
    Real stiffness = 0;
    Square turning = Square::Zero();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const OverlayPart& part = parts_[i];
      const Column old = plastic(before, i), trial = deviator - old;
      const Real reach = shear_of(trial);
      const Real kept = reach > part.yield_strain ? part.yield_strain / reach : 1;
      const Column change = (1 - kept) * trial;
      Eigen::Map<Column>(after.data() + i * N) = old + change;
      sum += (part.shear_modulus * kept) * trial;
      stiffness += part.shear_modulus * kept;
      if (!(kept < 1)) continue;
      flow += (part.shear_modulus / shear_modulus_) * change;
      if (tangent == nullptr) continue;
      const Column stress = stress_of(trial);
      turning += (part.shear_modulus * kept / (reach * reach)) * (stress * stress.transpose());
    }
    after[parts_.size() * N] = slip(before) + shear_of(flow);
    after[parts_.size() * N + 1] = std::max(peak(before), shear_of(deviator));
    if (tangent != nullptr) *tangent = isotropic(stiffness) - turning;
    return with_pressure(stress_of(sum), strain);
  }

  /// Stress of a strain whose memory is already that of it.
  Column stress(const Column& strain, std::span<const Real> memory) const {
    const Column deviator = deviator_of(strain);
    Column sum = Column::Zero();
    for (std::size_t i = 0; i < parts_.size(); ++i) sum += parts_[i].shear_modulus * (deviator - plastic(memory, i));
    return with_pressure(stress_of(sum), strain);
  }

  /// Energies of a state, and what has been dissipated since another: the work of the mean stress of each part on its flow.
  OverlayEnergies energies(const Column& strain_before, const Column& strain, std::span<const Real> before,
                           std::span<const Real> after) const {
    const Column old = deviator_of(strain_before), now = deviator_of(strain);
    const Real volume = strain.template head<3>().sum();
    OverlayEnergies result{0.5 * bulk_modulus_ * volume * volume, 0};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Column held = now - plastic(after, i), held_before = old - plastic(before, i);
      const Real shear = shear_of(held), modulus = parts_[i].shear_modulus;
      result.elastic += 0.5 * modulus * shear * shear;
      const Column flow = plastic(after, i) - plastic(before, i);
      result.plastic += 0.5 * modulus * flow.dot(stress_of(held + held_before));
    }
    return result;
  }

  /// |x| of a deviatoric strain [-].
  static Real shear_of(const Column& x) {
    return std::sqrt(2 * x.template head<3>().squaredNorm() + x.template tail<N - 3>().squaredNorm());
  }

private:
  static Eigen::Map<const Column> plastic(std::span<const Real> memory, std::size_t part) {
    return Eigen::Map<const Column>(memory.data() + part * N);
  }

  static Column deviator_of(const Column& strain) {
    Column deviator = strain;
    deviator.template head<3>().array() -= strain.template head<3>().sum() / 3;
    return deviator;
  }

  /// 2 x by the tensor's parts: the stress of a deviatoric strain where G is 1.
  static Column stress_of(const Column& x) {
    Column stress = x;
    stress.template head<3>() *= 2;
    return stress;
  }

  Column with_pressure(Column stress, const Column& strain) const {
    stress.template head<3>().array() += bulk_modulus_ * strain.template head<3>().sum();
    return stress;
  }

  Square isotropic(Real shear_modulus) const {
    Square c = Square::Zero();
    c.template topLeftCorner<3, 3>().setConstant(bulk_modulus_ - 2 * shear_modulus / 3);
    for (int i = 0; i < N; ++i) c(i, i) += (i < 3 ? 2 : 1) * shear_modulus;
    return c;
  }

  Real bulk_modulus_ = 0, shear_modulus_ = 0;
  std::vector<OverlayPart> parts_;
};

}  // namespace sazare::laws
