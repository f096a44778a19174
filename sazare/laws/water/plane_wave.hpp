#pragma once

/// Plane waves over a level bed, z up from the still-water level: elevation, velocity and acceleration of the water.
///
/// Airy and Stokes of second order [DeanDalrymple1991], chapters 3 and 11, theta = k x - w t, depth d, height H:
///
///     w^2 = g k tanh(k d)                                    dispersion, at both orders
///     eta = H/2 cos theta + pi H^2/(8 L) cosh kd (2 + cosh 2kd)/sinh^3 kd cos 2 theta
///     u = H/2 w cosh k(z + d)/sinh kd cos theta + 3/16 H^2 w k cosh 2k(z + d)/sinh^4 kd cos 2 theta
///
/// and w_z likewise with sinh and sin. Airy's wave has the first terms alone; above the trough its motion is that of the still
/// water's column stretched to the surface [Wheeler1970]. Accelerations are local ones for Airy, and those of a water particle
/// for Stokes, since what they differ by is of second order.
///
/// The solitary wave has the profile of Boussinesq, eta = H sech^2(sqrt(3 H/(4 d^3)) (x - c t)), c^2 = g (d + H), and the
/// velocity that its passage without change of form asks for, the same over the depth: u = c eta/(d + eta), w_z = -(z + d) du/dx.

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

enum class WaveTheory { none, airy, stokes2, solitary, table };
inline constexpr std::array<std::string_view, 5> wave_theory_words{"none", "airy", "stokes2", "solitary", "table"};

/// What the water does at a point.
struct WaterMotion {
  Vector3 velocity = Vector3::Zero();      ///< [m/s]
  Vector3 acceleration = Vector3::Zero();  ///< [m/s2]
};

/// k of w^2 = g k tanh(k d) [1/m].
inline Real wave_number(Real angular_frequency, Real depth, Real gravity) {
  const Real wanted = angular_frequency * angular_frequency * depth / gravity;
  Real kd = wanted / std::sqrt(std::tanh(wanted));  // [Eckart1952], within 6 %
  for (int n = 0; n < 50; ++n) {
    const Real tanh = std::tanh(kd), step = (kd * tanh - wanted) / (tanh + kd * (1 - tanh * tanh));
    kd -= step;
    if (std::abs(step) < 1e-15 * kd) break;
  }
  return kd / depth;
}

/// The height at which a regular wave breaks [m]: 0.142 L tanh(k d) [Miche1944]; a solitary wave at 0.78 d [McCowan1894].
inline Real breaking_height(WaveTheory theory, Real wave_number, Real depth) {
  if (theory == WaveTheory::solitary) return 0.78 * depth;
  return 0.142 * 2 * std::numbers::pi / wave_number * std::tanh(wave_number * depth);
}

class PlaneWave {
public:
  struct Given {
    WaveTheory theory = WaveTheory::airy;
    Real height = 0;                    ///< H, trough to crest [m]
    Real period = 0;                    ///< not of a solitary wave [s]
    Real depth = 0;                     ///< [m]
    Vector3 towards = Vector3::UnitX();  ///< horizontal, of length 1
    Vector3 up = Vector3::UnitZ();       ///< of length 1
    Real crest = 0;                     ///< where a crest stands at t = 0, along `towards` [m]
    Real ramp = 0;                      ///< time in which a regular wave grows to its height [s]
    Real gravity = 9.80665;             ///< [m/s2]
  };

  explicit PlaneWave(const Given& given) : given_(given) {
    if (is_solitary()) return;
    frequency_ = 2 * std::numbers::pi / given.period;
    number_ = laws::wave_number(frequency_, given.depth, given.gravity);
    decay_ = std::exp(-2 * number_ * given.depth);
    if (given.theory != WaveTheory::stokes2) return;
    const Real tanh = std::tanh(number_ * given.depth), coth = 1 / tanh;
    // cosh kd (2 + cosh 2kd)/sinh^3 kd = (3 coth^3 - coth), which does not overflow in deep water.
    second_elevation_ = number_ * given.height * given.height / 16 * (3 * coth * coth * coth - coth);
  }

  Real number() const { return number_; }

  /// Of the surface above still water [m].
  Real elevation(const Vector3& at, Real time) const {
    if (is_solitary()) return solitary(at, time).eta;
    const Real theta = phase(at, time);
    return growth(time) * (0.5 * given_.height * std::cos(theta) + second_elevation_ * std::cos(2 * theta));
  }

  /// At a point in the water; `z` is its height above still water, at most the elevation there [m].
  WaterMotion at(const Vector3& place, Real z, Real time) const {
    return is_solitary() ? solitary_motion(place, z, time) : regular_motion(place, z, time);
  }

