#include <fmt/format.h>

#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/soil/checks.hpp"

namespace sazare::cases {
namespace {

using Names = std::vector<std::string_view>;

const Names ghe_keys{"ghe_c1_end", "ghe_c2_begin", "ghe_c2_end", "ghe_alpha", "ghe_beta"};

Names with_ghe_keys(Names names) {
  names.insert(names.end(), ghe_keys.begin(), ghe_keys.end());
  return names;
}

/// A curve of the general hyperbolic equation that begins stiffer than G0, or falls, is none that the soil can follow.
void check_hyperbola(const CheckContext& context, const Entry& entry, const SoilBackbone& soil) {
  for (const std::string_view key : ghe_keys)
    if (!entry.gives(key)) return;
  const laws::GeneralHyperbola& form = soil.hyperbola;
  constexpr int points = 100;
  const Real end = form.strain_at(1);
  Real before = 0, at = 0;
  for (const Real strain : laws::spaced_strains(laws::first_curve_strain, laws::last_curve_strain, points)) {
    if (strain > end) break;
    const Real stress = form.stress(strain);
    if (stress < before || stress > strain * (1 + 1e-9)) {
      context.problems.error(
          entry.place("backbone"),
          fmt::format("the general hyperbolic equation gives a stress of {} times the strength at {} times the "
                      "reference strain, and {} before, at {}",
                      short_number(stress, 4), short_number(strain, 3), short_number(before, 4), short_number(at, 3)),
          "a first loading must not fall, nor be stiffer than G0: check the coefficients");
      return;
    }
    before = stress, at = strain;
  }
}

void check_backbone_keys(const CheckContext& context, const Entry& entry, const SoilBackbone& soil) {
  if (!soil.degrades)
    return check_keys(
        context, entry, "a material without backbone", {},
        with_ghe_keys({"reference_strain", "shear_strength", "ramberg_osgood_exponent", "modulus_reduction", "yield_surfaces"}),
        "give the material a backbone, or remove it");
  if (soil.backbone != BackboneKind::general_hyperbolic)
    check_keys(context, entry, "another backbone than general_hyperbolic", {}, ghe_keys, "remove it");
  switch (soil.backbone) {
    case BackboneKind::hyperbolic:
      check_keys(context, entry, "a hyperbolic backbone", {}, {"ramberg_osgood_exponent", "modulus_reduction"});
      if (!entry.has("reference_strain") && !entry.has("shear_strength"))
        context.problems.error(entry.place("backbone"), "a hyperbolic backbone has neither reference_strain nor shear_strength",
                               "give the shear strain at which G/G0 = 0.5, or the shear strength; each follows from the other");
      break;
    case BackboneKind::ramberg_osgood:
      check_keys(context, entry, "a backbone of Ramberg and Osgood",
                 {"reference_strain", "ramberg_osgood_exponent", "shear_strength"}, {"modulus_reduction"});
      break;
    case BackboneKind::general_hyperbolic:
      check_keys(context, entry, "a backbone of the general hyperbolic equation", with_ghe_keys({"shear_strength"}),
                 {"reference_strain", "ramberg_osgood_exponent", "modulus_reduction"});
      check_hyperbola(context, entry, soil);
      break;
    case BackboneKind::table:
      check_keys(context, entry, "a backbone from a table", {"modulus_reduction"},
                 {"reference_strain", "ramberg_osgood_exponent", "yield_surfaces"});
      break;
  }
}

/// The strength of a curve by its formula lies between the stress at the reference strain and, of a hyperbola, its limit.
void check_strength_of_formula(const CheckContext& context, const Entry& entry, Real shear_modulus, const SoilBackbone& soil) {
  if (!entry.gives("reference_strain") || !entry.gives("shear_strength")) return;
  const Real limit = shear_modulus * *soil.reference_strain, given = *soil.shear_strength;
  if (given < 0.5 * limit)
    context.problems.error(entry.place("shear_strength"),
                           fmt::format("shear_strength must be at least G0 reference_strain/2 = {} Pa, found {}",
                                       short_number(0.5 * limit), short_number(given)),
                           "this is the stress at the reference strain, where G/G0 = 0.5; lower the reference strain");
  if (soil.backbone == BackboneKind::hyperbolic && given > limit * (1 + 1e-9))
    context.problems.error(entry.place("shear_strength"),
                           fmt::format("shear_strength must be at most G0 reference_strain = {} Pa, found {}",
                                       short_number(limit), short_number(given)),
                           "the hyperbola ends there; raise the reference strain, or give one of the two alone");
}

void check_strength_of_table(const CheckContext& context, const Entry& entry, Real shear_modulus, const SoilBackbone& soil) {
  if (!entry.gives("shear_strength")) return;
  const auto points = points_of(soil.reduction, shear_modulus);
  const Real last = points.back().stress, given = *soil.shear_strength;
  if (given < last * (1 - 1e-9))
    context.problems.error(entry.place("shear_strength"),
                           fmt::format("shear_strength must be at least the stress of the table's last row, {} Pa, found {}",
                                       short_number(last), short_number(given)),
                           "remove the rows beyond the strength, or leave shear_strength out: the stress then stays that of the "
                           "last row");
  if (given > last * (1 + 1e-9) && points[points.size() - 2].stress >= last)
    context.problems.error(entry.place("shear_strength"),
                           fmt::format("the stress of the table has ended at {} Pa, below shear_strength", short_number(last)),
                           "leave shear_strength out, or correct the last rows, over which G/G0 times strain does not grow");
}

/// Few corners make a damping curve that goes up and down between them.
void check_corners(const CheckContext& context, const Entry& entry, const SoilBackbone& soil) {
  constexpr int few_surfaces = 10;
  constexpr Real widest_gap = 5, nearly_elastic = 0.95;
  if (entry.gives("yield_surfaces") && soil.yield_surfaces < few_surfaces)
    context.problems.warning(
        entry.place("yield_surfaces"),
        fmt::format("the backbone has {} corners, between which its damping goes up and down", soil.yield_surfaces),
        fmt::format("give at least {}; the default is 30", few_surfaces));
  const auto& strain = soil.reduction.strain;
  for (std::size_t n = 1; n < strain.size(); ++n)
    if (strain[n] > widest_gap * strain[n - 1] && soil.reduction.ratio[n] < nearly_elastic)
      return context.problems.warning(
          entry.place("modulus_reduction"),
          fmt::format("no row of the table lies between the strains {} and {}, between which its damping goes up and down",
                      short_number(strain[n - 1]), short_number(strain[n])),
          "give five rows for each power of ten, between measured ones by interpolation");
}

void check_table(const CheckContext& context, const Entry& entry, const SoilMaterial& material, SoilBackbone& soil) {
  if (!entry.gives("modulus_reduction")) return;
  const std::string as_written = *entry.value->find("modulus_reduction")->text();
  const Place place = entry.place("modulus_reduction");
  if (!check_file(context, place, "table of G/G0", soil.modulus_reduction, as_written)) return;
  read_modulus_reduction(soil, (context.shown_folder / as_written).lexically_normal().string(), place, context.problems);
  if (material.modulus_is_known && !soil.reduction.strain.empty())
    check_strength_of_table(context, entry, material.shear_modulus, soil);
}

}  // namespace

void check_soil(const CheckContext& context, const Entry& entry, const SoilMaterial& material, SoilBackbone& soil) {
  if (entry.has("backbone") && !entry.gives("backbone")) return;  // which keys belong to it is not known
  check_backbone_keys(context, entry, soil);
  if (!soil.degrades) return;
  if (material.yields)
    context.problems.error(entry.place("cohesion"), "the material has both a backbone and a cohesion",
                           "keep one of them: a backbone ends in its own shear_strength");
  if (soil.backbone == BackboneKind::table)
    check_table(context, entry, material, soil);
  else if (material.modulus_is_known && soil.backbone != BackboneKind::general_hyperbolic)
    check_strength_of_formula(context, entry, material.shear_modulus, soil);
  check_corners(context, entry, soil);
}

}  // namespace sazare::cases
