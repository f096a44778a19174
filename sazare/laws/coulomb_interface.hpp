#pragma once

/// Two faces that press on each other, slip by Coulomb's law and open freely.
///
///     p = -k_n g                      g <= 0      p   pressure [Pa]               k_n, k_s  stiffness [Pa/m]
///     t = k_s (d_t - s)     |t| <= c + mu p       g   opening, d n [m]            c         cohesion, gone where it is open [Pa]
///     p = t = 0, s = d_t              g > 0       t   shear traction [Pa]         mu        coefficient of friction [-]
///                                                 d_t displacement in the face    s         slip, the memory [m]
///
/// The traction of the first face on the second is p n - t, with n from the first to the second. Goodman, Taylor and Brekke,
/// J. Soil Mech. Found. Div. ASCE 94 (1968) 637-659; the slip as in plasticity without hardening and without dilation.

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct CoulombInterface {
  Real normal_stiffness = 0;      ///< k_n [Pa/m]
  Real shear_stiffness = 0;       ///< k_s [Pa/m]
  Real cohesion = 0;              ///< c [Pa]
  Real friction_coefficient = 0;  ///< mu [-]
};

enum class InterfaceState { open, sticks, slips };

template <int D>
struct InterfaceResponse {
  InterfaceState state = InterfaceState::open;
  Vector<D> force = Vector<D>::Zero();  ///< of the second face's derivative of the energy: t - p n [Pa]
  Vector<D> slip = Vector<D>::Zero();   ///< s [m]
  Vector<D> shear = Vector<D>::Zero();  ///< t [Pa]
  Real energy = 0;                      ///< stored [J/m2]
  Eigen::Matrix<Real, D, D> tangent = Eigen::Matrix<Real, D, D>::Zero();  ///< of the force by d [Pa/m]
};

/// `displacement` d of the second face from the first, `normal` n, `slip` s so far.
template <int D>
InterfaceResponse<D> respond(const CoulombInterface& law, const Vector<D>& displacement, const Vector<D>& normal,
                             const Vector<D>& slip) {
  InterfaceResponse<D> response;
  const Real opening = displacement.dot(normal);
  const Vector<D> across = displacement - opening * normal;
  if (opening > 0) {
    response.slip = across;
    return response;
  }
  const Eigen::Matrix<Real, D, D> in_plane = Eigen::Matrix<Real, D, D>::Identity() - normal * normal.transpose();
  const Real pressure = -law.normal_stiffness * opening;
  const Vector<D> trial = law.shear_stiffness * (across - slip);
  const Real limit = law.cohesion + law.friction_coefficient * pressure, size = trial.norm();
  response.tangent = law.normal_stiffness * normal * normal.transpose();
  if (size <= limit) {
    response.state = InterfaceState::sticks;
    response.shear = trial;
    response.slip = slip;
    response.tangent += law.shear_stiffness * in_plane;
  } else {
    const Vector<D> direction = trial / size;
    response.state = InterfaceState::slips;
    response.shear = limit * direction;
    response.slip = across - response.shear / law.shear_stiffness;
    response.tangent += limit * law.shear_stiffness / size * (in_plane - direction * direction.transpose()) -
                        law.friction_coefficient * law.normal_stiffness * direction * normal.transpose();
  }
  response.force = response.shear - pressure * normal;
  response.energy = 0.5 * pressure * pressure / law.normal_stiffness + 0.5 * response.shear.squaredNorm() / law.shear_stiffness;
  return response;
}

}  // namespace sazare::laws
