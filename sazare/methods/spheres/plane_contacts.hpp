#pragma once

/// Contacts of spheres with planes, in lanes. A plane touches a sphere in one point at most, so that nothing is sought or
/// matched: spheres that are near stand in a row, with what each remembers beside it.

#include <array>
#include <vector>

#include "sazare/core/vector_of.hpp"
#include "sazare/laws/granular_contact.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/wall.hpp"

namespace sazare::methods::spheres {

/// The spheres of a tile that are near a plane. Those that do not touch it remember nothing: zero in every bit. Where the law
/// adheres, the row remembers which of them touch it.
class PlaneRow {
public:
  /// As many spheres as there are lanes.
  struct Group {
    std::array<Index, lane_count> sphere{};  ///< beyond the last one: the same once more
    LaneVector sliding{};                    ///< [m]
  };
  struct Turning {
    LaneVector rolling{};  ///< [m]
    Lanes twisting{};      ///< [m]
  };

  std::size_t size() const { return size_; }
  Index operator[](std::size_t n) const { return groups_[n / lane_count].sphere[n % lane_count]; }

  /// A sphere beyond those that are there; it remembers nothing.
  void add(Index sphere, const Remembered& remembered, bool adheres = false);

  laws::ContactMemory<Real> memory(std::size_t n) const;
  /// Without stretch where there are none.
  laws::SlipBands<Real> bands(std::size_t n) const;
  bool remembers(std::size_t n) const;
  /// Tells a sphere what it remembers, if it is in the row.
  void remember(Index sphere, const laws::ContactMemory<Real>& memory, const laws::SlipBands<Real>& bands = {});

  std::size_t group_count() const { return groups_.size(); }
  Group& group(std::size_t n) { return groups_[n]; }
  Turning& turning(std::size_t n) { return turning_[n]; }
  laws::SlipBands<Lanes>& bands_of_group(std::size_t n) { return bands_[n]; }
  /// 1 for those that touch, else 0; there where the law adheres.
  Lanes& touching(std::size_t n) { return touching_[n]; }

private:
  std::size_t size_ = 0;
  std::vector<Group> groups_;
  std::vector<Turning> turning_;  ///< by group; empty where nothing resists rolling or twisting
  std::vector<laws::SlipBands<Lanes>> bands_;  ///< by group; empty where friction does not slip in part
  std::vector<Lanes> touching_;   ///< by group; empty where the law does not adhere
};

/// What the contacts of a row are evaluated with.
struct PlaneTask {
  const state::Spheres& spheres;
  const ContactTable& table;
  const Wall& wall;
  const WallPose& pose;
  Real step = 0;              ///< [s]
  state::SphereLoad* own;     ///< the loads of the tile's spheres
  std::size_t own_begin = 0;  ///< where the first of them stands
};

/// Adds the forces of a plane to the loads of the spheres in a row, and theirs to that of the plane.
ContactSums evaluate_plane(PlaneRow& row, const PlaneTask& task, WallLoad& on_plane);

}  // namespace sazare::methods::spheres
