#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/usual_values.hpp"
#include "sazare/methods/blocks/case/checks.hpp"
#include "sazare/methods/blocks/case/fields.hpp"

namespace sazare::cases {
namespace {

/// Constants that do not belong together give the gas too much pressure or too little.
void check_detonation(const CheckContext& context, const Entry& entry, const laws::Explosive& explosive) {
  constexpr Real most = 0.1;
  const Real pressure = laws::jwl_pressure(explosive.gas, 1, explosive.energy);
  if (!std::isfinite(pressure) || pressure <= 0) {
    context.problems.error(entry.place("explosive"), "the gas of this explosive has no pressure that is a finite number above 0",
                           "check the constants of its gas");
    return;
  }
  const Real off = laws::detonation_mismatch(explosive);
  if (off <= most) return;
  context.problems.warning(
      entry.place("explosive"),
      fmt::format("these constants miss the laws of a steady detonation by {} %", short_number(100 * off, 2)),
      "density, velocity, energy and the constants of the gas are to be of one explosive at one density; are they in SI units?");
}

/// A gas of an exponent near to 1 needs much energy to detonate as fast as it does.
void check_energy(const CheckContext& context, const Entry& entry, const Charge& charge) {
  if (entry.has("explosive_energy")) return;
  const Real energy = charge.filling().energy / charge.density.value();
  if (energy >= usual::explosive_energy.low && energy <= usual::explosive_energy.high) return;
  context.problems.warning(
      entry.place("gas_exponent"),
      fmt::format("by its velocity this explosive has {} J/kg, explosives usually {} to {}", short_number(energy),
                  short_number(usual::explosive_energy.low), short_number(usual::explosive_energy.high)),
      "give its explosive_energy, or another gas_exponent: 3 is usual for the dense gas of commercial explosives");
}

/// The constants of a custom explosive are all there; one of the table has none of its own but its velocity.
void check_explosive(const CheckContext& context, const Entry& entry, const Charge& charge) {
  if (!entry.gives("explosive")) return;
  if (!charge.is_custom()) {
    std::vector<std::string_view> foreign{"density", "explosive_energy", "gas_exponent"};
    foreign.insert(foreign.end(), jwl_keys.begin(), jwl_keys.end());
    check_keys(context, entry, fmt::format("explosive {}", word(charge.explosive)), {}, foreign);
    return;
  }
  std::vector<std::string_view> needed{"density", "detonation_velocity"};
  const bool has_jwl = std::ranges::any_of(jwl_keys, [&](std::string_view key) { return entry.has(key); });
  if (has_jwl) {
    needed.push_back("explosive_energy");
    needed.insert(needed.end(), jwl_keys.begin(), jwl_keys.end());
  }
  check_keys(context, entry, "explosive custom", needed, {});
  if (has_jwl && entry.has("gas_exponent"))
    context.problems.error(*entry.value->key_place("gas_exponent"), "the charge has both a gas_exponent and constants of JWL",
                           "keep one of the two");
  if (!has_jwl && !entry.has("gas_exponent"))
    context.problems.error(
        entry.place("explosive"), "nothing says how the gas of this explosive expands",
        "add gas_exponent = ... (3 is usual for the dense gas of commercial explosives) or jwl_a, jwl_b, jwl_r1, "
        "jwl_r2 and jwl_omega");
  const bool is_whole = std::ranges::all_of(needed, [&](std::string_view key) { return entry.gives(key); });
  if (!is_whole || has_jwl == entry.gives("gas_exponent")) return;
  check_detonation(context, entry, charge.filling());
  if (!has_jwl) check_energy(context, entry, charge);
}

/// The charge lies in its hole, and the primer in the charge. Whether there is more to check.
bool check_depths(const CheckContext& context, const Entry& entry, const Charge& charge) {
  for (const std::string_view key : {"collar", "toe", "top", "bottom", "primer", "diameter", "charge_diameter"})
    if (entry.has(key) && !entry.is_sound(key)) return false;
  if (!entry.gives("collar") || !entry.gives("toe")) return false;
  const Real length = charge.hole_length();
  if (!(length > 0)) {
    context.problems.error(entry.place("toe"), "the hole has no length: its toe is at its collar",
                           "collar and toe are the two ends of the hole's axis");
    return false;
  }
  const auto depth = [](Real value) { return short_number(value, 6); };
  if (charge.bottom_depth() > length * (1 + 1e-9))
    context.problems.error(
        entry.place("bottom"),
        fmt::format("the charge ends at {} m, beyond the toe of its hole at {} m", depth(charge.bottom_depth()), depth(length)),
        "depths count along the hole from its collar; leave bottom out for a charge that reaches the toe");
  if (!(charge.top < charge.bottom_depth()))
    context.problems.error(entry.place("top"),
                           fmt::format("the charge has no length: it begins at {} m and ends at {} m", depth(charge.top),
                                       depth(charge.bottom_depth())),
                           "top is the depth at which the explosive begins (the length of the stemming), bottom where it ends");
  else if (charge.primer_depth() < charge.top || charge.primer_depth() > charge.bottom_depth())
    context.problems.error(entry.place("primer"),
                           fmt::format("the primer at {} m lies outside the charge, which reaches from {} to {} m",
                                       depth(charge.primer_depth()), depth(charge.top), depth(charge.bottom_depth())),
                           "put it between top and bottom of the charge");
  if (charge.explosive_diameter() > charge.diameter)
    context.problems.error(entry.place("charge_diameter"),
                           fmt::format("the explosive is thicker ({} m) than its hole ({} m)", depth(charge.explosive_diameter()),
                                       depth(charge.diameter)),
                           "charge_diameter is that of the explosive, diameter that of the hole");
  return true;
}

/// Two charges of one hole stand apart.
void check_decks(const CheckContext& context, const Entry& entry, const Charge& charge, const Charge& other) {
  if (charge.surface.empty() || charge.surface != other.surface) return;
  if ((charge.collar - other.collar).norm() + (charge.toe - other.toe).norm() > 1e-9 * charge.hole_length()) {
    context.problems.error(entry.place("collar"),
                           fmt::format("the charges \"{}\" and \"{}\" have one wall and different axes", other.name, charge.name),
                           "give each hole a physical group of its own, or the decks of one hole the same collar and toe");
    return;
  }
  if (std::max(charge.top, other.top) < std::min(charge.bottom_depth(), other.bottom_depth()))
    context.problems.error(entry.place("top"),
                           fmt::format("the charges \"{}\" and \"{}\" of one hole overlap", other.name, charge.name),
                           "decks stand one above the other");
}

/// Only the uppermost charge of a hole stands beneath its collar.
void check_collar(const CheckContext& context, const Entry& entry, const Charge& charge, std::span<const Charge> charges) {
  if (!charge.vents || !entry.gives("vents")) return;
  for (const Charge& other : charges)
    if (other.surface == charge.surface && other.top < charge.top)
      context.problems.error(
          entry.place("vents"),
          fmt::format("the charge \"{}\" does not stand beneath the collar: \"{}\" is above it", charge.name, other.name),
          "give vents = true to the uppermost charge of the hole");
}

/// Keys of cracks are given where they mean something.
void check_cracks(const CheckContext& context, const Entry& entry, const Charge& charge) {
  std::vector<std::string_view> foreign;
  if (charge.gas_in_cracks != GasInCracks::share) foreign.push_back("crack_pressure_share");
  if (charge.gas_in_cracks != GasInCracks::flow) foreign.push_back("discharge_coefficient");
  if (charge.gas_in_cracks == GasInCracks::none) foreign.push_back("crack_aperture");
  check_keys(context, entry, fmt::format("gas_in_cracks {}", word(charge.gas_in_cracks)), {}, foreign);
}

/// Gas does not know of joints that the rock has already.
void warn_of_natural_joints(const CheckContext& context, const Entry& entry, const Charge& charge, const BlocksCase& blocks) {
  const auto natural = std::ranges::find_if(blocks.joints, &Joint::is_natural);
  if (charge.gas_in_cracks == GasInCracks::none || natural == blocks.joints.end()) return;
  context.problems.warning(
      entry.place("gas_in_cracks"),
      fmt::format("gas does not enter the natural joint \"{}\" before its faces have parted as a whole", natural->name),
      "where gas in existing joints matters, give the joint bonded = false, or keep in mind that this run has none there");
}

/// A detonator cannot fire before the run begins.
void check_scatter(const CheckContext& context, const Entry& entry, const Charge& charge, std::size_t place) {
  if (!entry.gives("delay_scatter") || !(charge.delay_scatter > 0) || charge.firing_time(place) > 0) return;
  context.problems.warning(
      entry.place("delay_scatter"), "by its scatter the charge would fire before the run begins, and fires at 0 s",
      "give all charges a delay of three times the scatter more, or choose another scatter_seed");
}

void check_delay(const CheckContext& context, const Entry& entry, const Charge& charge, Real end) {
  if (!(end > 0) || !entry.gives("delay") || charge.delay < end) return;
  context.problems.warning(
      entry.place("delay"),
      fmt::format("the charge fires at {} s, after the end of the run at {} s", short_number(charge.delay), short_number(end)),
      "choose a later end in [time], or remove the charge; delays are in s");
}

}  // namespace

void check_charges(const CheckContext& context, const BlocksCase& blocks) {
  const auto list = context.entries_of("charges");
  std::vector<bool> is_placed;
  for (std::size_t i = 0; i < list.size(); ++i) {
    is_placed.push_back(false);
    if (!list[i].exists()) continue;
    const Charge& charge = blocks.charges[i];
    check_explosive(context, list[i], charge);
    is_placed[i] = check_depths(context, list[i], charge);
    for (std::size_t other = 0; is_placed[i] && other < i; ++other)
      if (is_placed[other]) check_decks(context, list[i], charge, blocks.charges[other]);
    check_collar(context, list[i], charge, blocks.charges);
    check_cracks(context, list[i], charge);
    warn_of_natural_joints(context, list[i], charge, blocks);
    check_scatter(context, list[i], charge, i);
    check_delay(context, list[i], charge, blocks.time.end);
    for (const Blast& blast : blocks.blasts)
      if (list[i].gives("surface") && blast.surface == charge.surface)
        context.problems.warning(list[i].place("surface"),
                                 fmt::format("a blast acts on the surface \"{}\" too: pressure and gas add up", charge.surface),
                                 "keep the charge or the blast, if that is not meant");
  }
}

}  // namespace sazare::cases
