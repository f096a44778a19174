#pragma once

/// Return of principal stresses to the Mohr-Coulomb strength with a tension cut-off (laws/mohr_coulomb.hpp), in closed
/// form, with the tangent that belongs to it.
///
///     s = C (e - sum dg_a m_a)      f_a = n_a s - k_a = 0 on the active planes      dg = (N' C M)^-1 f(C e)
///     ds/de = C - C M (N' C M)^-1 N' C
///
///     e  elastic trial strain [-]     C  elastic stiffness [Pa]     n_a, m_a  gradients of strength and flow     dg  amounts
///
/// A plane, an edge and a tip of the strength are one, two and three active planes: the set whose amounts are not negative and
/// whose stress is admissible on all planes. de Souza Neto, Peric and Owen, Computational Methods for Plasticity (2008),
/// section 8.2, where the planes are treated one by one.

#include <limits>

#include "sazare/laws/mohr_coulomb.hpp"

#include <Eigen/LU>

namespace sazare::laws {

struct PrincipalReturn {
  bool yields = false;
  Vector3 stress = Vector3::Zero();   ///< [Pa]
  Vector3 plastic = Vector3::Zero();  ///< increment of the plastic strain [-]
  Matrix3 tangent = Matrix3::Zero();  ///< of the stress by the trial strain [Pa]
};

/// One plane of the strength: n s <= k, and its flow.
struct StrengthPlane {
  Vector3 normal = Vector3::Zero();
  Vector3 flow = Vector3::Zero();
  Real limit = 0;  ///< [Pa]

  Real excess(const Vector3& stress) const { return normal.dot(stress) - limit; }
};

/// Shear between the largest and another of the principal stresses i > k.
inline StrengthPlane shear_plane(const MohrCoulomb& law, int i, int k) {
  StrengthPlane plane;
  plane.normal[i] = 1 + law.sin_friction;
  plane.normal[k] = -(1 - law.sin_friction);
  plane.flow[i] = 1 + law.sin_dilation;
  plane.flow[k] = -(1 - law.sin_dilation);
  plane.limit = 2 * law.cohesion * law.cos_friction;
  return plane;
}

inline StrengthPlane tension_plane(const MohrCoulomb& law, int i) {
  StrengthPlane plane;
  plane.normal[i] = plane.flow[i] = 1;
  plane.limit = law.tensile_strength;
  return plane;
}

/// For an elastic trial strain with its principal parts in descending order. An infinite tensile strength is no plane.
class PrincipalReturnMapping {
public:
  PrincipalReturnMapping(const MohrCoulomb& law, const Elasticity& elastic)
      : law_(law),
        elastic_(elastic),
        planes_{shear_plane(law, 0, 2), shear_plane(law, 0, 1), shear_plane(law, 1, 2),
                tension_plane(law, 0),  tension_plane(law, 1),  tension_plane(law, 2)},
        has_tension_(law.tensile_strength < std::numeric_limits<Real>::infinity()) {
    stiffness_ = 2 * elastic.shear_modulus * Matrix3::Identity() + elastic.lame * Matrix3::Ones();
  }

  PrincipalReturn operator()(const Vector3& strain) const {
    const Vector3 trial = stiffness_ * strain;
    const Real tolerance = 1e-10 * (law_.cohesion + trial.cwiseAbs().maxCoeff());
    if (is_borne(trial, tolerance)) return {false, trial, Vector3::Zero(), stiffness_};
    PrincipalReturn result;
    for (const auto& set : active_sets)
      if (try_set(set, trial, tolerance, result)) return result;
    return sweep(strain);
  }

private:
  /// Planes as numbered in the constructor: shear 1-3, 1-2, 2-3, tension 1, 2, 3; -1 ends a set.
  static constexpr std::array<std::array<int, 3>, 12> active_sets = {{{0, -1, -1},
                                                                      {0, 1, -1},
                                                                      {0, 2, -1},
                                                                      {3, -1, -1},
                                                                      {0, 3, -1},
                                                                      {3, 4, -1},
                                                                      {0, 1, 3},
                                                                      {0, 2, 3},
                                                                      {0, 3, 4},
                                                                      {2, 3, 4},
                                                                      {3, 4, 5},
                                                                      {0, 1, 2}}};

  const StrengthPlane& plane(int number) const { return planes_[static_cast<std::size_t>(number)]; }

  bool is_borne(const Vector3& stress, Real tolerance) const {
    for (int i = 0; i < 3; ++i) {
      if (has_tension_ && law_.tension(stress[i]) > tolerance) return false;
      for (int k = 0; k < 3; ++k)
        if (i != k && law_.shear(stress[i], stress[k]) > tolerance) return false;
    }
    return true;
  }

  bool try_set(const std::array<int, 3>& set, const Vector3& trial, Real tolerance, PrincipalReturn& result) const {
    for (const int number : set)
      if (number > 2 && !has_tension_) return false;
    if (set[1] < 0) return try_planes<1>(set, trial, tolerance, result);
    return set[2] < 0 ? try_planes<2>(set, trial, tolerance, result) : try_planes<3>(set, trial, tolerance, result);
  }

  template <int Count>
  bool try_planes(const std::array<int, 3>& set, const Vector3& trial, Real tolerance, PrincipalReturn& result) const {
    Eigen::Matrix<Real, 3, Count> normals, flows;
    Eigen::Matrix<Real, Count, 1> excess;
    for (int i = 0; i < Count; ++i) {
      const StrengthPlane& one = plane(set[static_cast<std::size_t>(i)]);
      normals.col(i) = one.normal;
      flows.col(i) = one.flow;
      excess[i] = one.excess(trial);
    }
    const Eigen::Matrix<Real, 3, Count> relief = stiffness_ * flows;
    const Eigen::Matrix<Real, Count, Count> between = normals.transpose() * relief;
    if (!(std::abs(between.determinant()) > 1e-12 * between.diagonal().prod())) return false;
    const Eigen::Matrix<Real, Count, Count> inverse = between.inverse();
    const Eigen::Matrix<Real, Count, 1> amount = inverse * excess;
    if (amount.minCoeff() < 0) return false;
    const Vector3 plastic = flows * amount;
    const Vector3 stress = trial - relief * amount;
    if (!is_borne(stress, tolerance)) return false;
    const Eigen::Matrix<Real, Count, 3> pull = inverse * (normals.transpose() * stiffness_);
    result = {true, stress, plastic, stiffness_ - relief * pull};
    return true;
  }

  /// Where no set will do, which round-off can bring about beside a tip: by sweeps, with the elastic stiffness as tangent.
  PrincipalReturn sweep(const Vector3& strain) const {
    MohrCoulomb law = law_;
    if (!has_tension_) law.tensile_strength = 1e3 * (law.cohesion + elastic_.shear_modulus);
    const auto flow = plastic_flow<3>(law, elastic_, {strain[0], strain[1], strain[2]});
    const Vector3 plastic(flow.strain[0], flow.strain[1], flow.strain[2]);
    return {true, stiffness_ * (strain - plastic), plastic, stiffness_};
  }

  MohrCoulomb law_;
  Elasticity elastic_;
  std::array<StrengthPlane, 6> planes_;
  bool has_tension_;
  Matrix3 stiffness_;
};

}  // namespace sazare::laws
