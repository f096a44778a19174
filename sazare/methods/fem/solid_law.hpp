#pragma once

/// A material at a point: elastic, or with a Mohr-Coulomb strength.

#include <optional>
#include <string>

#include "sazare/laws/principal_return.hpp"
#include "sazare/methods/fem/voigt.hpp"

#include <Eigen/Eigenvalues>

namespace sazare::methods::fem {

struct SolidMaterial {
  std::string name;
  laws::Elasticity elastic;
  Real density = 0;        ///< [kg/m3]
  Real damping_ratio = 0;  ///< of Rayleigh damping [-]
  std::optional<laws::MohrCoulomb> strength;

  static SolidMaterial elastic_of(Real youngs_modulus, Real poisson_ratio, Real density_) {
    SolidMaterial material;
    material.elastic = {youngs_modulus / (2 * (1 + poisson_ratio)),
                        youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))};
    material.density = density_;
    return material;
  }
  /// Whether the tangent is symmetric.
  bool is_associated() const { return !strength || strength->sin_friction == strength->sin_dilation; }
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
  for (int row = 3; row < stress_size<D>; ++row) response.plastic[row] *= 2;  // engineering's shear strain
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

}  // namespace sazare::methods::fem
