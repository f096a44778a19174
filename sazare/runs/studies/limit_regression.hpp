#pragma once

/// The regression of limit steps on radius, velocity and damping of [Yoshida2010], section 6.
///
///     dt = a1 (R/V)^a2                                                       (14)    R  particle radius [m], V  wave velocity
///     [m/s] a1 = 10^(b11 log10(h)^2 + b12 log10(h) + b13), a2 with b21 b22 b23     (15), (16)    h  damping ratio, at most 0.22

#include <array>
#include <span>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::runs {

struct LimitPoint {
  Real radius = 0;    ///< [m]
  Real velocity = 0;  ///< [m/s]
  Real damping = 0;   ///< h [-]
  Real limit = 0;     ///< dt [s]
};

/// a1 and a2 of one damping ratio.
struct DampingFit {
  Real damping = 0;
  Real a1 = 0;
  Real a2 = 0;
};

/// The six coefficients of Table 2.
struct LimitFit {
  std::vector<DampingFit> by_damping;  ///< (14), all ratios
  std::array<Real, 3> b1{};            ///< b11 b12 b13
  std::array<Real, 3> b2{};            ///< b21 b22 b23

  Real predict(const LimitPoint& point) const;
};

/// Root of the mean square of ln(fitted/found) over the points with damping up to `most`.
Real log_error(const LimitFit& fit, std::span<const LimitPoint> points, Real most = 0.22);

/// Least squares in logarithms; (15) and (16) from the damping ratios up to `most`.
LimitFit fit_limits(std::span<const LimitPoint> points, Real most = 0.22);

/// Table 2 of the paper, for S and for P waves.
extern const LimitFit paper_shear_fit, paper_pressure_fit;

}  // namespace sazare::runs
