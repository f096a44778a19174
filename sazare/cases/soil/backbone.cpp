#include "sazare/cases/soil/backbone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/soil/fields.hpp"

namespace sazare::cases {
namespace {

constexpr Real real_damping = 0.25;  // beyond it, Masing's rules give more than soil has

/// Damping ratio of a table at a strain, linear over its logarithm; none outside of the rows.
std::optional<Real> damping_at(const ModulusReduction& table, Real strain) {
  if (table.damping.empty() || strain < table.strain.front() || strain > table.strain.back()) return {};
  const auto after = static_cast<std::size_t>(std::ranges::lower_bound(table.strain, strain) - table.strain.begin());
  if (after == 0) return table.damping.front();
  const Real share = std::log(strain / table.strain[after - 1]) / std::log(table.strain[after] / table.strain[after - 1]);
  return table.damping[after - 1] + share * (table.damping[after] - table.damping[after - 1]);
}

std::string percent(Real share) { return number(100 * share, 3) + " %"; }

std::string damping_text(const SoilBackbone& soil, const laws::BackboneCurve& curve) {
  std::string text = "damping by Masing's rules:";
  bool too_much = false;
  for (const Real strain : {1e-4, 1e-3, 1e-2}) {
    const Real damping = curve.masing_damping(strain);
    too_much = too_much || damping > real_damping;
    text += fmt::format("{} {} at {}", strain == 1e-4 ? "" : ",", percent(damping), number(strain));
    if (const auto measured = damping_at(soil.reduction, strain)) text += fmt::format(" (table {})", percent(*measured));
  }
  if (too_much) text += fmt::format("; real soil has less than what exceeds {}", percent(real_damping));
  return text;
}

}  // namespace

std::vector<laws::CurvePoint> points_of(const ModulusReduction& table, Real shear_modulus) {
  std::vector<laws::CurvePoint> points;
  for (std::size_t i = 0; i < table.strain.size(); ++i)
    points.push_back({table.strain[i], shear_modulus * table.ratio[i] * table.strain[i]});
  return points;
}

std::vector<Real> lifts_of(const ModulusReduction& table) {
  const auto points = points_of(table, 1);
  auto hull = laws::concave_hull(points);
  hull.insert(hull.begin(), laws::CurvePoint{});
  std::vector<Real> lifts;
  for (const laws::CurvePoint& point : points) {
    const auto right = std::ranges::lower_bound(hull, point.strain, {}, &laws::CurvePoint::strain), left = right - 1;
    const Real share = (point.strain - left->strain) / (right->strain - left->strain);
    lifts.push_back((left->stress + share * (right->stress - left->stress)) / point.stress - 1);
  }
  return lifts;
}

laws::BackboneCurve backbone_of(const SoilBackbone& soil, Real modulus) {
  if (soil.backbone == BackboneKind::table) {
    const auto points = points_of(soil.reduction, modulus);
    return {modulus, points, soil.shear_strength.value_or(points.back().stress)};
  }
  if (soil.backbone == BackboneKind::general_hyperbolic)
    return laws::general_hyperbolic_curve(modulus, soil.hyperbola, *soil.shear_strength, soil.yield_surfaces);
  const Real reference = soil.reference_strain ? *soil.reference_strain : *soil.shear_strength / modulus;
  const Real strength = soil.shear_strength.value_or(modulus * reference);
  if (soil.backbone == BackboneKind::hyperbolic) return laws::hyperbolic_curve(modulus, reference, strength, soil.yield_surfaces);
  return laws::ramberg_osgood_curve(modulus, reference, soil.ramberg_osgood_exponent, strength, soil.yield_surfaces);
}

std::string soil_text(const SoilBackbone& soil, Real shear_modulus) {
  const laws::BackboneCurve curve = backbone_of(soil, shear_modulus);
  std::string text = fmt::format("\n  {:<12}  backbone {}: G0 {} Pa, shear strength {} Pa, G/G0 = 0.5 at a shear strain of {}",
                                 "", word(soil.backbone), number(curve.shear_modulus()), number(curve.strength()),
                                 number(curve.strain_at_ratio(0.5)));
  text += fmt::format("\n  {:<12}  {}", "", damping_text(soil, curve));
  if (soil.backbone != BackboneKind::table) return text;
  const Real lift = std::ranges::max(lifts_of(soil.reduction));
  if (lift > 1e-9)
    text += fmt::format("\n  {:<12}  rows of the table are lifted by up to {}, so that the stress nowhere becomes stiffer", "",
                        percent(lift));
  return text;
}

}  // namespace sazare::cases
