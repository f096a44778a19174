#pragma once

/// Term of all bonded faces of blocks.

#include "sazare/methods/blocks/bonded_faces.hpp"

namespace sazare::methods::blocks {

struct FaceGeometry;
struct JointChange;

/// Joints of the laws of a list. The kernel is made for each law; where the joints of a run have more than one, those of each are
/// evaluated by themselves. What a lane computes does not depend on who else is in the vector, so the forces are the same.
template <class Laws>
class JointsOf final : public BondedFaces {
public:
  using Kind = typename JointKinds<Laws>::Kind;

  /// `bodies` stand where the faces are given.
  JointsOf(const std::vector<Kind>& kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies)
      : JointsOf(kinds, faces, joint_rates(elastic_joints(kinds), faces, bodies), bodies) {}
  /// With the rates that `joint_rates` has found, and the rate laws that faces name.
  JointsOf(const std::vector<Kind>& kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
           const state::Bodies<3>& bodies, std::vector<laws::DynamicIncrease> rate_laws = {});

  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;

private:
  struct LaneEnergies {
    Lanes elastic, fracture, dashpots_after;
  };

  std::vector<Due> those_of(std::size_t law, std::span<const Due> due) const;
  void ask_for_some(std::span<const Due> due, const state::Bodies<3>& bodies) const;
  template <class Law>
  void evaluate_lanes(const KindsOfLaw<Law>& kinds, const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies);
  template <class Law>
  void evaluate_strained(const KindsOfLaw<Law>& kinds, const Instant& now, std::span<const Due> due,
                         const state::Bodies<3>& bodies);
  template <class Law>
  void note_changes(const LanePointers<JointRecord>& records, std::span<const Due> due, const JointChange& change);
  template <class Law, class Record, class JointOfLane>
  const JointParameters<Law, Lanes>& parameters(const KindsOfLaw<Law>& kinds, const LanePointers<Record>& records,
                                                const JointOfLane& joint_of) const;
  template <class Law, class JointOfLane>
  const JointParameters<Law, Lanes>& present_parameters(const KindsOfLaw<Law>& kinds, const Instant& now,
                                                        std::span<const Due> due, const LanePointers<JointRecord>& records,
                                                        const JointOfLane& joint_of, FaceGeometry& at_face);
  template <class Law>
  void take_rates(const JointParameters<Law, Lanes>& of_case, const Instant& now, std::span<const Due> due,
                  const FaceGeometry& at_face);
  template <class Law, class Record, class JointOfLane>
  const JointParameters<Law, Lanes>& strengthened(const JointParameters<Law, Lanes>& of_case, const LanePointers<Record>& records,
                                                  const JointOfLane& joint_of, FaceGeometry& at_face) const;
  static void remember(const LanePointers<JointRecord>& records, const JointChange& change);
  void add_work(std::span<const Due> due, const JointChange& change);
  template <class JointOfLane>
  LaneVector load_paths(const JointOfLane& joint_of) const;
  template <class JointOfLane>
  std::array<LaneVector, vertex_count> load_stresses(const JointOfLane& joint_of) const;
  void note_stresses(std::span<const Due> due, const FaceGeometry& at_face);
  void follow_slip(std::span<const Due> due, const JointChange& change);
  LaneBits lanes_of(std::size_t law, Index begin, Index end) const;
  void add_energies(Index begin, Index end, const terms::Synchronized<3>& synchronized, terms::EnergySums& energies) const;
  template <class Law>
  LaneEnergies energies(const KindsOfLaw<Law>& kinds, Index first, const terms::Synchronized<3>& synchronized) const;

  JointKinds<Laws> kinds_;
};

using Joints = JointsOf<laws::JointLaws>;
extern template class JointsOf<laws::JointLaws>;

}  // namespace sazare::methods::blocks
