#pragma once

/// Buoyancy, drag and inertia of water on spheres (laws/water/body_in_water.hpp), tile by tile beside their contacts.
///
/// The mass of the water that a sphere carries along is added to its own in the kick. A single sphere has it in its inverse mass,
/// and its weight, which the kick takes by that mass, is put right by the load; a clump adds up that of its spheres, and carries
/// it along with its centre.

#include <vector>

#include "sazare/laws/water/body_in_water.hpp"
#include "sazare/methods/spheres/body_loads.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

class WaterForces {
public:
  WaterForces() = default;
  /// By number of the sphere, with what each stands for of its body.
  WaterForces(laws::WaterField water, std::vector<laws::BodyInWater> bodies)
      : water_(std::move(water)),
        still_(laws::without_motion(water_)),
        bodies_(std::move(bodies)),
        added_mass_(bodies_.size(), 0) {}

  bool empty() const { return bodies_.empty(); }
  /// While they stand still, there are neither waves nor current.
  void stand_still(bool stands) { stands_ = stands; }
  const laws::WaterField& water() const { return water_; }
  /// No body of this density sinks or rises faster through still water than this, once its motion is steady [m/s].
  Real largest_steady_speed(Index number, Real density) const;
  /// What another rank has evaluated.
  void set_added_mass(Index number, Real mass) { added_mass_[static_cast<std::size_t>(number)] = mass; }
  /// Of what a sphere carries along, as last evaluated [kg].
  Real added_mass(Index number) const { return added_mass_[static_cast<std::size_t>(number)]; }

  /// Adds to the loads of spheres, and sets the inverse masses of those that move on their own. Their works are in the sums.
  ContactSums evaluate(state::Spheres& spheres, const BodyLoadTask& task);

  void columns(Archive& archive) { archive("added_mass", added_mass_); }

private:
  Real carry(state::Spheres& spheres, std::size_t place, Real added_mass);

  laws::WaterField water_, still_;
  bool stands_ = false;
  std::vector<laws::BodyInWater> bodies_;
  std::vector<Real> added_mass_;  ///< by number [kg]
};

}  // namespace sazare::methods::spheres
