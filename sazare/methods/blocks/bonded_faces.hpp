#pragma once

/// Bonded faces of blocks, whatever their law: which they are, what they remember, and which have come apart.

#include <array>
#include <span>
#include <vector>

#include "sazare/levels/terms/events.hpp"
#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::methods::blocks {

class BondedFaces : public terms::Term<3> {
public:
  std::string_view name() const override { return "joints"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  void post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override {
    strain_table_.gather(now, body, table_, sum);
  }
  terms::Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }
  void carry(Index joint, Parcel& parcel) override;
  void columns(Archive& archive) override;

  Index count() const { return static_cast<Index>(links_.size()); }
  const JointRecord& record(Index joint) const { return records_[static_cast<std::size_t>(joint)]; }
  /// As the joint was at the beginning.
  ElasticJoint elastic(Index joint) const {
    const ElasticJoint& kind = elastic_[static_cast<std::size_t>(record(joint).kind)];
    return own_springs_.empty() ? kind : kind.with(own_springs_[static_cast<std::size_t>(joint)]);
  }
  JointState state(Index joint) const { return record(joint).state; }
  /// Whether the law of a joint is one of natural joints.
  bool is_natural(Index joint) const { return elastic_[static_cast<std::size_t>(record(joint).kind)].is_natural; }
  /// On the second body as last evaluated, dashpots included [N].
  Vector3 force(Index joint) const { return table_[joint].total.linear; }

  /// Joint on a body's local face, or -1.
  Index joint_at(Index body, int face) const { return at_face_[static_cast<std::size_t>(body)][static_cast<std::size_t>(face)]; }

  /// Whether two bodies share a joint that holds.
  bool bonded(Index first, Index second) const;

  /// Whether some joint has a rate law.
  bool follow_rates() const { return by_rate_.is_used(); }

  /// By how much the rate of loading has raised the strength of a joint; that of one that has softened stays.
  Real strength_factor(Index joint) const { return by_rate_.factor(joint); }

  /// Joints that are cracks: broken, or sheared and pressed together.
  Index broken_count() const { return broken_count_; }

  /// Energies that a joint has dissipated and lost.
  const JointLosses& losses(Index joint) const { return losses_[static_cast<std::size_t>(joint)]; }

  /// Path of slip of the vertices of a joint; none where no law remembers it.
  std::span<const SlipPath> slip_paths() const { return paths_; }

  /// Stress of the vertices of a natural joint as last evaluated; 0 where no joint of the run is natural.
  FaceStress last_stress(Index joint) const {
    return stresses_.empty() ? FaceStress{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}
                             : stresses_[static_cast<std::size_t>(joint)];
  }

  /// Joints that came apart since the last call, in rising order.
  std::vector<Index> take_broken();

protected:
  /// `kinds` as they are at the beginning; `bodies` stand where the faces are given.
  BondedFaces(std::vector<ElasticJoint> kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
              std::vector<laws::DynamicIncrease> rate_laws, const state::Bodies<3>& bodies, bool some_remember_path);

  std::vector<JointRecord> records_;
  std::vector<MasterCorners> master_corners_;  ///< by joint; none where all bodies are rigid
  std::vector<JointLosses> losses_;
  std::vector<JointSprings> own_springs_;  ///< by joint, from the beginning on; empty where all faces have those of their kinds
  StrengthByRate by_rate_;                 ///< not used where no joint has a rate law
  std::vector<Link> links_;
  terms::SlotTable<3, 1, terms::FixedIncidence> table_;
  terms::StrainTable<2, 1> strain_table_;
  terms::Events failed_;         ///< joints, in the present step
  std::vector<SlipPath> paths_;  ///< by joint; empty where no law remembers slip
  std::vector<FaceStress> stresses_;  ///< by joint, as last evaluated; empty where none is natural
  terms::Events sheared_;        ///< joints without strength that are pressed together, after the present step

private:
  void note_sheared(terms::Peers& peers);
  void update_rates(Index body, const state::Bodies<3>& bodies);

  std::vector<ElasticJoint> elastic_;          ///< by kind
  std::vector<std::array<Index, 4>> at_face_;  ///< joint by body and local face
  std::vector<terms::Rates> rates_;
  std::vector<Index> broken_;  ///< not yet taken
  std::vector<std::int8_t> was_sheared_;  ///< by joint; empty where no law remembers slip
  Index broken_count_ = 0;
};

}  // namespace sazare::methods::blocks
