#pragma once

/// What contacts, bonds, water and walls have taken and given, added up without rounding: the sums do not depend on the order of
/// the tiles, nor on who evaluates which of them. Those of parts of the spheres can be added, and are plain bytes.

#include "sazare/core/archive.hpp"
#include "sazare/core/exact_sum.hpp"
#include "sazare/methods/spheres/contact_table.hpp"

namespace sazare::methods::spheres {

struct WorkSums {
  // Since the start.
  ExactSum dashpot_work;  ///< see ContactSums, as the next three [J]
  ExactSum sliding_work;
  ExactSum bond_drag;
  ExactSum fracture;
  ExactSum wall_work;           ///< of moving walls, and of spheres that are driven [J]
  ExactSum twice_water_work;    ///< of water; that of the first evaluation once, since it acts for half a step [J]
  ExactSum twice_applied_work;  ///< of forces from outside; likewise [J]
  ExactSum carried_energy;      ///< see ContactSums [J]
  std::int64_t broken = 0;      ///< bonds
  // In the last evaluation at a base step.
  ExactSum elastic;           ///< held by contacts [J]
  ExactSum sliding;           ///< held by sliders [J]
  ExactSum bonds;             ///< held by bonds [J]
  ExactSum water_work_now;    ///< in that step, of which half is still to come [J]
  ExactSum applied_work_now;  ///< likewise [J]
  std::int64_t contacts = 0;

  /// Adds what a tile has taken in a step.
  void add(const ContactSums& tile) {
    dashpot_work += tile.dashpot_work;
    sliding_work += tile.sliding_work;
    bond_drag += tile.bond_drag;
    fracture += tile.fracture;
    wall_work += tile.wall_work;
    twice_water_work += 2 * tile.water_work;
    twice_applied_work += 2 * tile.applied_work;
    carried_energy += tile.carried_energy;
    broken += tile.broken;
  }

  /// Adds what a tile holds after the evaluation of a base step.
  void hold(const ContactSums& tile) {
    elastic += tile.elastic;
    sliding += tile.sliding;
    bonds += tile.bonds;
    water_work_now += tile.water_work;
    applied_work_now += tile.applied_work;
    contacts += tile.contacts;
  }

  /// Forgets the last evaluation at a base step, before the next one.
  void hold_nothing() {
    elastic = sliding = bonds = water_work_now = applied_work_now = {};
    contacts = 0;
  }

  /// The start is after the first evaluation. What sliders hold at the beginning is not lost.
  void begin(const ExactSum& carried) {
    dashpot_work = bond_drag = wall_work = {};
    twice_water_work = water_work_now;
    twice_applied_work = applied_work_now;
    sliding_work = sliding;
    carried_energy = carried;
  }

  WorkSums& operator+=(const WorkSums& more);
  void columns(Archive& archive);
};

}  // namespace sazare::methods::spheres
