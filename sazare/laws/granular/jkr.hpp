#pragma once

/// Contact of elastic spheres with adhesion, after Johnson, Kendall and Roberts.
///
///     d = a^2/R - sqrt(2 pi w a/E)     N = 4 E a^3/(3 R) - sqrt(8 pi w E a^3) = 2 E a (d - a^2/(3 R))
///     U = E (d^2 a - 2 d a^3/(3 R) + a^5/(5 R^2)) - pi w a^2 + 3/5 pi w a_0^2        a_0^3 = 2 pi w R^2/E
///
/// d    overlap [m], negative across a neck                a    radius of the contact [m]
/// R    reduced radius [m]                                 w    work of adhesion [J/m2], per area of the interface
/// E    1/E = sum (1 - nu^2)/E_i [Pa]                      U    energy, the integral of N from d = 0 [J]
///
/// Approaching spheres come into contact at d = 0, where the contact at once has the radius a_0 and the force is tensile,
/// 4/3 pi w R. They separate where the neck has the radius a_c, below which there is no equilibrium at any d. Between the two the
/// tension reaches 3/2 pi w R, the pull-off force. With U, the energy dissipated when they separate is the work of pulling them
/// apart from d = 0:
///
///     a_c^3 = pi w R^2/(8 E)     d_c = -3/4 (pi^2 w^2 R/E^2)^(1/3)     U(d_c) = pi w (2/5 a_c^2 + 3/5 a_0^2)
///
/// which is 7.09 (w^5 R^4/E^2)^(1/3), as in [Thornton1998]. d, N and the pull-off force are those of [Johnson1971]. U is the
/// elastic energy of a sphere and a flat punch superposed, less that of the surfaces: its derivative by a is 0 and by d is N.
///
/// With a = x^2 the first equation is x^4 - c x - R d = 0. Ferrari's solution, used in another form by [Parteli2014], is written
/// here so that nearly equal numbers are subtracted near d_c alone:
///
///     x = 1/2 (sqrt(2 m) + sqrt(4 sqrt(m^2 + R d) - 2 m))     m^3 + R d m - g = 0     g = pi w R^2/(4 E)
///
/// m is the one positive root. Newton's method approaches it from above; from the start chosen here five steps give all digits.
///
/// Friction, rolling and twisting are limited by mu (N + 2 N_c), N_c being the pull-off force [Thornton1991], so that spheres
/// that are held together by adhesion alone resist sliding. Deviations: the peeling of the contact by a tangential force is left out;
/// the tangential stiffness and the dashpots are those of `Hertz` with this a. The coefficient of restitution is that of the
/// dashpots alone, and the dissipation by adhesion adds to theirs.

#include "sazare/core/cube_root.hpp"
#include "sazare/laws/granular/hertz.hpp"

namespace sazare::laws {

struct Jkr {
  static constexpr std::string_view word = "jkr";
  static constexpr bool needs_elasticity = true, adheres = true, slips_in_part = false;
  static constexpr Real steepness = 1.5;  // that of a contact whose radius stays
  static constexpr std::array parameters{
      LawParameter{.name = "surface_energy",
                   .unit = "J/m2",
                   .note = "required for model jkr, here or in every pair",
                   .sentence = "Work of adhesion w: energy per area that separates the two surfaces; for one material, twice the "
                               "surface energy of a free surface.",
                   .may_be_zero = true}};

  static ContactConstants<Real> constants(const MaterialsInContact& of, const std::array<Real, 1>& surface_energy) {
    ContactConstants<Real> constants = hertz_constants(of.one, of.other, of.restitution, of.friction);
    constants.adhesion = surface_energy[0];
    return constants;
  }

