#pragma once

/// Contact of two outlines that overlap at one or two points of a face: springs and dashpots across it, friction along it.
///
///     P_i = K_n d_i + D_i                  force of a point, pushes apart [N]                       (6.1), (7.1)
///     D_i = max(eta_n v_i, -K_n d_i)       its dashpot: a point never pulls
///     p = sum K_n d_i                      pressure [N]
///     w = sum K_n d_i w_i / p              sliding of the pair [m/s]
///     Q = S + eta_s w,  S' = K_s w         along the face, of all points together [N]               (6.2), (7.2)
///     |S| <= tan(phi) p                    where it slips, Q = S
///     E = sum K_n d_i^2/2 + S^2/(2 K_s)    stored [J]: P_i - D_i is its slope by d_i, S that by sliding
///
///     d_i    depth of the overlap [m]                             n      from the first outline to the second
///     v_i    speed at which a point closes [m/s]                  w_i    of the first over the second along (n_y, -n_x) [m/s]
///     S      force of the shear spring, the memory [N]            phi    angle of friction
///
///     K_n = k_n A/(r1 + r2)/N,  K_s = k_s A/(r1 + r2)             A = 2 r l, area of the face [m2]       (6.3), (6.4)
///     eta_n = 2 h sqrt(N K_n m)/N,  eta_s = N eta_n sqrt(K_s/(N K_n))                                    (7.3), (7.4)
///
///     k_n, k_s  stiffness [Pa]       r1, r2  from the centres to the faces [m], 0 for a wall (19)
///     h         damping ratio        r       the smaller of both, or of the element on a wall its own [m]
///     l         thickness [m]        m       reduced mass, 1/(1/m1 + 1/m2) [kg]
///     N         points: 2, or 1 where one of the outlines is a circle
///
/// P_i acts at its point, Q at the points in the shares that P_i have in their sum. [Matsui1999], whose elements meet as circles.
/// Deviations: outlines meet as what they are, with a spring at each end of a face as in (13.2); one shear spring serves both
/// points, so that what is on one line gives one force along it; and dashpots never pull.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "sazare/laws/face_link.hpp"

namespace sazare::laws {

struct FaceContact {
  Real normal_stiffness = 0;  ///< k_n [Pa]
  Real shear_stiffness = 0;   ///< k_s [Pa]
  Real damping_ratio = 0;     ///< h
  Real friction = 0;          ///< tan phi
  Real thickness = 1;         ///< l [m]
};

/// Springs of a pair.
struct ContactSprings {
  Real normal = 0, shear = 0;                  ///< K_n of a point, K_s of the pair [N/m]
  Real normal_damping = 0, shear_damping = 0;  ///< eta_n of a point, eta_s of the pair [N s/m]
};

/// From r1 and r2, N, and 1/m, which is 0 where neither has a mass: then there are no dashpots.
inline ContactSprings contact_springs(const FaceContact& law, Real first_reach, Real second_reach, int points,
                                      Real inverse_mass) {
  const Real reach = first_reach + second_reach;
  const Real half_face = first_reach > 0 && second_reach > 0 ? minimum(first_reach, second_reach) : reach;
  const Real area = 2 * half_face * law.thickness;
  const Real normal = law.normal_stiffness * area / reach, shear = law.shear_stiffness * area / reach;
  const Real damping = inverse_mass > 0 ? 2 * law.damping_ratio * std::sqrt(normal / inverse_mass) : 0;
  return {normal / points, shear, damping / points, damping * std::sqrt(shear / normal)};
}

/// D of a point with these springs' force [N].
inline Real pushing_dashpot(Real damping, Real closing, Real elastic) { return maximum(damping * closing, -elastic); }

/// Sums over the points of a face.
struct PressedFace {
  Real pressure = 0;  ///< p [N]
  Real total = 0;     ///< sum P_i [N]
  Real sliding = 0;   ///< p w [W]
  int points = 0;

  void add(Real elastic, Real force, Real point_sliding) {
    pressure += elastic;
    total += force;
    sliding += elastic * point_sliding;
    ++points;
  }
  /// w [m/s].
  Real sliding_rate() const { return pressure > 0 ? sliding / pressure : 0; }
  /// The share of Q that a point with this force [N] has.
  Real share_of(Real force) const { return total > 0 ? force / total : 1 / static_cast<Real>(points); }
};

/// What acts along a face, and the energy that it loses by slipping.
struct FaceFriction {
  Real force = 0;    ///< Q [N]
  Real dashpot = 0;  ///< of that, eta_s w [N]
  Real loss = 0;     ///< [J]
};

/// Takes S through a step; it slips at `limit`, tan(phi) p [N].
inline FaceFriction advance_friction(Real& spring, const ContactSprings& springs, Real limit, Real sliding_rate, Real elapsed) {
  const Real before = spring, trial = before + springs.shear * elapsed * sliding_rate;
  if (slips(trial, limit)) {
    spring = trial < 0 ? -limit : limit;
    return {spring, 0, slip_loss(before, trial, spring, springs.shear)};
  }
  spring = trial;
  const Real dashpot = springs.shear_damping * sliding_rate;
  return {trial + dashpot, dashpot, 0};
}

/// In a shear spring that bears so much [J].
inline Real shear_energy(const ContactSprings& springs, Real spring) { return 0.5 * spring * spring / springs.shear; }

struct ContactPoint {
  Real depth = 0;    ///< d_i [m]
  Real closing = 0;  ///< v_i [m/s]
  Real sliding = 0;  ///< w_i [m/s]
};

/// On the second outline: along n and along (n_y, -n_x), and what the dashpots give of both [N].
struct PointForce {
  Real normal = 0, shear = 0;
  Real normal_dashpot = 0, shear_dashpot = 0;
};

struct FaceContactForce {
  std::array<PointForce, 2> point;
  Real energy = 0;         ///< E [J]
  Real friction_loss = 0;  ///< [J]
};

/// All points of a pair through a step. `share` is the part of the shorter face that lies over the other: springs and dashpots
/// across the face act in proportion to it.
inline FaceContactForce advance_contact(Real& spring, const ContactSprings& springs, Real friction,
                                    std::span<const ContactPoint> points, Real share, Real elapsed) {
  FaceContactForce result;
  PressedFace face;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Real elastic = share * springs.normal * points[i].depth;
    const Real dashpot = pushing_dashpot(share * springs.normal_damping, points[i].closing, elastic);
    result.point[i].normal = elastic + dashpot;
    result.point[i].normal_dashpot = dashpot;
    result.energy += 0.5 * elastic * points[i].depth;
    face.add(elastic, elastic + dashpot, points[i].sliding);
  }
  const FaceFriction along = advance_friction(spring, springs, friction * face.pressure, face.sliding_rate(), elapsed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Real part = face.share_of(result.point[i].normal);
    result.point[i].shear = part * along.force;
    result.point[i].shear_dashpot = part * along.dashpot;
  }
  result.energy += shear_energy(springs, spring);
  result.friction_loss = along.loss;
  return result;
}

}  // namespace sazare::laws
