#pragma once

/// A material at a point: elastic, with a Mohr-Coulomb strength, or soil that degrades with strain.

#include <optional>
#include <span>
#include <string>
#include <variant>

#include "sazare/laws/cyclic_contraction.hpp"
#include "sazare/laws/principal_return.hpp"
#include "sazare/laws/soil/overlay_plasticity.hpp"
#include "sazare/laws/water/water_pressure.hpp"
#include "sazare/methods/fem/voigt.hpp"

#include <Eigen/Eigenvalues>

namespace sazare::methods::fem {

/// How water in the pores yields and flows.
struct PoreFlow {
  Real compressibility = 0;  ///< of the water in a volume of ground: porosity over the water's bulk modulus [1/Pa]
  Real mobility = 0;         ///< hydraulic conductivity over the specific weight of water [m2/(Pa s)]; 0: undrained
};

/// Ground below a water table: heavier, and with water in its pores. The stress of its law is the effective one.
struct Saturation {
  Real density = 0;  ///< of the ground with the water in it [kg/m3]
  laws::WaterPressure pore_water;  ///< at rest
  std::optional<PoreFlow> flow{};  ///< without it the pressure stays that at rest: drained
};

struct SolidMaterial {
  std::string name;
  laws::Elasticity elastic;
  Real density = 0;        ///< [kg/m3]
  Real damping_ratio = 0;  ///< of Rayleigh damping [-]
  std::optional<laws::MohrCoulomb> strength;
  std::optional<laws::CyclicContraction> contraction;  ///< with a strength only
  std::optional<laws::BackboneCurve> backbone;         ///< its shear modulus is that of `elastic`

  std::optional<Saturation> saturation;

  /// Density at a place, below the water table that of the saturated ground [kg/m3].
  Real density_at(const Vector3& place) const {
    return saturation && saturation->pore_water.depth(place) > 0 ? saturation->density : density;
  }

  /// Density times the velocity of P waves, for viscous boundaries [Pa s/m]: water that is not drained is part of the stiffness.
  Real p_wave_impedance(const Vector3& place) const {
    const bool stiffened = saturation && saturation->flow && saturation->pore_water.depth(place) > 0;
    const Real water = stiffened ? 1 / saturation->flow->compressibility : 0;
    return std::sqrt((elastic.lame + 2 * elastic.shear_modulus + water) * density_at(place));
  }
  Real s_wave_impedance(const Vector3& place) const { return std::sqrt(elastic.shear_modulus * density_at(place)); }

  static SolidMaterial elastic_of(Real youngs_modulus, Real poisson_ratio, Real density_) {
    SolidMaterial material;
    material.elastic = {youngs_modulus / (2 * (1 + poisson_ratio)),
                        youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))};
    material.density = density_;
    return material;
  }
  /// Whether its stress is the elastic one of its strain, always.
  bool is_elastic() const { return !strength && !backbone; }
  /// Whether the tangent is symmetric.
  bool is_associated() const { return !contraction && (!strength || strength->sin_friction == strength->sin_dilation); }
  Real p_wave_velocity() const { return std::sqrt((elastic.lame + 2 * elastic.shear_modulus) / density); }
  Real s_wave_velocity() const { return std::sqrt(elastic.shear_modulus / density); }
};

/// Derivative of the stress by the strain [Pa].
template <int D>
VoigtMatrix<D> elastic_stiffness(const laws::Elasticity& elastic) {
  VoigtMatrix<D> c = VoigtMatrix<D>::Zero();
  c.template topLeftCorner<3, 3>().setConstant(elastic.lame);
  for (int i = 0; i < stress_size<D>; ++i) c(i, i) += (i < 3 ? 2 : 1) * elastic.shear_modulus;
  return c;
}

template <int D>
struct SolidResponse {
  bool yields = false;
  Voigt<D> stress = Voigt<D>::Zero();   ///< [Pa]
  Voigt<D> plastic = Voigt<D>::Zero();  ///< increment of the plastic strain [-]
};

