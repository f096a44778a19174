#pragma once

/// Backbone curve of soil in shear: the stress of a first loading, as a concave polygon that ends in a strength.
///
///     t(g) = min over lines (a_j + k_j g)     k_0 = G0, a_0 = 0;  last: k = 0, a = S
///
///     g   engineering shear strain [-]     G0  shear modulus at small strain [Pa]
///     t   shear stress [Pa]                  S   shear strength [Pa]
///
/// The lines between go through neighbouring points of the curve. The first and the last of them are extended to the line of G0
/// and to that of the strength, so that the polygon passes through all points, begins with G0 and ends at S.
///
/// Curves, the first two with G/G0 = t/(G0 g) = 1/2 at the reference strain g_r:
///
///     hyperbolic          t = G0 g/(1 + g/g_r), S = G0 g_r                [HardinDrnevich1972]
///     Ramberg-Osgood      g = t/G0 (1 + (2 t/(G0 g_r))^(r - 1))           [RambergOsgood1943]
///     general hyperbolic  t = S y,  y = x/(1/c_1 + x/c_2),  x = g/g_r,  g_r = S/G0                      [TatsuokaShibuya1992]
///                         c_1 = (C_10 + C_1i)/2 + (C_10 - C_1i)/2 cos(pi/(a/x + 1)),  c_2 likewise with C_20, C_2i and b
///
/// The general hyperbolic equation is the hyperbola with all C = 1. C_10 is 1, so that it begins with G0; C_20 is c_2 at no
/// strain and C_1i, C_2i both at large ones, where it is cut off at S.
///
/// Masing's rules: after a reversal the curve is the backbone at twice its size from there. Of a closed cycle between -g and g
/// they give the damping ratio D = dW/(4 pi W) = 2/pi (2 A/(g t) - 1) with A, the area under the backbone up to g, and W = g t/2.
/// Masing, Proc. 2nd Int. Congress of Applied Mechanics (1926) 332-335.
///
/// [HardinDrnevich1972] J. Soil Mech. Found. Div. ASCE 98 (1972) 667-692. [RambergOsgood1943] NACA Technical Note 902 (1943).
/// [TatsuokaShibuya1992] Deformation characteristics of soils and rocks from field and laboratory tests. Report of the Institute
/// of Industrial Science, University of Tokyo, 37, No. 1 (1992).

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct CurvePoint {
  Real strain = 0;  ///< g [-]
  Real stress = 0;  ///< t [Pa]
};

/// The points of the least concave curve that lies nowhere below these, which begin at the origin: those of them that stick out.
/// `points` in ascending order of strains, all positive.
inline std::vector<CurvePoint> concave_hull(std::span<const CurvePoint> points) {
  std::vector<CurvePoint> hull{{0, 0}};
  const auto slope = [](const CurvePoint& a, const CurvePoint& b) { return (b.stress - a.stress) / (b.strain - a.strain); };
  constexpr Real less = 1 - 1e-12;
  for (const CurvePoint& point : points) {
    while (hull.size() > 1 && slope(hull.back(), point) >= less * slope(hull[hull.size() - 2], hull.back())) hull.pop_back();
    hull.push_back(point);
  }
  hull.erase(hull.begin());
  return hull;
}

class BackboneCurve {
public:
  BackboneCurve() = default;

  /// Through points with ascending strains and stresses that do not fall, none above G0 g; a point below the concave hull of the
  /// others is passed over. The strength is at least the last stress.
  BackboneCurve(Real shear_modulus, std::span<const CurvePoint> points, Real strength) : strength_(strength) {
    const std::vector<CurvePoint> hull = concave_hull(points);
    std::vector<Line> lines{{shear_modulus, 0}};
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
      const Real slope = (hull[i + 1].stress - hull[i].stress) / (hull[i + 1].strain - hull[i].strain);
      if (slope > 0 && slope < lines.back().slope) lines.push_back({slope, hull[i].stress - slope * hull[i].strain});
    }
    lines.push_back({0, strength});
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      strain_.push_back((lines[i + 1].at_zero - lines[i].at_zero) / (lines[i].slope - lines[i + 1].slope));
      slope_.push_back(lines[i].slope);
    }
  }

  Real shear_modulus() const { return slope_.front(); }
  Real strength() const { return strength_; }

  /// Corners of the polygon: their strains, and the slopes before them [Pa].
  const std::vector<Real>& corner_strain() const { return strain_; }
  const std::vector<Real>& slope() const { return slope_; }

  /// t, of a strain of either sign.
  Real stress(Real strain) const {
    Real sum = 0, from = 0;
    const Real most = std::abs(strain);
    for (std::size_t i = 0; i < strain_.size() && from < most; from = strain_[i++])
      sum += slope_[i] * (std::min(most, strain_[i]) - from);
    return std::copysign(sum, strain);
  }

  /// A, the area under the curve up to a strain [J/m3].
  Real area(Real strain) const {
    Real sum = 0, from = 0, stress = 0;
    for (std::size_t i = 0; i < strain_.size() && from < strain; from = strain_[i++]) {
      const Real width = std::min(strain, strain_[i]) - from;
      sum += width * (stress + 0.5 * slope_[i] * width);
      stress += slope_[i] * width;
    }
    return sum + std::max(strain - from, Real{0}) * stress;
  }

  /// G/G0 of the secant; 1 at no strain.
  Real modulus_ratio(Real strain) const { return strain > 0 ? stress(strain) / (shear_modulus() * strain) : 1; }

  /// Where G/G0 falls to a ratio below 1.
  Real strain_at_ratio(Real ratio) const {
    const Real secant = ratio * shear_modulus();
    std::size_t last = 0;
    while (last + 1 < strain_.size() && stress(strain_[last]) > secant * strain_[last]) ++last;
    if (stress(strain_[last]) > secant * strain_[last]) return strength_ / secant;
    const Real from = strain_[last - 1], at_from = stress(from);
    return (at_from - slope_[last] * from) / (secant - slope_[last]);
  }

  /// D, of a cycle between -strain and strain.
  Real masing_damping(Real strain) const {
    const Real work = strain * stress(strain);
    return work > 0 ? 2 / std::numbers::pi * std::max(2 * area(strain) / work - 1, Real{0}) : 0;
  }

