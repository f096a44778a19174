#pragma once

/// Strength that grows with the rate of strain: factors on the static strength, by published forms.
///
///     fib_2010        f = (e/e_0)^0.018             e <= 10/s    e    strain rate [1/s], e_0 = 1e-6/s
///                     f = 0.0062 (e/e_0)^(1/3)      e > 10/s     [fib2010], 5.1.11.2, concrete in tension, up to 300/s
///     malvar_ross     f = (e/e_0)^d                 e <= 1/s     d = 1/(1 + 8 f_c/10 MPa), f_c compressive strength [Pa]
///                     f = b (e/e_0)^(1/3)           e > 1/s      log10 b = 6 d - 2; [MalvarRoss1998], concrete in tension
///     cowper_symonds  f = 1 + (e/D)^(1/q)                        D    strain rate that doubles the strength [1/s]
///     logarithmic     f = 1 + C log10(e/D)          e > D        C    growth of f per tenfold rate
///
/// No factor is below 1. Those for concrete grow no more beyond the rate `fastest`, where nothing was measured.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "sazare/core/vector.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::laws {

struct NoIncrease {
  static constexpr std::string_view word = "none";
  static constexpr std::array<LawParameter, 0> parameters{};
  static Real factor(Real, const std::array<Real, 0>&) { return 1; }
};

struct FibIncrease {
  static constexpr std::string_view word = "fib_2010";
  static constexpr std::array<LawParameter, 0> parameters{};
  static constexpr Real slowest = 1e-6, bend = 10, fastest = 300;  // [1/s]

  static Real factor(Real rate, const std::array<Real, 0>&) {
    const Real ratio = std::clamp(rate, slowest, fastest) / slowest;
    return ratio * slowest <= bend ? std::pow(ratio, 0.018) : 0.0062 * std::cbrt(ratio);
  }
};

struct MalvarRossIncrease {
  static constexpr std::string_view word = "malvar_ross";
  static constexpr std::array parameters{LawParameter{
      .name = "static_compressive_strength",
      .unit = "Pa",
      .note = "required for malvar_ross",
      .sentence = "Uniaxial compressive strength under static load, on which malvar_ross depends: weaker concrete gains more."}};
  static constexpr Real slowest = 1e-6, bend = 1, fastest = 300;  // [1/s]

  static Real factor(Real rate, const std::array<Real, 1>& own) {
    const Real ratio = std::clamp(rate, slowest, fastest) / slowest, exponent = 1 / (1 + 8 * own[0] / 10e6);
    return ratio * slowest <= bend ? std::pow(ratio, exponent) : std::pow(10, 6 * exponent - 2) * std::cbrt(ratio);
  }
};

inline constexpr LawParameter rate_scale{
    .name = "rate_scale",
    .unit = "1/s",
    .note = "required for cowper_symonds and logarithmic",
    .sentence =
        "Strain rate of the rate law: that doubles the strength (cowper_symonds), or beyond which it grows (logarithmic)."};

struct CowperSymondsIncrease {
  static constexpr std::string_view word = "cowper_symonds";
  static constexpr std::array parameters{
      rate_scale,
      LawParameter{.name = "rate_exponent",
                   .unit = "",
                   .note = "required for cowper_symonds",
                   .sentence = "Exponent q of Cowper and Symonds: the strength grows by the q-th root of the strain rate."}};

  static Real factor(Real rate, const std::array<Real, 2>& own) {
    return 1 + std::pow(std::max<Real>(rate, 0) / own[0], 1 / own[1]);
  }
};

struct LogarithmicIncrease {
  static constexpr std::string_view word = "logarithmic";
  static constexpr std::array parameters{
      rate_scale,
      LawParameter{
          .name = "rate_slope",
          .unit = "",
          .note = "required for logarithmic",
          .sentence = "Growth of the strength, as a share of the static one, with every tenfold strain rate beyond rate_scale."}};

  static Real factor(Real rate, const std::array<Real, 2>& own) {
    return rate > own[0] ? 1 + own[1] * std::log10(rate / own[0]) : 1;
  }
};

using RateLaws = std::tuple<NoIncrease, FibIncrease, MalvarRossIncrease, CowperSymondsIncrease, LogarithmicIncrease>;

enum class RateLawName {
  none = place_of_law<RateLaws, NoIncrease>(),
  fib_2010 = place_of_law<RateLaws, FibIncrease>(),
  malvar_ross = place_of_law<RateLaws, MalvarRossIncrease>(),
  cowper_symonds = place_of_law<RateLaws, CowperSymondsIncrease>(),
  logarithmic = place_of_law<RateLaws, LogarithmicIncrease>()
};

/// What the laws take; those of other laws than the chosen one are not given.
using RateLawParameters = std::array<std::optional<Real>, parameters_of_laws<RateLaws>.size()>;

/// A rate law with its numbers.
struct DynamicIncrease {
  RateLawName law = RateLawName::none;
  RateLawParameters parameters{};
  Real energy_exponent = 1;  ///< fracture energies have the factor f to this power

  /// On the static strength, at a strain rate [1/s]. What the law takes must be given.
  Real factor(Real rate) const {
    return visit_law_at<RateLaws>(static_cast<std::size_t>(law), [&]<class Law>(Law) {
      const auto given = own_parameters<RateLaws, Law>(parameters);
      std::array<Real, Law::parameters.size()> own{};
      for (std::size_t n = 0; n < own.size(); ++n) own[n] = given[n].value();
      return Law::factor(rate, own);
    });
  }

  /// On the openings and slips at which a joint of this factor has used up its energy.
  Real length_factor(Real factor) const { return energy_exponent == 1 ? 1 : std::pow(factor, energy_exponent - 1); }

  /// The largest factor of a joint that softens beyond an elastic opening, if any factor is too large; `ratio` is the opening at
  /// failure over that elastic one under static load.
  Real largest_factor(Real ratio) const {
    return energy_exponent < 2 ? std::pow(ratio, 1 / (2 - energy_exponent)) : std::numeric_limits<Real>::infinity();
  }
};

}  // namespace sazare::laws