  /// Under a crest of the grown wave, at the surface, where the water is fastest [m/s].
  Real largest_speed() const {
    const Vector3 crest = given_.crest * given_.towards;
    const Real time = is_solitary() ? 0 : std::ceil(std::max<Real>(given_.ramp, 0) / given_.period) * given_.period;
    return at(crest, elevation(crest, time), time).velocity.norm();
  }

private:
  bool is_solitary() const { return given_.theory == WaveTheory::solitary; }
  Real along(const Vector3& at) const { return given_.towards.dot(at) - given_.crest; }
  Real phase(const Vector3& at, Real time) const { return number_ * along(at) - frequency_ * time; }
  Real growth(Real time) const {
    if (!(given_.ramp > 0) || time >= given_.ramp) return 1;
    if (time <= 0) return 0;
    return 0.5 * (1 - std::cos(std::numbers::pi * time / given_.ramp));
  }
  WaterMotion of_plane(Real u, Real w, Real along, Real up) const {
    return {u * given_.towards + w * given_.up, along * given_.towards + up * given_.up};
  }

  /// A harmonic of the potential: velocities u = a c cos n theta, w = a s sin n theta, where c and s are hyperbolic cosine and sine
  /// of n k (z + d), over what the amplitude `a` is divided by.
  struct Harmonic {
    Real cosine, sine;
  };
  /// cosh k(z + d)/sinh kd, and the sine.
  Harmonic first(Real z) const {
    const Real up = std::exp(number_ * z), down = std::exp(-number_ * (z + 2 * given_.depth)), whole = 1 - decay_;
    return {(up + down) / whole, (up - down) / whole};
  }
  /// cosh 2k(z + d)/sinh^4 kd, and the sine.
  Harmonic second(Real z) const {
    const Real d = given_.depth, up = std::exp(2 * number_ * (z - d)), down = std::exp(-2 * number_ * (z + 3 * d)),
               whole = 1 - decay_, over = 8 / (whole * whole * whole * whole);
    return {over * (up + down), over * (up - down)};
  }

  WaterMotion regular_motion(const Vector3& place, Real z, Real time) const {
    const Real theta = phase(place, time), grown = growth(time), k = number_, w = frequency_, height = grown * given_.height;
    if (given_.theory == WaveTheory::airy) {
      const Real eta = 0.5 * height * std::cos(theta);
      z = given_.depth * (z - eta) / (given_.depth + eta);
    }
    const Harmonic h = first(z);
    const Real a = 0.5 * height * w, cosine = std::cos(theta), sine = std::sin(theta);
    const Real u = a * h.cosine * cosine, up = a * h.sine * sine;
    if (given_.theory == WaveTheory::airy) return of_plane(u, up, w * a * h.cosine * sine, -w * a * h.sine * cosine);
    const Harmonic g = second(z);
    const Real b = 3.0 / 16 * height * height * w * k, cosine2 = std::cos(2 * theta), sine2 = std::sin(2 * theta);
    const Real u2 = u + b * g.cosine * cosine2, up2 = up + b * g.sine * sine2;
    const Real u_x = -k * (a * h.cosine * sine + 2 * b * g.cosine * sine2), u_z = k * (a * h.sine * cosine + 2 * b * g.sine * cosine2);
    // The flow is free of rotation and of divergence: w_x = u_z, w_z = -u_x; all goes on at the speed w/k.
    return of_plane(u2, up2, (u2 - w / k) * u_x + up2 * u_z, (u2 - w / k) * u_z - up2 * u_x);
  }

  struct Solitary {
    Real eta, slope, curvature;  ///< along the wave
  };
  Real solitary_speed() const { return std::sqrt(given_.gravity * (given_.depth + given_.height)); }
  Solitary solitary(const Vector3& at, Real time) const {
    const Real d = given_.depth, width = std::sqrt(0.75 * given_.height / (d * d * d)),
               s = width * (along(at) - solitary_speed() * time), sech = 1 / std::cosh(s), tanh = std::tanh(s),
               eta = given_.height * sech * sech;
    return {eta, -2 * width * eta * tanh, width * width * eta * (4 - 6 * sech * sech)};
  }
  WaterMotion solitary_motion(const Vector3& place, Real z, Real time) const {
    const Solitary wave = solitary(place, time);
    const Real c = solitary_speed(), d = given_.depth, column = d + wave.eta, from_bed = z + d;
    const Real u = c * wave.eta / column, u_x = c * d * wave.slope / (column * column),
               u_xx = c * d * (wave.curvature / (column * column) - 2 * wave.slope * wave.slope / (column * column * column));
    return of_plane(u, -from_bed * u_x, (u - c) * u_x, from_bed * (u_x * u_x - (u - c) * u_xx));
  }

  Given given_;
  Real frequency_ = 0;         ///< [rad/s]
  Real number_ = 0;            ///< [1/m]
  Real decay_ = 0;             ///< exp(-2 k d)
  Real second_elevation_ = 0;  ///< [m]
};

}  // namespace sazare::laws
