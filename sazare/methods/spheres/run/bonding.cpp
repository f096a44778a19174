#include "sazare/methods/spheres/run/bonding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

namespace {

using cases::BondRules;
using cases::short_number;
using methods::spheres::Bond;

constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr Real same_place = 1e-9;  // of a radius

laws::BondStiffness<Real> stiffness_of(const BondRules& rules, Real length, Real radius) {
  return rules.youngs_modulus ? laws::beam_stiffness(length, radius, *rules.youngs_modulus, *rules.poisson_ratio)
                              : laws::cement_stiffness(length, radius, *rules.normal_stiffness, *rules.shear_stiffness);
}

/// Dashpots as shares of those that are critical for two spheres and their bond alone.
laws::BondDamping<Real> damping_of(const BondRules& rules, const laws::BondStiffness<Real>& stiffness,
                                   const state::Spheres& spheres, const BondedPair& pair) {
  const auto one = static_cast<std::size_t>(pair.first), other = static_cast<std::size_t>(pair.second);
  const auto reduced = [](Real a, Real b) { return a * b / (a + b); };
  const Real mass = reduced(spheres.place[one].mass, spheres.place[other].mass),
             inertia = reduced(spheres.inertia(one), spheres.inertia(other));
  const Real twice = 2 * rules.damping_ratio, across = stiffness.shear / (stiffness.length * stiffness.length);
  return {twice * std::sqrt(stiffness.stretch * mass), twice * std::sqrt(across * mass),
          twice * std::sqrt(stiffness.bend * inertia)};
}

/// The use of its strength at which a bond of this length is broken; kinds differ by it.
Real ultimate_of(const cases::CaseFile& file, std::size_t entry, Real length) {
  const BondRules& rules = file.as<cases::SpheresCase>().bonds[entry];
  if (!rules.fracture_energy) return 1;
  const Real stiffness = rules.youngs_modulus ? *rules.youngs_modulus / length : *rules.normal_stiffness;
  const Real ultimate = laws::ultimate_use(*rules.tensile_strength, stiffness, *rules.fracture_energy);
  if (ultimate < 1)
    refuse(file, fmt::format("bonds.{}.fracture_energy", entry),
           fmt::format("fracture_energy {} N/m is less than a bond of length {} m holds when it begins to fail",
                       short_number(*rules.fracture_energy), short_number(length, 4)),
           fmt::format("give {} N/m or more, or none for a brittle bond",
                       short_number(*rules.fracture_energy / ultimate * 1.0005, 4)));
  return ultimate;
}

class Bonder {
public:
  Bonder(const cases::CaseFile& file, const Placement& placement)
      : file_(file), placement_(placement), rules_(file.as<cases::SpheresCase>().bonds) {}

  methods::spheres::Bonds bond() {
    counts_.resize(rules_.size(), 0);
    for (const BondedPair& pair : placement_.bonded) add(pair);
    for (std::size_t entry = 0; entry < rules_.size(); ++entry)
      if (counts_[entry] == 0)
        refuse(file_, fmt::format("bonds.{}", entry), fmt::format("the bonds \"{}\" join no spheres", rules_[entry].name),
               rules_[entry].between[0].empty()
                   ? "no group is of a shape that names them"
                   : "the gaps at the start are larger than reach allows, or an entry below holds for the same spheres");
    return {std::move(bonds_), std::move(kinds_)};
  }

private:
  void add(const BondedPair& pair) {
    const BondRules& rules = rules_[static_cast<std::size_t>(pair.entry)];
    const auto &one = placement_.spheres.place[static_cast<std::size_t>(pair.first)],
               &other = placement_.spheres.place[static_cast<std::size_t>(pair.second)];
    const Vector3 apart = placement_.spheres.box.nearest(other.centre() - one.centre());
    if (!(apart.norm() > same_place * std::min(one.radius, other.radius)))
      refuse(file_, fmt::format("bonds.{}", pair.entry),
             fmt::format("two spheres stand at one place, ({}, {}, {}), where no bond can join them", short_number(one.x, 4),
                         short_number(one.y, 4), short_number(one.z, 4)),
             "a bond needs a direction: look for a row that stands twice in a file, or for groups that lie in each other");
    Bond bond;
    bond.first = pair.first;
    bond.second = pair.second;
    bond.radius = rules.radius_ratio * std::min(one.radius, other.radius);
    bond.stiffness = stiffness_of(rules, apart.norm(), bond.radius);
    bond.damping = damping_of(rules, bond.stiffness, placement_.spheres, pair);
    bond.direction = apart.normalized();
    bond.kind = kind_of(rules, ultimate_of(file_, static_cast<std::size_t>(pair.entry), apart.norm()));
    bonds_.push_back(bond);
    ++counts_[static_cast<std::size_t>(pair.entry)];
  }

  Index kind_of(const BondRules& rules, Real ultimate) {
    const laws::BondStrength<Real> strength{rules.tensile_strength.value_or(infinite), rules.cohesion.value_or(infinite),
                                            std::tan(rules.friction_angle * std::numbers::pi / 180), ultimate};
    const auto same = [&](const laws::BondStrength<Real>& kind) {
      return kind.tensile == strength.tensile && kind.cohesion == strength.cohesion && kind.friction == strength.friction &&
             kind.ultimate == strength.ultimate;
    };
    // Neighbours on a lattice have the same kind; bonds of a random packing have each their own.
    if (!kinds_.empty() && same(kinds_.back())) return static_cast<Index>(kinds_.size() - 1);
    kinds_.push_back(strength);
    return static_cast<Index>(kinds_.size() - 1);
  }

  const cases::CaseFile& file_;
  const Placement& placement_;
  const std::vector<BondRules>& rules_;
  std::vector<Bond> bonds_;
  std::vector<laws::BondStrength<Real>> kinds_;
  std::vector<std::int64_t> counts_;
};

}  // namespace

methods::spheres::Bonds bond_spheres(const cases::CaseFile& file, const Placement& placement) {
  return Bonder(file, placement).bond();
}

}  // namespace sazare::runs