/// The stress of an elastic trial strain, brought back to the strength; `tangent`, where asked for, is that of the stress by the
/// trial strain. In principal directions the tangent of shear is the difference of two stresses over that of their trial strains.
/// de Souza Neto, Peric and Owen (2008), appendix A.
template <int D>
SolidResponse<D> respond(const laws::PrincipalReturnMapping& mapping, const Voigt<D>& strain, VoigtMatrix<D>* tangent) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(strain_tensor<D>(strain));
  const Matrix3 directions = solver.eigenvectors().rowwise().reverse();
  const Vector3 principal = solver.eigenvalues().reverse();
  const laws::PrincipalReturn found = mapping(principal);
  // Columns: the stress of a unit in principal directions 11, 22, 33, 12, 23, 31.
  Eigen::Matrix<Real, stress_size<D>, 6> units;
  constexpr std::array<std::array<int, 2>, 6> pairs = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (std::size_t n = 0; n < 6; ++n) {
    const Vector3 a = directions.col(pairs[n][0]), b = directions.col(pairs[n][1]);
    for (int row = 0; row < stress_size<D>; ++row) {
      const auto [i, k] = pairs[static_cast<std::size_t>(row)];
      units(row, static_cast<int>(n)) = n < 3 ? a[i] * a[k] : a[i] * b[k] + a[k] * b[i];
    }
  }
  SolidResponse<D> response;
  response.yields = found.yields;
  response.stress = units.template leftCols<3>() * found.stress;
  response.plastic = units.template leftCols<3>() * found.plastic;
  for (int row = 3; row < stress_size<D>; ++row) response.plastic[row] *= 2;  // engineering shear strain
  if (tangent == nullptr) return response;
  Eigen::Matrix<Real, 6, 6> c = Eigen::Matrix<Real, 6, 6>::Zero();
  c.topLeftCorner<3, 3>() = found.tangent;
  for (int n = 3; n < 6; ++n) {
    const auto [i, k] = pairs[static_cast<std::size_t>(n)];
    const Real difference = principal[i] - principal[k];
    const Matrix3& t = found.tangent;
    c(n, n) = std::abs(difference) > 1e-9 * principal.cwiseAbs().maxCoeff()
                  ? 0.5 * (found.stress[i] - found.stress[k]) / difference
                  : 0.25 * (t(i, i) - t(i, k) + t(k, k) - t(k, i));
  }
  *tangent = units * c * units.transpose();
  return response;
}

/// Energies at a point [J/m3]: what is stored, and what plastic flow has dissipated since another state.
using PointEnergies = laws::OverlayEnergies;

/// Mohr-Coulomb strength with its memory: the plastic strain, the plastic slip that it has added up, and of sand that contracts
/// the cycles and how far its grains have come apart. What half a cycle takes of the volume is plastic strain of the step after
/// it. Where that leaves no pressure between the grains they open, at the tip of the strength, and must close again before they
/// bear.
template <int D>
class StrengthAtPoint {
public:
  StrengthAtPoint(const laws::MohrCoulomb& strength, const laws::Elasticity& elastic,
                  const std::optional<laws::CyclicContraction>& contraction = {})
      : mapping_(strength, elastic),
        stiffness_(elastic_stiffness<D>(elastic)),
        contraction_(contraction),
        cohesion_(strength.cohesion) {}

  std::size_t memory_size() const { return own_size + (contraction_ ? Cycles::numbers + 1 : 0); }
  Real slip(std::span<const Real> memory) const { return memory[stress_size<D>]; }
  Real peak(std::span<const Real>) const { return 0; }