private:
  struct Line {
    Real slope = 0;    ///< k [Pa]
    Real at_zero = 0;  ///< a [Pa]
  };

  Real strength_ = 0;
  std::vector<Real> strain_, slope_;
};

/// Strains in equal ratios, for the points of a curve.
inline std::vector<Real> spaced_strains(Real first, Real last, int count) {
  std::vector<Real> strains;
  for (int i = 0; i < count; ++i) strains.push_back(first * std::pow(last / first, static_cast<Real>(i) / (count - 1)));
  strains.back() = last;
  return strains;
}

/// Strains at which curves are taken, over the reference strain.
inline constexpr Real first_curve_strain = 0.02, last_curve_strain = 50;

/// A polygon of so many corners through points of a smooth curve, cut off at a strength that the curve has at
/// `strain_at_strength`.
template <class Stress>
BackboneCurve curve_through(Real shear_modulus, Real reference_strain, int corners, Real strength, Real strain_at_strength,
                            Stress&& stress_at) {
  const Real last = std::min(last_curve_strain * reference_strain, strain_at_strength);
  std::vector<CurvePoint> points;
  for (const Real strain :
       spaced_strains(std::min(first_curve_strain * reference_strain, first_curve_strain * last), last, corners))
    points.push_back({strain, std::min(stress_at(strain), strength)});
  return {shear_modulus, points, strength};
}

/// The hyperbola; `strength`, at most G0 g_r, cuts it off.
inline BackboneCurve hyperbolic_curve(Real shear_modulus, Real reference_strain, Real strength, int corners) {
  const Real limit = shear_modulus * reference_strain;
  const Real reached =
      strength < limit ? strength / (shear_modulus * (1 - strength / limit)) : last_curve_strain * reference_strain;
  return curve_through(shear_modulus, reference_strain, corners, strength, reached,
                       [&](Real strain) { return shear_modulus * strain / (1 + strain / reference_strain); });
}

/// The curve of Ramberg and Osgood with its exponent r > 1, cut off at a strength: it has none of its own.
inline BackboneCurve ramberg_osgood_curve(Real shear_modulus, Real reference_strain, Real exponent, Real strength, int corners) {
  const auto strain_of = [&](Real stress) {
    return stress / shear_modulus * (1 + std::pow(2 * stress / (shear_modulus * reference_strain), exponent - 1));
  };
  return curve_through(shear_modulus, reference_strain, corners, strength, strain_of(strength), [&](Real strain) {
    Real low = 0, high = shear_modulus * strain;
    for (int halving = 0; halving < 200 && low < high; ++halving) {
      const Real middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (strain_of(middle) < strain ? low : high) = middle;
    }
    return 0.5 * (low + high);
  });
}

/// Coefficients of the general hyperbolic equation; C_10 is 1.
struct GeneralHyperbola {
  Real first_end = 1;      ///< C_1i [-]
  Real second_begin = 1;   ///< C_20 [-]
  Real second_end = 1;     ///< C_2i [-]
  Real first_change = 1;   ///< a [-]
  Real second_change = 1;  ///< b [-]

  /// y of x, before it is cut off at 1.
  Real stress(Real strain) const {
    const auto between = [&](Real begin, Real end, Real change) {
      return 0.5 * (begin + end) + 0.5 * (begin - end) * std::cos(std::numbers::pi / (change / strain + 1));
    };
    return strain / (1 / between(1, first_end, first_change) + strain / between(second_begin, second_end, second_change));
  }
  /// Where y reaches a value first; the largest strain of a curve where it does not.
  Real strain_at(Real stress_sought) const {
    Real low = 0, high = last_curve_strain;
    for (const Real strain : spaced_strains(first_curve_strain, last_curve_strain, 400))
      if (stress(strain) >= stress_sought) {
        high = strain;
        break;
      } else {
        low = strain;
      }
    for (int halving = 0; halving < 60; ++halving) {
      const Real middle = 0.5 * (low + high);
      (stress(middle) < stress_sought ? low : high) = middle;
    }
    return high;
  }
};

/// The curve of the general hyperbolic equation, cut off at the strength.
inline BackboneCurve general_hyperbolic_curve(Real shear_modulus, const GeneralHyperbola& form, Real strength, int corners) {
  const Real reference = strength / shear_modulus;
  return curve_through(shear_modulus, reference, corners, strength, form.strain_at(1) * reference,
                       [&](Real strain) { return strength * form.stress(strain / reference); });
}

}  // namespace sazare::laws
