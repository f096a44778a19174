#pragma once

/// An elastic beam with a plastic hinge at either end, each without extent.
///
///     m_i = K_ij (t_j - p_j),   K = E I/L (4 2; 2 4)        m  moment at an end [N m]
///     |m_i| <= M_i;   dp_i along m_i, where |m_i| = M_i     M  plastic moment [N m]
///                                                           t  slope of the end against the chord [-]
///                                                           p  plastic rotation, the memory [-]
///
/// The one-component model of Giberson, J. Struct. Div. ASCE 95 (1969) 137-157, here in vectors across the beam, so that a round
/// section in space yields in every direction alike. Moments do not interact with axial force, shear and torsion. The return is
/// the closest point in the energy of the beam, found end by end in turn: that lessens the error to a quarter each time.

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct EndHinges {
  Real stiffness = 0;            ///< E I/L [N m]
  std::array<Real, 2> moment{};  ///< M by end; infinite where there is no hinge [N m]
};

template <int D>
struct HingeResponse {
  std::array<Vector<D>, 2> moment{Vector<D>::Zero(), Vector<D>::Zero()};   ///< m [N m]
  std::array<Vector<D>, 2> plastic{Vector<D>::Zero(), Vector<D>::Zero()};  ///< p [-]
  bool flows = false;
  Eigen::Matrix<Real, 2 * D, 2 * D> tangent;  ///< of the moments by the slopes [N m]
  Real energy = 0;                            ///< stored in bending [J]
};

namespace detail {

/// The plane of one end, out of both.
template <int D>
Eigen::Matrix<Real, 2 * D, 2 * D> spread(const Eigen::Matrix2d& by_end) {
  Eigen::Matrix<Real, 2 * D, 2 * D> all = Eigen::Matrix<Real, 2 * D, 2 * D>::Zero();
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) all.template block<D, D>(a * D, b * D).diagonal().setConstant(by_end(a, b));
  return all;
}

/// Consistent tangent: moments at their limits turn, but do not grow.
template <int D>
Eigen::Matrix<Real, 2 * D, 2 * D> hinge_tangent(const EndHinges& law, const std::array<Vector<D>, 2>& moment,
                                                const std::array<Vector<D>, 2>& flow) {
  using Both = Eigen::Matrix<Real, 2 * D, 2 * D>;
  Both compliance = spread<D>((Eigen::Matrix2d() << 2, -1, -1, 2).finished() / (6 * law.stiffness));
  Eigen::Matrix<Real, 2 * D, 2> normal = Eigen::Matrix<Real, 2 * D, 2>::Zero();
  std::array<bool, 2> flows{};
  for (int end = 0; end < 2; ++end) {
    const auto i = static_cast<std::size_t>(end);
    flows[i] = flow[i].squaredNorm() > 0;
    if (!flows[i]) continue;
    const Vector<D> along = moment[i].normalized();
    normal.template block<D, 1>(end * D, end) = along;
    compliance.template block<D, D>(end * D, end * D) +=
        flow[i].norm() / law.moment[i] * (Eigen::Matrix<Real, D, D>::Identity() - along * along.transpose());
  }
  const Both stiffness = compliance.inverse();
  const Eigen::Matrix<Real, 2 * D, 2> pushed = stiffness * normal;
  Eigen::Matrix2d inner = normal.transpose() * pushed;
  for (int end = 0; end < 2; ++end)
    if (!flows[static_cast<std::size_t>(end)]) inner(end, end) = 1;
  return stiffness - pushed * inner.inverse() * pushed.transpose();
}

}  // namespace detail

/// Slopes t and plastic rotations p so far, by end.
template <int D>
HingeResponse<D> respond(const EndHinges& law, const std::array<Vector<D>, 2>& slope, const std::array<Vector<D>, 2>& plastic) {
  constexpr int most_turns = 60;
  const Real near = 4 * law.stiffness, far = 2 * law.stiffness;
  const Vector<D> first = slope[0] - plastic[0], second = slope[1] - plastic[1];
  const std::array<Vector<D>, 2> trial{near * first + far * second, far * first + near * second};
  std::array<Vector<D>, 2> flow{Vector<D>::Zero(), Vector<D>::Zero()};
  HingeResponse<D> response;
  response.moment = trial;
  for (int turn = 0; turn < most_turns; ++turn) {
    const auto before = flow;
    for (const std::size_t end : {0U, 1U}) {
      const Vector<D> borne = trial[end] - far * flow[1 - end];
      const Real size = borne.norm();
      flow[end] = size > law.moment[end] ? Vector<D>((size - law.moment[end]) / (near * size) * borne) : Vector<D>::Zero();
    }
    if (flow == before) break;
  }
  for (const std::size_t end : {0U, 1U}) {
    response.flows = response.flows || flow[end].squaredNorm() > 0;
    response.plastic[end] = plastic[end] + flow[end];
  }
  if (response.flows) {
    response.moment = {trial[0] - near * flow[0] - far * flow[1], trial[1] - far * flow[0] - near * flow[1]};
    response.tangent = detail::hinge_tangent<D>(law, response.moment, flow);
  } else {
    response.tangent = detail::spread<D>((Eigen::Matrix2d() << near, far, far, near).finished());
  }
  for (const std::size_t end : {0U, 1U}) response.energy += 0.5 * response.moment[end].dot(slope[end] - response.plastic[end]);
  return response;
}

}  // namespace sazare::laws
