#pragma once

/// Forces on spheres that come from outside of the engine, from Python say, and act until others are given.

#include <vector>

#include "sazare/methods/spheres/body_loads.hpp"
#include "sazare/methods/spheres/contact_table.hpp"

namespace sazare::methods::spheres {

class AppliedForces {
public:
  bool empty() const { return forces_.empty(); }
  /// By number of the sphere [N].
  void set(std::vector<Vector3> forces) { forces_ = std::move(forces); }
  Vector3 of(Index number) const { return forces_.empty() ? Vector3(Vector3::Zero()) : forces_[static_cast<std::size_t>(number)]; }

  ContactSums evaluate(const state::Spheres& spheres, const BodyLoadTask& task) const {
    ContactSums sums;
    for (std::size_t i = task.begin; i < task.end; ++i) {
      const Index number = spheres.number[i];
      if (!task.has(number)) continue;
      task.add(i, of(number));
      sums.applied_work += task.step * of(number).dot(spheres.place[i].velocity());
    }
    return sums;
  }

  void columns(Archive& archive) { archive("applied_forces", forces_); }

private:
  std::vector<Vector3> forces_;
};

}  // namespace sazare::methods::spheres
