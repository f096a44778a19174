#pragma once

/// Elastic tetrahedra, each with one strain, that joints hold together at their faces.
///
///     k_n = K_n/d,  k_s = K_s/d      d    distance of an element's centre from a face; two elements are in series [m]
///     K_n = 8 M,    K_s = 12 G       M, G moduli of a plane P wave and of shear [Pa]
///
/// The joints are stiff, so that elements carry most of the strain, but not rigid. What the half of each joint that belongs to an
/// element yields under a uniform stress s is taken out of that element's compliance,
///
///     S_e = S - S_j,   s : S_j s = 1/V sum A d (s_n^2/K_n + s_t^2/K_s)     s_n, s_t  traction across and along a face of area A
///
/// so that both together yield as the material does, whatever the mesh. No constant is fitted: 8 and 12 are a choice between
/// steps and accuracy, with which E of irregular meshes is within 1 % of what was asked for, and nu within 0.001
/// (tools/deformable_block_stiffness.py).

#include <Eigen/Eigenvalues>

#include "sazare/core/symmetric_tensor.hpp"
#include "sazare/laws/block_elasticity.hpp"

namespace sazare::laws {

/// Steps become as small as the time that a P wave takes through an element: 3.7 times smaller at 0.49 than at 0.25.
inline constexpr Real most_poisson_ratio_of_deformable = 0.49;

inline SpringModuli joint_moduli(const ElasticModuli& body) { return {8 * body.confined(), 12 * body.shear()}; }

/// Stress per strain, both as six numbers [Pa].
inline Matrix6 isotropic_stiffness(const ElasticModuli& body) {
  const Real shear = body.shear(), lame = body.confined() - 2 * shear;
  Matrix6 stiffness = 2 * shear * Matrix6::Identity();
  stiffness.topLeftCorner<3, 3>().array() += lame;
  return stiffness;
}

/// A face of an element as its joint yields: normal, and A d/V.
struct YieldingFace {
  Vector3 normal;
  Real share = 0;
};

/// Strain per stress of an element's halves of its joints [1/Pa].
template <class Faces>
Matrix6 joint_compliance(const Faces& faces, const SpringModuli& springs) {
  Matrix6 sum = Matrix6::Zero();
  for (const YieldingFace& face : faces)
    for (int i = 0; i < 6; ++i) {
      const Vector3 traction = tensor_of(Vector6::Unit(i)) * face.normal;
      const Vector3 across = face.normal.dot(traction) * face.normal, along = traction - across;
      const Vector3 opening = across / springs.normal + along / springs.shear;
      sum.col(i) += face.share * force_on_strain(opening, face.normal);
    }
  return sum;
}

/// What of an isotropic compliance is left to an element beside its joints, as stiffness [Pa]. An element so flat that its joints
/// yield more than three quarters in some direction keeps a quarter of the compliance there.
inline Matrix6 element_stiffness(const ElasticModuli& body, const Matrix6& joints) {
  constexpr Real least_share = 0.25;
  using Matrix = Eigen::Matrix<Real, 6, 6>;
  // In the axes in which the whole compliance is the unit matrix.
  const Matrix root = Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(isotropic_stiffness(body))).operatorSqrt();
  const Eigen::SelfAdjointEigenSolver<Matrix> share(root * Matrix(joints) * root);
  const auto left = (1 - share.eigenvalues().array()).max(least_share);
  const Matrix turned = root * share.eigenvectors();
  return turned * left.inverse().matrix().asDiagonal() * turned.transpose();
}

}  // namespace sazare::laws
