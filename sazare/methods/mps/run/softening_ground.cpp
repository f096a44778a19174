#include "sazare/methods/mps/run/softening_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/number_text.hpp"

namespace sazare::runs {

namespace {

constexpr Real degree = std::numbers::pi / 180;

using cases::short_number;
using methods::mps::SofteningBand;

bool loses_friction(const cases::Ground& ground) { return ground.residual_friction_angle.has_value(); }

/// The narrowest band of a ground: where friction falls that under the weight of all ground.
SofteningBand narrowest_band(const cases::Ground& ground, const SofteningPlace& place) {
  const Real pressure = loses_friction(ground) ? place.pressure : 0;
  return softening_of(ground, place)->under(peak_strength(ground), pressure);
}

/// The band where nothing presses.
SofteningBand free_band(const cases::Ground& ground, const SofteningPlace& place) {
  return softening_of(ground, place)->under(peak_strength(ground), 0);
}

std::string key_of(std::size_t material, const char* key) { return fmt::format("materials.{}.{}", material, key); }

std::string warn_of_wide_band(const cases::CaseFile& file, std::size_t material, const SofteningPlace& place) {
  constexpr Real share_of_height = 0.25;
  const cases::Ground& ground = file.as<cases::MpsCase>().materials[material];
  SofteningBand band = narrowest_band(ground, place);
  if (band.drop == 0) return {};  // nothing is known of the pressure
  band.height = std::numeric_limits<Real>::infinity();
  const Real width = band.width();
  if (width <= share_of_height * place.height) return {};
  const Real narrower = share_of_height * place.height / width;  // the width goes by the spacing to 2/3
  return warning(file, key_of(material, "softening_displacement"),
                 fmt::format("a shear band of \"{}\" would be {} m wide, in ground {} m high: it has hardly room to soften",
                             ground.name, short_number(width, 3), short_number(place.height, 3)),
                 fmt::format("with a spacing of {} m it would be a quarter as wide as the ground is high",
                             short_number(place.spacing * narrower * std::sqrt(narrower), 2)));
}

std::string warn_of_narrow_band(const cases::CaseFile& file, std::size_t material, const SofteningPlace& place) {
  const cases::Ground& ground = file.as<cases::MpsCase>().materials[material];
  const SofteningBand band = narrowest_band(ground, place);
  const Real largest = band.largest_spacing();
  if (place.spacing <= largest) return {};
  // The largest spacing goes inversely by the drop, which grows in a line with the pressure.
  const Real free = free_band(ground, place).drop, most = band.drop * largest / place.spacing;
  return warning(file, key_of(material, "softening_displacement"),
                 fmt::format("below {} m of ground, bands of \"{}\" would be less than 6.3 spacings of {} m wide: its strength falls "
                             "over more slip than {} m there",
                             short_number(place.height * (most - free) / (band.drop - free), 2), ground.name,
                             short_number(place.spacing), short_number(band.displacement)),
                 fmt::format("a spacing of {} m would do to the bottom, or a softening_displacement of {} m", short_number(largest, 3),
                             short_number(band.displacement * place.spacing / largest, 3)));
}

}  // namespace

template <int D>
SofteningPlace softening_place(const cases::MpsCase& mps, const methods::mps::LinkTable<D>& links, const Filling<D>& filling,
                               std::span<const Index> material) {
  SofteningPlace place{methods::mps::square_of_reach<D>(links), filling.spacing, 0, 0};
  const auto level = [](const methods::mps::Site<D>& site) { return site[D - 1]; };
  const auto [low, high] = std::ranges::minmax_element(filling.sites, {}, level);
  if (low != filling.sites.end()) place.height = filling.spacing * (level(*high) - level(*low) + 1);
  std::map<methods::mps::Site<D>, Real> weights;  // of columns of particles
  for (std::size_t i = 0; i < filling.sites.size(); ++i) {
    methods::mps::Site<D> column = filling.sites[i];
    column[D - 1] = 0;
    const Real density = mps.materials[static_cast<std::size_t>(material[i])].density;
    place.pressure = std::max(place.pressure, weights[column] += density * mps.gravity.acceleration.norm() * filling.spacing);
  }
  return place;
}

laws::MohrCoulomb peak_strength(const cases::Ground& ground) {
  return laws::MohrCoulomb::make(ground.cohesion, ground.friction_angle * degree, ground.dilation_angle * degree,
                                 ground.tensile_strength);
}

std::optional<methods::mps::Softening> softening_of(const cases::Ground& ground, const SofteningPlace& place) {
  if (!ground.softens()) return {};
  const Real friction = ground.residual_friction_angle.value_or(ground.friction_angle) * degree,
             dilation = ground.residual_dilation_angle() * degree;
  return methods::mps::Softening{
      {ground.residual_cohesion.value_or(ground.cohesion), std::sin(friction), std::sin(dilation)},
      {.shear_modulus = ground.shear_modulus(),
       .displacement = ground.softening_displacement,
       .square_of_reach = place.square_of_reach,
       .spacing = place.spacing,
       .height = place.height}};
}

void check_softening(const cases::CaseFile& file, const SofteningPlace& place) {
  const auto& materials = file.as<cases::MpsCase>().materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!materials[i].softens()) continue;
    const SofteningBand band = free_band(materials[i], place);
    const Real largest = band.largest_spacing();
    const Real unresolved = 2 * std::numbers::pi * place.spacing * std::cbrt(largest / place.spacing);  // the width goes as its 2/3
    if (place.spacing > largest)
      refuse(file, key_of(i, "softening_displacement"),
             fmt::format("particles of {} m do not resolve the softening of \"{}\" over {} m: its band would be {} m wide, less than "
                         "6.3 spacings, and the strength would snap back",
                         short_number(place.spacing), materials[i].name, short_number(band.displacement),
                         short_number(unresolved, 3)),
             fmt::format("a spacing of {} m or less would do, or a softening_displacement of {} m or more", short_number(largest, 3),
                         short_number(band.displacement * place.spacing / largest, 3)));
    const Real strain = narrowest_band(materials[i], place).strain();
    if (materials[i].rupture_strain < strain)
      refuse(file, key_of(i, "rupture_strain"),
             fmt::format("\"{}\" breaks at a plastic shear strain of {}, before its strength has fallen, at {}", materials[i].name,
                         short_number(materials[i].rupture_strain, 3), short_number(strain, 3)),
             "give a larger rupture_strain; 1e9 where the ground shall not break");
  }
}

