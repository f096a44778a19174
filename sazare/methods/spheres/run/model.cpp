#include "sazare/methods/spheres/run/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/bonding.hpp"
#include "sazare/methods/spheres/run/walls.hpp"
#include "sazare/methods/spheres/run/water.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

using cases::SpheresCase;
using methods::spheres::Wall;

constexpr Real wall_margin = 0.5;  // of the smallest diameter; near walls there are few spheres, so that more costs little

const cases::MaterialPair* find_pair(const SpheresCase& spheres, const std::string& one, const std::string& other) {
  for (const cases::MaterialPair& pair : spheres.pairs)
    if ((pair.between[0] == one && pair.between[1] == other) || (pair.between[0] == other && pair.between[1] == one))
      return &pair;
  return nullptr;
}

laws::ContactConstants<Real> constants_of(const SpheresCase& spheres, std::size_t one, std::size_t other) {
  const cases::GranularContact& contact = spheres.contact;
  const cases::SphereMaterial &a = spheres.materials[one], &b = spheres.materials[other];
  const cases::MaterialPair none, *found = find_pair(spheres, a.name, b.name);
  const cases::MaterialPair& pair = found == nullptr ? none : *found;
  const laws::MaterialsInContact materials{{a.youngs_modulus, a.poisson_ratio},
                                           {b.youngs_modulus, b.poisson_ratio},
                                           pair.restitution.value_or(contact.restitution),
                                           {pair.friction_coefficient.value_or(contact.friction_coefficient),
                                            pair.rolling_friction.value_or(contact.rolling_friction),
                                            pair.twisting_friction.value_or(contact.twisting_friction)}};
  return laws::visit_law(contact.model, [&]<class Law>(Law) {
    std::array<Real, laws::law_parameters.size()> values{};
    for (std::size_t n = 0; n < values.size(); ++n)
      values[n] = pair.law_parameters[n].value_or(contact.law_parameters[n].value_or(0));
    return Law::constants(materials, laws::own_parameters<laws::ContactLaws, Law>(values));
  });
}

std::uint64_t hash_of(const Placement& placement, const std::vector<Wall>& walls) {
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(placement.bonded)));
  hash.add(std::as_bytes(std::span(placement.spheres.place)));
  hash.add(std::as_bytes(std::span(placement.group)));
  for (const Wall& wall : walls) hash.add(std::as_bytes(std::span(wall.triangles)));
  return hash.value();
}

/// A base step of finer levels goes farther and costs less, so that searches weigh more: by the root of both the margin that is
/// best grows.
Real margin_growth(const SphereSteps& steps) {
  constexpr Real most = 4;
  return steps.level.empty() ? 1 : std::min(most, std::sqrt(steps.step / steps.smallest()));
}

}  // namespace

methods::spheres::ContactTable contact_table(const SpheresCase& spheres) {
  methods::spheres::ContactTable table(spheres.contact.model, static_cast<Index>(spheres.materials.size()));
  for (std::size_t a = 0; a < spheres.materials.size(); ++a)
    for (std::size_t b = a; b < spheres.materials.size(); ++b)
      table.set(static_cast<Index>(a), static_cast<Index>(b), constants_of(spheres, a, b));
  return table;
}

SpheresModel build_spheres(const cases::CaseFile& file, std::optional<Real> window) {
  const SpheresCase& spheres = file.as<cases::SpheresCase>();
  SpheresModel model;
  Placement placement = place_spheres(file);
  CaseWalls case_walls = make_walls(file, placement);
  std::vector<Wall>& walls = case_walls.walls;
  model.case_wall = std::move(case_walls.entry);
  model.wall_notes = std::move(case_walls.notes);
  const methods::spheres::ContactTable table = contact_table(spheres);
  methods::spheres::Bonds bonds = bond_spheres(file, placement);
  model.clumps = static_cast<std::int64_t>(placement.clumps.clumps.size());
  model.bonds = static_cast<std::int64_t>(bonds.bonds().size());
  model.steps = choose_steps(file, placement, {table, bonds}, window);
  model.start = hash_of(placement, walls);
  methods::spheres::WaterForces water = water_around(file, placement, model.steps.step);
  methods::spheres::BondedBodies bodies;
  if (placement.bonded_bodies > 0) {
    bodies = methods::spheres::BondedBodies(std::move(placement.bonded_body), bonds);
    for (const auto& place : placement.spheres.place) model.placed.push_back(place.centre());
    for (const cases::SphereMaterial& material : spheres.materials) model.density.push_back(material.density);
  }
  model.share_error = placement.share_error;
  model.shapes = std::move(placement.shapes);
  model.group = std::move(placement.group);
  model.body = std::move(placement.body);
  const Real margin = margin_growth(model.steps) * search_margin(spheres, placement.spheres);
  const methods::spheres::SphereRules rules{model.steps.step, spheres.gravity.acceleration, margin,
                                  wall_margin / spheres.contact.margin * margin, model.steps.level};
  model.stepper = std::make_unique<methods::spheres::SphereStepper>(std::move(placement.spheres), table, std::move(walls), rules,
                                                          std::move(bonds), std::move(placement.clumps), std::move(bodies));
  model.stepper->set_water(std::move(water));
  return model;
}

}  // namespace sazare::runs
