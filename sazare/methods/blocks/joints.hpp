#pragma once

/// Term of all bonded faces of blocks.

#include <array>
#include <span>
#include <vector>

#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/joint_kernel.hpp"
#include "sazare/methods/blocks/joint_rates.hpp"

namespace sazare::methods::blocks {

class Joints final : public terms::Term<3> {
public:
  /// `bodies` stand where the faces are given.
  Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies);
  /// With the rates that `joint_rates` has found.
  Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
         const state::Bodies<3>& bodies);

  std::string_view name() const override { return "joints"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override;
  void evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Moment& now, std::span<const Index> which, const state::Bodies<3>&, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  void settle(const Moment& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  terms::Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index joint, Parcel& parcel) override;
  void columns(Archive& archive) override;

  Index count() const { return static_cast<Index>(links_.size()); }
  const JointRecord& record(Index joint) const { return records_[static_cast<std::size_t>(joint)]; }
  const JointKind& kind(Index joint) const { return kinds_[static_cast<std::size_t>(record(joint).kind)]; }
  JointState state(Index joint) const { return record(joint).state; }

  /// Joint on a body's local face, or -1.
  Index joint_at(Index body, int face) const { return at_face_[static_cast<std::size_t>(body)][static_cast<std::size_t>(face)]; }

  /// Whether two bodies share a joint that holds.
  bool bonded(Index first, Index second) const;

  Index broken_count() const { return broken_count_; }

  /// Joints that came apart since the last call, in rising order.
  std::vector<Index> take_broken();

private:
  void ask_for_some(std::span<const Due> due, const state::Bodies<3>& bodies) const;
  void evaluate_lanes(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies);
  static void remember(const LanePointers<JointRecord>& records, const JointChange& change);
  void book(std::span<const Due> due, const JointChange& change);
  template <class Record>
  const JointParameters<Lanes>& kinds_of(const LanePointers<Record>& joints) const;
  void update_rates(Index body, const state::Bodies<3>& bodies);
  struct Sums;
  void add_energies(Index begin, Index end, const terms::Synchronized<3>& synchronized, Sums& sums) const;
  struct LaneEnergies {
    Lanes elastic, fracture, dashpots_after;
  };
  LaneEnergies energies(Index first, const terms::Synchronized<3>& synchronized) const;

  std::vector<JointKind> kinds_;
  std::vector<JointParameters<Lanes>> lane_kinds_;  ///< each kind in all lanes
  std::vector<JointRecord> records_;
  std::vector<JointLosses> losses_;
  std::vector<Link> links_;
  terms::SlotTable<3, 1, terms::FixedIncidence> table_;
  std::vector<std::array<Index, 4>> at_face_;  ///< joint by body and local face
  std::vector<terms::Rates> rates_;
  terms::Events failed_;       ///< joints, in the present step
  std::vector<Index> broken_;  ///< not yet taken
  Index broken_count_ = 0;
};

}  // namespace sazare::methods::blocks
