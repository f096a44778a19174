#pragma once

/// Elastic link of two particles of the moving-particle method.
///
///     w  = r_e/|r0| - 1                           weight, 0 beyond r_e                           (A8)
///     u  = r - (R_i + R_j) r0 / 2                 deformation without the rotation               (12)
///     u  = r - R((theta_i + theta_j)/2) r0        the same by the mean angle, in 2-D             (11)
///     c  = u . e,  e = r/|r|                      its part along the link                        (A1, A2)
///     div_i = d/n0 sum_j w c/|r0|                 volume strain                                  (A11)
///     E  = sum_links k u.u/2 + sum_i V lambda_i div_i^2/2,   k = 4 d V w (mu_i + mu_j)/2 / (n0 |r0|^2)
///
///     r0, r   from i to j at the beginning and now [m]      n0          number density of an inner particle [-]
///     R       rotation of a particle                        V           volume of a particle [m3; m2 in 2-D]
///     r_e     influence radius [m]                          mu, lambda  Lame's constants [Pa]
///     d       dimension of space
///
/// [Yoshida2010], appendix. The sum of its normal and shear terms (A6, A7) is the vector spring k u. Force and torque here are
/// the exact derivatives of E, so that energy is conserved at any rotation and strain. The paper's differ from them by terms of
/// second order in the strain: its torque is r x k u/2 instead of R_i r0 x (k u + S e)/2, and its pressure term (A10) has S e
/// instead of S (e + (u - c e)/|r|), with S = V (lambda_i div_i + lambda_j div_j) d w/(n0 |r0|). Linearised they are the same.

#include "sazare/core/vector_of.hpp"

namespace sazare::laws {

/// Weight of a link [-]; both lengths in the same unit.
inline Real link_weight(Real length, Real influence_radius) {
  return length > 0 && length < influence_radius ? influence_radius / length - 1 : 0;
}

/// What a link of a given direction of the lattice has whoever its particles are.
template <int D>
struct LinkDirection {
  Vector<D> start;      ///< r0 [m]
  Real spring = 0;      ///< k over the mean of the two mu [m; -] (4 d V w / (n0 |r0|^2))
  Real divergence = 0;  ///< d w/(n0 |r0|) [1/m]
};

/// `T` is Real or Lanes.
template <int D, class T>
T product(const VectorOf<T, D>& a, const VectorOf<T, D>& b) {
  T sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

template <int D, class T>
struct LinkStrain {
  VectorOf<T, D> deformation;  ///< u [m]
  VectorOf<T, D> direction;    ///< e
  T inverse_length{};          ///< 1/|r| [1/m]
  T stretch{};                 ///< c [m]
};

/// `apart` is r, `turned` the mean of R_i r0 and R_j r0.
template <int D, class T>
LinkStrain<D, T> link_strain(const VectorOf<T, D>& apart, const VectorOf<T, D>& turned) {
  LinkStrain<D, T> strain;
  strain.inverse_length = 1.0 / square_root(product<D, T>(apart, apart));
  for (int i = 0; i < D; ++i) {
    strain.deformation[i] = apart[i] - turned[i];
    strain.direction[i] = strain.inverse_length * apart[i];
  }
  strain.stretch = product<D, T>(strain.deformation, strain.direction);
  return strain;
}

template <int D, class T>
struct LinkForce {
  VectorOf<T, D> force;    ///< on the first particle [N]; the other way on the second
  VectorOf<T, D> turning;  ///< k u + S e [N]: the torque on a particle is R r0 x this / 2
};

/// `spring` is k [N/m], `pressure` is S [N].
template <int D, class T>
LinkForce<D, T> link_force(const LinkStrain<D, T>& strain, T spring, T pressure) {
  LinkForce<D, T> result;
  const T slope = pressure * strain.inverse_length;
  for (int i = 0; i < D; ++i) {
    result.turning[i] = spring * strain.deformation[i] + pressure * strain.direction[i];
    result.force[i] = result.turning[i] + slope * (strain.deformation[i] - strain.stretch * strain.direction[i]);
  }
  return result;
}

}  // namespace sazare::laws
