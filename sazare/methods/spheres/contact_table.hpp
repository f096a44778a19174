#pragma once

/// What every pair of materials is in contact.

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/laws/granular/contact_laws.hpp"

namespace sazare::methods::spheres {

/// What contacts remember beside a stretch of sliding.
struct Remembered {
  bool rolls = false;  ///< stretches of rolling and twisting
  bool bands = false;  ///< bands instead of the stretch of sliding
};

class ContactTable {
public:
  ContactTable(laws::ContactModel with, Index material_count)
      : model(with),
        materials(material_count),
        records_(static_cast<std::size_t>(material_count) * static_cast<std::size_t>(material_count)) {}

  void set(Index one, Index other, const laws::ContactConstants<Real>& constants) {
    for (const Index place : {one * materials + other, other * materials + one}) {
      records_[static_cast<std::size_t>(place)] = constants;
      rolls = rolls || constants.rolling > 0 || constants.twisting > 0;
    }
  }

  const laws::ContactConstants<Real>& of(Index one, Index other) const {
    return records_[static_cast<std::size_t>(one * materials + other)];
  }
  const Real* numbers(Index place) const { return &records_[static_cast<std::size_t>(place)].normal; }
  /// Constants of a material in contact with each material.
  std::span<const laws::ContactConstants<Real>> row(Index material) const {
    return std::span(records_).subspan(static_cast<std::size_t>(material * materials), static_cast<std::size_t>(materials));
  }

  /// Whether spheres that have touched may go on doing so across a gap.
  bool adheres() const {
    return laws::visit_law(model, []<class Law>(Law) { return Law::adheres; });
  }
  /// Whether friction slips band by band, so that contacts remember bands.
  bool slips_in_part() const {
    return laws::visit_law(model, []<class Law>(Law) { return Law::slips_in_part; });
  }
  /// What contacts remember.
  Remembered remembered() const { return {.rolls = rolls, .bands = slips_in_part()}; }
  /// The largest gap across which spheres of two materials that have touched go on doing so [m].
  Real neck(Index one, Index other, Real reduced_radius) const {
    return laws::visit_law(model, [&]<class Law>(Law) {
      if constexpr (Law::adheres)
        return Law::neck(of(one, other), reduced_radius);
      else
        return Real{0};
    });
  }
  /// The longest neck that any pair of materials has at this radius [m].
  Real longest_neck(Real reduced_radius) const {
    Real longest = 0;
    for (Index one = 0; one < materials; ++one)
      for (Index other = 0; other <= one; ++other) longest = std::max(longest, neck(one, other, reduced_radius));
    return longest;
  }
  /// Energy that is lost when spheres of two materials part [J].
  Real parting_loss(Index one, Index other, Real reduced_radius) const {
    return laws::visit_law(model, [&]<class Law>(Law) {
      if constexpr (Law::adheres)
        return Law::parting_loss(of(one, other), reduced_radius);
      else
        return Real{0};
    });
  }

  laws::ContactModel model;
  Index materials;
  bool rolls = false;  ///< some pair resists rolling or twisting

private:
  std::vector<laws::ContactConstants<Real>> records_;
};

/// What `visit(Law{}, rolls)` returns for a table, `rolls` being a type with a `value`.
template <class Visitor>
auto visit_law(const ContactTable& table, Visitor&& visit) {
  return laws::visit_law(table.model, [&](auto law) {
    return table.rolls ? visit(law, std::true_type{}) : visit(law, std::false_type{});
  });
}

/// What contacts and bonds hold and what they have taken, and the works of water and of forces from outside, summed over some of
/// them.
struct ContactSums {
  Real elastic = 0;       ///< energy in normal springs [J]
  Real sliding = 0;       ///< energy in the springs of sliders [J]
  Real dashpot_work = 0;  ///< taken by normal dashpots, and by contacts that were pulled apart, in this step [J]
  Real sliding_work = 0;  ///< work against sliders in this step, stored or lost [J]
  std::int64_t contacts = 0;
  Real bonds = 0;           ///< energy in bonds [J]
  Real bond_drag = 0;       ///< taken by the dashpots of bonds in this step [J]
  Real fracture = 0;        ///< taken by damage of bonds in this step [J]
  std::int64_t broken = 0;  ///< bonds that broke in this step
  Real water_work = 0;      ///< of water in this step, but for what is carried along [J]
  Real applied_work = 0;    ///< of forces from outside in this step [J]
  Real carried_energy = 0;  ///< kinetic energy of the water that is carried along since this step, and was not before [J]
  Real wall_work = 0;       ///< of walls in this step [J]

  ContactSums& operator+=(const ContactSums& more) {
    elastic += more.elastic;
    sliding += more.sliding;
    dashpot_work += more.dashpot_work;
    sliding_work += more.sliding_work;
    contacts += more.contacts;
    bonds += more.bonds;
    bond_drag += more.bond_drag;
    fracture += more.fracture;
    broken += more.broken;
    water_work += more.water_work;
    applied_work += more.applied_work;
    carried_energy += more.carried_energy;
    wall_work += more.wall_work;
    return *this;
  }
};

}  // namespace sazare::methods::spheres
