#pragma once

/// Loads that act on each sphere for itself, tile by tile beside its contacts.

#include <cstdint>
#include <span>

#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// The spheres of a tile of a level.
struct BodyLoadTask {
  std::size_t begin = 0, end = 0;           ///< places of the spheres
  Real time = 0, step = 0;                  ///< [s]
  state::SphereLoad* own = nullptr;         ///< loads of these spheres
  std::span<const std::int8_t> level = {};  ///< by number of the sphere; empty where all have one
  std::size_t of_level = 0;                 ///< only spheres of this one

  bool has(Index number) const {
    return level.empty() || static_cast<std::size_t>(level[static_cast<std::size_t>(number)]) == of_level;
  }
  void add(std::size_t place, const Vector3& force) const {
    state::SphereLoad& load = own[place - begin];
    load.fx += force.x();
    load.fy += force.y();
    load.fz += force.z();
  }
};

}  // namespace sazare::methods::spheres