std::string warn_of_softening(const cases::CaseFile& file, const SofteningPlace& place) {
  const auto& materials = file.as<cases::MpsCase>().materials;
  std::string text;
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (materials[i].softens()) text += warn_of_wide_band(file, i, place) + warn_of_narrow_band(file, i, place);
  return text;
}

std::string softening_lines(const cases::MpsCase& mps, const SofteningPlace& place) {
  std::string text;
  const auto add = [&](const cases::Ground& ground, const SofteningBand& band, const std::string& where) {
    text += cases::line("softening", fmt::format("{}: to a plastic shear strain of {}, in a band {} m wide{}; spacing at most {} m",
                                                 ground.name, short_number(band.strain(), 3), short_number(band.width(), 3), where,
                                                 short_number(band.largest_spacing(), 3)));
  };
  for (const cases::Ground& ground : mps.materials) {
    if (!ground.softens()) continue;
    const SofteningBand free = free_band(ground, place);
    if (free.drop > 0) add(ground, free, loses_friction(ground) ? ", without pressure" : "");
    if (loses_friction(ground) && place.pressure > 0)
      add(ground, narrowest_band(ground, place),
          fmt::format(", under {} kPa, the weight of the highest ground", short_number(1e-3 * place.pressure, 3)));
  }
  return text;
}

template SofteningPlace softening_place<2>(const cases::MpsCase&, const methods::mps::LinkTable<2>&, const Filling<2>&,
                                           std::span<const Index>);
template SofteningPlace softening_place<3>(const cases::MpsCase&, const methods::mps::LinkTable<3>&, const Filling<3>&,
                                           std::span<const Index>);

}  // namespace sazare::runs
