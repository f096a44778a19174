#pragma once

/// Gas of detonated charges on the walls of their holes.
///
/// The gas presses on a face as soon as the front has reached it, on the share of it that the front has passed. It follows its
/// face as a pressure does: the normal turns with the body, the area stays. What a face has swept is room for the gas, and the
/// work on it is taken from the energy of the gas, so that all work together cannot exceed what the explosive holds.
///
/// Faces stand at several time levels, and the gas meets all of them. Each tells, when it is evaluated, the room that it has
/// made, its rate, and the same of its work; between its own times both are continued by their rates. Sums are exact, so they
/// depend neither on the order of the faces nor on who evaluates them.

#include <array>
#include <vector>

#include "sazare/core/exact_sum.hpp"
#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/charges/charge.hpp"

namespace sazare::methods::blocks {

/// A face of the wall of a hole.
struct ChargedFace {
  Vector3 area;    ///< outward vector with the length of the area, in the body frame [m2]
  Vector3 centre;  ///< in the body frame [m]
  Vector3 start;   ///< place of the centre at the beginning [m]
  Index body = 0;
  Index charge = 0;
  AxialPart part;  ///< of the hole's axis that it stands along
};

/// A quantity that grows at a constant rate: constant + rate * time.
struct LinearGrowth {
  Real constant = 0;  ///< [its unit]
  Real rate = 0;      ///< [its unit per s]

  /// One that has a value at a time, and grows there so fast.
  static LinearGrowth through(Real time, Real value, Real rate) { return {value - rate * time, rate}; }
  Real at(Real time) const { return constant + rate * time; }
};

/// An exact sum of such quantities.
class GrowthSum {
public:
  void replace(const LinearGrowth& old, const LinearGrowth& now) {
    constant_ -= old.constant;
    constant_ += now.constant;
    rate_ -= old.rate;
    rate_ += now.rate;
  }
  LinearGrowth value() const { return {constant_.value(), rate_.value()}; }

private:
  ExactSum constant_, rate_;
};

class ChargeGas final : public terms::Term<3> {
public:
  ChargeGas(std::vector<Charge> charges, std::vector<ChargedFace> faces, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "charges"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<terms::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  void post_step(const Instant& now, const state::Bodies<3>&, terms::Peers& peers, terms::Changes&) override;
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override {
    strain_table_.gather(now, body, table_, sum);
  }
  terms::Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

  std::span<const Charge> charges() const { return charges_; }
  std::span<const ChargedFace> faces() const { return faces_; }

  /// What every charge has become by a time [s]. In a run of several processes all know it.
  std::vector<ChargeState> states(Real time) const;

  /// What of a charge is in cracks from now on.
  void set_taken(std::size_t charge, const TakenByCracks& taken) { taken_[charge] = taken; }

private:
  /// What a face remembers of its last evaluation.
  struct Wetted {
    Vector3 place = Vector3::Zero();  ///< of its centre [m]
    Vector3 area = Vector3::Zero();   ///< its vector, times the share that gas touches [m2]
    Real pressure = 0;                ///< [Pa]
    Real room = 0;                    ///< made so far [m3]
    Real work = 0;                    ///< taken so far [J]
    Real acts = 1;                    ///< 0 once it is cut off
  };
  /// What a face tells the gas.
  struct Told {
    LinearGrowth room, work;
  };
  /// On its way to other processes.
  struct ToldBy {
    Index face = 0;
    Told told;
  };
  /// Over the faces of a charge. Values are found anew where a face has told something: they take as long as many faces.
  struct Sums {
    GrowthSum exact_room, exact_work;
    LinearGrowth room, work;

    void find_values() {
      room = exact_room.value();
      work = exact_work.value();
    }
  };

  void find_rates(const state::Bodies<3>& bodies);
  Told move(const Due& due, const Instant& now, const state::Bodies<3>& bodies);
  void take(std::span<const ToldBy> news);
  void step_collars(Real time);
  ChargeState state(std::size_t charge, Real time) const;
  void sum_up();

  std::vector<Charge> charges_;
  std::vector<ChargedFace> faces_;
  std::vector<Link> links_;
  std::vector<terms::Rates> rates_;  ///< by body
  std::vector<ChargeState> now_;     ///< of the charges, at the last evaluation
  std::vector<Wetted> wetted_;
  std::vector<Told> told_;    ///< of the faces, as it is in the sums
  std::vector<ToldBy> news_;  ///< of the faces evaluated since the last step
  std::vector<Sums> sums_;
  std::vector<CollarState> collars_;  ///< of the charges
  std::vector<TakenByCracks> taken_;  ///< of the charges
  Real first_delay_ = 0;              ///< [s]
  terms::SlotTable<3, 0, terms::FixedIncidence> table_;
  terms::StrainTable<1, 0> strain_table_;
};

}  // namespace sazare::methods::blocks
