#pragma once

/// What kernels of contacts share: forces in lanes that are added to loads, and the box in which they are found.

#include "sazare/core/lane_records.hpp"
#include "sazare/state/box_lanes.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

using state::BoxLanes;

/// Force and moment in lanes, turned into what loads are: a record for each lane.
class LoadRows {
public:
  LoadRows(const LaneVector& force, const LaneVector& moment)
      : rows_(octets_of({force[0], force[1], force[2], Lanes{}, moment[0], moment[1], moment[2], Lanes{}})) {}

  const Octet& operator[](std::size_t lane) const { return rows_[lane]; }

  /// Adds a lane's force and moment.
  void add(std::size_t lane, state::SphereLoad* to) const { (Octet::load(&to->fx) + rows_[lane]).store(&to->fx); }

private:
  std::array<Octet, lane_count> rows_;
};

}  // namespace sazare::methods::spheres