  template <class Number>
  static Number width(const ContactConstants<Number>& constants, const Number& overlap, const Reduced<Number>& radius) {
    const Number reduced = radius.value(), product = reduced * overlap, adhesion = adhesion_of(constants, reduced),
                 root = rough_cube_root(adhesion);
    // Bounds from above: two where spheres overlap, and across a neck the tangent at d = 0.
    Number m = select(product > Number{}, minimum(root, Number(adhesion / maximum(product, Number{} + tiny))),
                      Number(root - product / (3.0 * root)));
    for (int n = 0; n < 5; ++n) m = (2.0 * m * m * m + adhesion) / (3.0 * m * m + product);
    const Number rest = 4.0 * square_root(maximum(Number(m * m + product), Number{})) - 2.0 * m,
                 x = 0.5 * (square_root(Number(2.0 * m)) + square_root(maximum(rest, Number{})));
    return x * x;
  }
  template <class Number>
  static Number force(const ContactConstants<Number>& constants, const Number& width, const Number& overlap,
                      const Reduced<Number>& radius) {
    return 1.5 * constants.normal * width * (overlap - width * width / (3.0 * radius.value()));
  }
  template <class Number>
  static Number energy(const ContactConstants<Number>& constants, const Number&, const Number& width, const Number& overlap,
                       const Reduced<Number>& radius) {
    const Number reduced = radius.value(), deep = width * width / reduced, first = first_width(constants, reduced);
    return 0.75 * constants.normal * width * (overlap * overlap - 2.0 / 3 * overlap * deep + 0.2 * deep * deep) +
           std::numbers::pi * constants.adhesion * (0.6 * first * first - width * width);
  }
  template <class Number>
  static Number pressing(const ContactConstants<Number>& constants, const Number& normal, const Reduced<Number>& radius) {
    return maximum(Number(normal + 3 * std::numbers::pi * constants.adhesion * radius.value()), Number{});
  }

  /// d > d_c.
  template <class Number>
  static auto holds(const ContactConstants<Number>& constants, const Number& overlap, const Reduced<Number>& radius) {
    const Number ratio = std::numbers::pi * constants.adhesion / constants.normal;
    return overlap * overlap * overlap > Number{} - 0.75 * ratio * ratio * radius.value();
  }
  static Real neck(const ContactConstants<Real>& constants, Real reduced_radius) {
    const Real ratio = std::numbers::pi * constants.adhesion / constants.normal;
    return std::cbrt(0.75 * ratio * ratio * reduced_radius);
  }
  static Real parting_loss(const ContactConstants<Real>& constants, Real reduced_radius) {
    const Real first = first_width(constants, reduced_radius), last = first / std::cbrt(16.0);
    return std::numbers::pi * constants.adhesion * (0.4 * last * last + 0.6 * first * first);
  }

  static Real stored_energy(const ContactConstants<Real>& constants, Real overlap, Real reduced_radius) {
    const auto radius = Reduced<Real>::alone(reduced_radius);
    return energy(constants, Real{}, width(constants, overlap, radius), overlap, radius);
  }
  /// Beyond the overlap of equilibrium; by bisection.
  static Real overlap_of_energy(const ContactConstants<Real>& constants, Real energy, Real reduced_radius) {
    Real low = 0, high = reduced_radius;
    while (stored_energy(constants, high, reduced_radius) < energy) high *= 2;
    for (int n = 0; n < 200; ++n) {
      const Real middle = 0.5 * (low + high);
      (stored_energy(constants, middle, reduced_radius) < energy ? low : high) = middle;
    }
    return high;
  }

  static Real stable_step(const GrainInPack& grain) { return Hertz::stable_step(grain); }

private:
  static constexpr Real tiny = 1e-300;

  /// g.
  template <class Number>
  static Number adhesion_of(const ContactConstants<Number>& constants, const Number& reduced_radius) {
    return std::numbers::pi / 3 * constants.adhesion * reduced_radius * reduced_radius / constants.normal;
  }
  /// a_0.
  template <class Number>
  static Number first_width(const ContactConstants<Number>& constants, const Number& reduced_radius) {
    return 2.0 * cube_root(adhesion_of(constants, reduced_radius));
  }
};

}  // namespace sazare::laws
