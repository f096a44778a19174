#include <fmt/format.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/explanation.hpp"
#include "sazare/methods/spheres/case/fields.hpp"
#include "sazare/methods/spheres/case/format.hpp"

namespace sazare::cases {
namespace {

std::string contact_text(const GranularContact& contact, const MaterialPair& pair = {}) {
  const auto of = [](const std::optional<Real>& own, Real of_all) { return number(own.value_or(of_all)); };
  return fmt::format("restitution {}, friction {}, rolling {}, twisting {}", of(pair.restitution, contact.restitution),
                     of(pair.friction_coefficient, contact.friction_coefficient),
                     of(pair.rolling_friction, contact.rolling_friction), of(pair.twisting_friction, contact.twisting_friction));
}

std::string wall_text(const WallRules& wall) {
  std::string text = fmt::format("{}: {} of {}", wall.name, word(wall.shape), wall.material);
  text += motion_names_text(wall.motion);
  if (wall.spin.norm() > 0) text += fmt::format(", turns at {} rad/s", number(wall.spin.norm()));
  return text;
}

std::string bond_text(const BondRules& bond) {
  std::string text = bond.between[0].empty() ? fmt::format("{}: within bodies, ", bond.name)
                                             : fmt::format("{}: {} with {}, ", bond.name, bond.between[0], bond.between[1]);
  text += bond.youngs_modulus ? fmt::format("E {} Pa", number(*bond.youngs_modulus))
                              : fmt::format("{} and {} Pa/m", number(bond.normal_stiffness.value_or(0)),
                                            number(bond.shear_stiffness.value_or(0)));
  if (bond.tensile_strength) text += fmt::format(", tensile strength {} Pa", number(*bond.tensile_strength));
  if (bond.cohesion) text += fmt::format(", cohesion {} Pa", number(*bond.cohesion));
  return text + (bond.fracture_energy ? fmt::format(", fracture energy {} N/m", number(*bond.fracture_energy))
                 : bond.breaks()      ? ", brittle"
                                      : "");
}

}  // namespace

std::string explain(const SpheresCase& spheres) {
  std::string text = spheres.title + "\n";
  const GranularContact& contact = spheres.contact;
  for (const SphereMaterial& material : spheres.materials)
    text +=
        line("materials", laws::visit_law(contact.model, []<class Law>(Law) { return Law::needs_elasticity; })
                              ? fmt::format("{}: {} kg/m3, E {} Pa, Poisson's ratio {}", material.name, number(material.density),
                                            number(material.youngs_modulus), number(material.poisson_ratio))
                              : fmt::format("{}: {} kg/m3", material.name, number(material.density)));
  text += line("contact", fmt::format("{}: {}", word(contact.model), contact_text(contact)));
  for (const MaterialPair& pair : spheres.pairs)
    text += line("pairs", fmt::format("{} and {}: {}", pair.between[0], pair.between[1], contact_text(contact, pair)));
  for (const ClumpShape& shape : spheres.shapes)
    text += line("shapes", fmt::format("{}: {}, {}", shape.name, word(shape.source),
                                       shape.bonds.empty() ? "rigid" : fmt::format("bonded by {}", shape.bonds)));
  for (const SphereGroup& group : spheres.spheres)
    text += line("spheres", fmt::format("{}: {} of {}{}{}{}", group.name, word(group.source), group.material,
                                        group.shape.empty() ? "" : ", shape " + group.shape, group.held ? ", held" : "",
                                        group.rain ? ", falls and comes to rest before the start" : ""));
  for (const BondRules& bond : spheres.bonds) text += line("bonds", bond_text(bond));
  text += explain_gravity(spheres.gravity.acceleration);
  text += explain_water(spheres.water, spheres.gravity);
  text += explain_motions(spheres.motions, spheres.time.end);
  for (const WallRules& wall : spheres.walls) text += line("walls", wall_text(wall));
  for (const GroupGauge& gauge : spheres.gauges)
    text += line("gauges", fmt::format("{}: centre of mass of {}", gauge.name, gauge.group));
  const auto count = [&](Real interval) { return whole_multiple(spheres.time.end, interval).value_or(0); };
  text += line("time", fmt::format("to {} s, {} history rows, {} snapshots", number(spheres.time.end),
                                   count(spheres.time.history_interval), count(spheres.time.snapshot_interval)));
  return text;
}

}  // namespace sazare::cases
