#pragma once

/// What every pair of materials is in contact.

#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/laws/granular_contact.hpp"

namespace sazare::methods::spheres {

class ContactTable {
public:
  ContactTable(laws::ContactModel with, Index material_count)
      : model(with),
        materials(material_count),
        records_(static_cast<std::size_t>(material_count) * static_cast<std::size_t>(material_count)) {}

  void set(Index one, Index other, const laws::ContactConstants<Real>& constants) {
    for (const Index place : {one * materials + other, other * materials + one}) {
      records_[static_cast<std::size_t>(place)] = {constants, 0};
      rolls = rolls || constants.rolling > 0 || constants.twisting > 0;
    }
  }

  const laws::ContactConstants<Real>& of(Index one, Index other) const {
    return records_[static_cast<std::size_t>(one * materials + other)].constants;
  }
  const Real* numbers(Index place) const { return &records_[static_cast<std::size_t>(place)].constants.normal; }

  laws::ContactModel model;
  Index materials;
  bool rolls = false;  ///< some pair resists rolling or twisting

private:
  /// As eight doubles, which lanes read at once.
  struct alignas(64) Record {
    laws::ContactConstants<Real> constants;
    Real unused;
  };
  std::vector<Record> records_;
};

/// What contacts and bonds hold and what they have taken, summed over some of them.
struct ContactSums {
  Real elastic = 0;       ///< energy in normal springs [J]
  Real sliding = 0;       ///< energy in the springs of sliders [J]
  Real dashpot_work = 0;  ///< taken by normal dashpots in this step [J]
  Real sliding_work = 0;  ///< work against sliders in this step, stored or lost [J]
  std::int64_t contacts = 0;
  Real bonds = 0;           ///< energy in bonds [J]
  Real bond_drag = 0;       ///< taken by the dashpots of bonds in this step [J]
  Real fracture = 0;        ///< taken by damage of bonds in this step [J]
  std::int64_t broken = 0;  ///< bonds that broke in this step

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
    return *this;
  }
};

}  // namespace sazare::methods::spheres
