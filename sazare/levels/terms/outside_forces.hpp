#pragma once

/// Forces and moments on bodies from outside of the engine, from Python say.
///
/// They are given at base steps and act until others are given, at the steps of each body. Those given at a base step belong to
/// the kick at that step, which has been already by then: what they differ by from the ones before is kicked once more
/// (Simulation::add_to_kicks). So where all bodies have one level, a force that depends on positions is part of the leapfrog
/// step.

#include <span>
#include <vector>

#include "sazare/levels/terms/slot_table.hpp"

namespace sazare::terms {

class OutsideForces final : public Term<3> {
public:
  struct Load {
    Vector3 force = Vector3::Zero();   ///< at the centre of mass [N]
    Vector3 moment = Vector3::Zero();  ///< about it [N m]

    bool operator==(const Load&) const = default;
  };

  /// What the kick of a body lacks.
  struct Lacking {
    Index body = 0;
    Impulse<3> impulse;  ///< without a lead
  };

  /// Without forces at first.
  explicit OutsideForces(const state::Bodies<3>& bodies);

  std::string_view name() const override { return "outside_forces"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<Impulse<3>> sum,
              CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  Rates rates(Index) const override { return {}; }
  void add_energies(const Synchronized<3>& at_time, EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

  /// Takes over a load for every body, at a base step or before the first one. Returns what the kicks at `now`, which have had
  /// the loads before, lack of them.
  std::vector<Lacking> set(std::span<const Load> loads, const Instant& now, const state::Bodies<3>& bodies);

private:
  std::vector<Load> loads_;  ///< by body
  std::vector<Link> links_;
  SlotTable<3, 0, FixedIncidence> table_;
};

}  // namespace sazare::terms