  Voigt<D> respond(const Voigt<D>& strain, std::span<const Real> before, std::span<Real> after, VoigtMatrix<D>* tangent) const {
    Voigt<D> flowed = plastic(before);
    Closing closing;
    if (contraction_) closing = contract(strain, before, after, flowed);
    const SolidResponse<D> response = fem::respond<D>(mapping_, strain - flowed, tangent);
    if (contraction_) after[opening] = closing.open - closing.closed + response.plastic.template head<3>().sum();
    if (tangent != nullptr && closing.goes_on()) soften(closing, *tangent);
    Eigen::Map<Voigt<D>>(after.data()) = flowed + response.plastic;
    const Eigen::SelfAdjointEigenSolver<Matrix3> parts(strain_tensor<D>(response.plastic), Eigen::EigenvaluesOnly);
    after[stress_size<D>] = slip(before) + (response.yields ? parts.eigenvalues()[2] - parts.eigenvalues()[0] : 0);
    return response.stress;
  }

  Voigt<D> stress(const Voigt<D>& strain, std::span<const Real> memory) const { return stiffness_ * elastic(strain, memory); }

  /// Cycles begin at a strain.
  void begin_cycles(const Voigt<D>& strain, std::span<Real> memory) const {
    if (!contraction_) return;
    Cycles cycles(memory.subspan(own_size));
    cycles.begin(strain);
    cycles.write(memory.subspan(own_size));
  }

  PointEnergies energies(const Voigt<D>& strain_before, const Voigt<D>& strain, std::span<const Real> before,
                         std::span<const Real> after) const {
    const Voigt<D> now = elastic(strain, after), old = elastic(strain_before, before), flow = plastic(after) - plastic(before);
    return {0.5 * now.dot(stiffness_ * now), 0.5 * flow.dot(stiffness_ * (now + old))};
  }

private:
  using Cycles = laws::CycleMemory<stress_size<D>>;
  static constexpr std::size_t own_size = stress_size<D> + 1;
  static constexpr std::size_t opening = own_size + Cycles::numbers;

  /// Volume by which grains were apart, and what of it closes in a step [-].
  struct Closing {
    Real open = 0, closed = 0;

    bool goes_on() const { return closed < open; }
  };

  /// While grains are apart the pressure between them does not change, and without cohesion they bear nothing.
  void soften(const Closing& closing, VoigtMatrix<D>& tangent) const {
    if (cohesion_ == 0)
      tangent.setZero();
    else if (closing.closed > 0)
      tangent.template leftCols<3>().colwise() -= tangent.template leftCols<3>().rowwise().mean().eval();
  }

  /// Goes on with the cycles. The strain that has flowed gets what the last half cycle has taken, and what closes.
  Closing contract(const Voigt<D>& strain, std::span<const Real> before, std::span<Real> after, Voigt<D>& flowed) const {
    Cycles cycles(before.subspan(own_size));
    flowed.template head<3>().array() -= cycles.pending() / 3;
    cycles.follow(strain, *contraction_);
    cycles.write(after.subspan(own_size));
    const Real compression = (flowed - strain).template head<3>().sum(), open = std::max(before[opening], Real{0});
    const Closing closing{open, std::clamp(compression, Real{0}, open)};
    flowed.template head<3>().array() -= closing.closed / 3;
    return closing;
  }

  static Eigen::Map<const Voigt<D>> plastic(std::span<const Real> memory) { return Eigen::Map<const Voigt<D>>(memory.data()); }
  static Voigt<D> elastic(const Voigt<D>& strain, std::span<const Real> memory) { return strain - plastic(memory); }

  laws::PrincipalReturnMapping mapping_;
  VoigtMatrix<D> stiffness_;
  std::optional<laws::CyclicContraction> contraction_;
  Real cohesion_ = 0;  ///< [Pa]
};

/// What a material that is not elastic does at a point.
template <int D>
using PointLaw = std::variant<StrengthAtPoint<D>, laws::OverlayModel<stress_size<D>>>;

template <int D>
PointLaw<D> point_law(const SolidMaterial& material) {
  if (material.backbone) return laws::OverlayModel<stress_size<D>>(material.elastic, *material.backbone);
  return StrengthAtPoint<D>(material.strength.value_or(laws::MohrCoulomb{}), material.elastic, material.contraction);
}

}  // namespace sazare::methods::fem
