#pragma once

/// What kernels of contacts share: forces in lanes that are added to loads, and the box in which they are found.

#include "sazare/core/lane_records.hpp"
#include "sazare/core/octets.hpp"
#include "sazare/core/triple.hpp"
#include "sazare/state/box_lanes.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

using state::BoxLanes;

/// Force and moment in lanes, turned into what loads are: a record for each lane.
class LoadRows {
public:
  LoadRows(const Triple<Lanes>& force, const Triple<Lanes>& moment) {
#ifdef __AVX512F__
    std::array<Lanes, 8> rows{force.x, force.y, force.z, Lanes{}, moment.x, moment.y, moment.z, Lanes{}};
    transpose(rows);
    for (std::size_t lane = 0; lane < lane_count; ++lane) rows_[lane] = Octet(rows[lane]);
#else
    std::array<Lanes, 4> forces{force.x, force.y, force.z, Lanes{}}, moments{moment.x, moment.y, moment.z, Lanes{}};
    transpose(forces);
    transpose(moments);
    for (std::size_t lane = 0; lane < lane_count; ++lane) rows_[lane] = Octet(forces[lane], moments[lane]);
#endif
  }

  const Octet& operator[](std::size_t lane) const { return rows_[lane]; }

  /// Adds a lane's force and moment.
  void add(std::size_t lane, state::SphereLoad* to) const { (Octet::load(&to->fx) + rows_[lane]).store(&to->fx); }

private:
  std::array<Octet, lane_count> rows_;
};

}  // namespace sazare::methods::spheres
