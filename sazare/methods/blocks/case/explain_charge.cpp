#include "sazare/methods/blocks/case/explain_charge.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/explanation.hpp"
#include "sazare/methods/blocks/case/fields.hpp"

namespace sazare::cases {

std::vector<std::string> charge_lines(const Charge& charge, std::size_t place) {
  const laws::Explosive filling = charge.filling();
  const Real length = charge.bottom_depth() - charge.top, mass = filling.density * charge.volume();
  const Real ratio = charge.diameter / charge.explosive_diameter();
  const Real reach = std::max(charge.primer_depth() - charge.top, charge.bottom_depth() - charge.primer_depth());
  std::vector<std::string> lines{fmt::format("{}: {} of {} on surface {}, {} to {} m deep in a hole of {} m", charge.name,
                                             number(mass) + " kg", word(charge.explosive), charge.surface, number(charge.top),
                                             number(charge.bottom_depth()), number(charge.hole_length()))};
  lines.push_back(fmt::format("{} across{}, {}, {} J ({} J/kg)", number(charge.explosive_diameter()) + " m",
                              ratio > 1 ? fmt::format(" in a hole of {} m", number(charge.diameter)) : "",
                              number(mass / length) + " kg/m", number(filling.energy * charge.volume()),
                              number(filling.energy / filling.density)));
  lines.push_back(fmt::format("fires at {} s at a depth of {} m, detonates at {} m/s within {} s",
                              number(charge.firing_time(place)), number(charge.primer_depth()), number(filling.velocity),
                              number(reach / filling.velocity)));
  lines.push_back(fmt::format("pressure on the wall before it yields {}",
                              stress_text(laws::jwl_pressure(filling.gas, ratio * ratio, filling.energy))));
  if (charge.vents)
    lines.push_back(charge.top > 0
                        ? fmt::format("pushes {} m of stemming of {} kg/m3 out of the hole, then leaves through the collar",
                                      number(charge.top), number(charge.stemming_density))
                        : std::string("leaves through the collar"));
  if (charge.gas_in_cracks == GasInCracks::share)
    lines.push_back(fmt::format("acts in connected cracks with {} of its pressure", number(charge.crack_pressure_share)));
  if (charge.gas_in_cracks == GasInCracks::flow)
    lines.push_back(
        fmt::format("flows into connected cracks, {} m wider than their faces are apart", number(charge.crack_aperture)));
  return lines;
}

}  // namespace sazare::cases
