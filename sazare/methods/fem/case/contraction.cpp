#include "sazare/methods/fem/case/contraction.hpp"

#include "sazare/methods/fem/case/format.hpp"

namespace sazare::cases {

laws::CyclicContraction contraction_of(const FemMaterial& material) {
  const Real rate =
      material.contraction_rate ? *material.contraction_rate : laws::CyclicContraction::rate_of(*material.blow_count);
  return {rate, laws::CyclicContraction::decay_of(rate), material.contraction_threshold};
}

void check_contraction(const CheckContext& context, const FemCase& fem, const Entry& entry, const FemMaterial& material) {
  if (!material.contracts())
    return check_keys(context, entry, "a material that does not contract", {}, {"contraction_threshold"},
                      "give the material a blow_count or a contraction_rate, or remove it");
  if (material.blow_count && material.contraction_rate)
    context.problems.error(entry.place("contraction_rate"), "the material has both blow_count and contraction_rate",
                           "give exactly one of them: the blow count determines the rate");
  if (material.dilation_angle > 0)
    context.problems.error(entry.place("dilation_angle"), "ground that contracts under cycles has no dilation angle",
                           "give sand that can liquefy dilation_angle = 0, or remove its blow_count or contraction_rate");
  const Place place = entry.place(material.blow_count ? "blow_count" : "contraction_rate");
  if (entry.gives("friction_angle") && material.friction_angle == 0)
    context.problems.warning(
        entry.place("friction_angle"),
        "without friction the strength does not fall with the effective stress: such ground does not liquefy",
        "give sand its friction angle, or remove its blow_count or contraction_rate");
  if (fem.time.analysis == Analysis::statics && fem.motions.empty())
    context.problems.warning(place, "nothing shears the ground to and fro in a static run without motions: it takes no volume",
                             "set analysis = \"dynamic\" in [time], give the ground a motion, or remove it");
}

}  // namespace sazare::cases
