#pragma once

/// What joints do with their laws, lane by lane: included where `JointsOf` is made for a list of laws, and nowhere else.

#include <algorithm>
#include <bit>
#include <utility>

#include "sazare/core/large_tables.hpp"
#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/methods/blocks/deformation/joint_strains.hpp"
#include "sazare/methods/blocks/joints.hpp"
#include "sazare/parallel/sum_over_ranges.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace joint_loops {

inline constexpr std::size_t serial_below = 1024;  // a joint takes some 35 ns, waking a thread some microseconds
inline constexpr std::size_t batches_ahead = 4;    // memory answers after some 150 ns, a batch takes as long

}  // namespace joint_loops

template <class Laws>
JointsOf<Laws>::JointsOf(const std::vector<Kind>& kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
                         const state::Bodies<3>& bodies, std::vector<laws::DynamicIncrease> rate_laws)
    : BondedFaces(elastic_joints(kinds), faces, std::move(rates), std::move(rate_laws), bodies, some_remember_path(kinds)),
      kinds_(kinds) {
  for (const JointFace& face : faces) kinds_.use(face.kind);
}

template <class Laws>
void JointsOf<Laws>::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  kinds_.visit_laws([&](const auto& kinds, std::size_t law) {
    std::vector<Due> some;
    if (!kinds_.has_one_law()) some = those_of(law, due);
    const std::span<const Due> own = kinds_.has_one_law() ? due : some;
    parallel::parallel_for_uneven(own.size(), joint_loops::serial_below, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i += lane_count) {
        if (is_large(records_)) ask_for_some(own.subspan(i, end - i), bodies);
        const auto batch = own.subspan(i, std::min<std::size_t>(lane_count, end - i));
        if (bodies.strain.empty())
          evaluate_lanes(kinds, now, batch, bodies);
        else
          evaluate_strained(kinds, now, batch, bodies);
      }
    });
  });
}

template <class Laws>
std::vector<Due> JointsOf<Laws>::those_of(std::size_t law, std::span<const Due> due) const {
  std::vector<Due> own;
  std::ranges::copy_if(due, std::back_inserter(own), [&](const Due& of) { return kinds_.law_of(record(of.link).kind) == law; });
  return own;
}

/// Asks for what as many joints as there are lanes will need, some batches later.
template <class Laws>
void JointsOf<Laws>::ask_for_some(std::span<const Due> due, const state::Bodies<3>& bodies) const {
  constexpr std::size_t begin = joint_loops::batches_ahead * lane_count, end = begin + lane_count;
  for (std::size_t n = begin; n < std::min(end, due.size()); ++n) {
    const Index joint = due[n].link;
    ask_for(records_[at(joint)]);
    ask_for(table_[joint]);
    for (const Index body : {links_[at(joint)].first, links_[at(joint)].second})
      ask_for(bodies.motion[at(body)], state::bytes_for_forces<3>);
  }
}

/// Evaluates as many joints as there are lanes, or fewer: idle lanes repeat the first.
template <class Laws>
template <class Law>
[[gnu::flatten]] void JointsOf<Laws>::evaluate_lanes(const KindsOfLaw<Law>& kinds, const Instant& now, std::span<const Due> due,
                                                     const state::Bodies<3>& bodies) {
  const terms::LaneDue in_lanes = terms::in_lanes(due);
  LanePointers<JointRecord> records;
  LanePointers<const state::Motion<3>> masters, slaves;
  LanePointers<terms::Slot<3, 1>> slots;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    records[lane] = &records_[at(in_lanes[lane].link)];
    masters[lane] = &bodies.motion[at(records[lane]->master)];
    slaves[lane] = &bodies.motion[at(records[lane]->slave)];
    slots[lane] = &table_[in_lanes[lane].link];
  }
  JointChange change;
  LaneMask failed;
  const auto joint_of = [&](std::size_t lane) { return in_lanes[lane].link; };
  FaceGeometry at_face = face_geometry(LaneJoints<JointRecord>{records}, masters, slaves);
  if constexpr (laws::RemembersPath<Law>) at_face.path = load_paths(joint_of);
  if constexpr (laws::DilatesBySlip<Law>) at_face.stress = load_stresses(joint_of);
  const auto& kind = present_parameters(kinds, now, due, records, joint_of, at_face);
  const JointForce force = blocks::evaluate(at_face, kind, masters, slaves, bodies.pole, failed, change);
  terms::write(slots, now, in_lanes, force.total, force.dashpots, failed);
  if constexpr (laws::DilatesBySlip<Law>) note_stresses(due, at_face);
  if (change.has_happened) note_changes<Law>(records, due, change);
}

/// The same where elements are strained.
template <class Laws>
template <class Law>
[[gnu::flatten]] void JointsOf<Laws>::evaluate_strained(const KindsOfLaw<Law>& kinds, const Instant& now,
                                                        std::span<const Due> due, const state::Bodies<3>& bodies) {
  const terms::LaneDue in_lanes = terms::in_lanes(due);
  LanePointers<JointRecord> records;
  LanePointers<const MasterCorners> corners;
  LanePointers<const state::Motion<3>> masters, slaves;
  LanePointers<const state::Strain> master_strains, slave_strains;
  LanePointers<terms::Slot<3, 1>> slots;
  LanePointers<terms::StrainForces<2, 1>> strain_slots;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    records[lane] = &records_[at(in_lanes[lane].link)];
    masters[lane] = &bodies.motion[at(records[lane]->master)];
    slaves[lane] = &bodies.motion[at(records[lane]->slave)];
    corners[lane] = &master_corners_[at(in_lanes[lane].link)];
    master_strains[lane] = &bodies.strain[at(records[lane]->master)];
    slave_strains[lane] = &bodies.strain[at(records[lane]->slave)];
    slots[lane] = &table_[in_lanes[lane].link];
    strain_slots[lane] = &strain_table_[in_lanes[lane].link];
  }
  JointChange change;
  LaneMask failed;
  const auto joint_of = [&](std::size_t lane) { return in_lanes[lane].link; };
  const LaneJoints<JointRecord> joints{records};
  FaceGeometry at_face = face_geometry(joints, masters, slaves);
  const StrainedFace strained = strain_face(joints, corners, load_strain(master_strains), load_strain(slave_strains), at_face);
  if constexpr (laws::RemembersPath<Law>) at_face.path = load_paths(joint_of);
  if constexpr (laws::DilatesBySlip<Law>) at_face.stress = load_stresses(joint_of);
  const auto& kind = present_parameters(kinds, now, due, records, joint_of, at_face);
  const StrainedJointForce found =
      blocks::evaluate_strained(at_face, strained, kind, masters, slaves, bodies.pole, failed, change);
  terms::write(strain_slots, slots, side_by_side(found.total), side_by_side(found.dashpots), failed);
  terms::write(slots, now, in_lanes, found.force.total, found.force.dashpots, failed);
  if constexpr (laws::DilatesBySlip<Law>) note_stresses(due, at_face);
  if (change.has_happened) note_changes<Law>(records, due, change);
}

/// Enters what an evaluation has changed of its joints.
template <class Laws>
template <class Law>
void JointsOf<Laws>::note_changes(const LanePointers<JointRecord>& records, std::span<const Due> due, const JointChange& change) {
  remember(records, change);
  if constexpr (laws::RemembersPath<Law>) follow_slip(due, change);
  add_work(due, change);
}

/// Parameters of each lane, until the next call in this thread; `joint_of` names the joints by lane.
template <class Laws>
template <class Law, class Record, class JointOfLane>
const JointParameters<Law, Lanes>& JointsOf<Laws>::parameters(const KindsOfLaw<Law>& kinds, const LanePointers<Record>& records,
                                                              const JointOfLane& joint_of) const {
  if (own_springs_.empty()) return kinds.of(records);
  thread_local JointParameters<Law, Lanes> of_faces;
  of_faces = kinds.of(records);
  set_springs(of_faces, [&](std::size_t lane) -> const JointSprings& { return own_springs_[at(joint_of(lane))]; });
  return of_faces;
}

/// Parameters of each lane at this evaluation: where joints have rate laws, with the strength of their rate.
template <class Laws>
template <class Law, class JointOfLane>
const JointParameters<Law, Lanes>& JointsOf<Laws>::present_parameters(const KindsOfLaw<Law>& kinds, const Instant& now,
                                                                      std::span<const Due> due,
                                                                      const LanePointers<JointRecord>& records,
                                                                      const JointOfLane& joint_of, FaceGeometry& at_face) {
  const JointParameters<Law, Lanes>& of_case = parameters(kinds, records, joint_of);
  if (!by_rate_.is_used()) return of_case;
  take_rates(of_case, now, due, at_face);
  return strengthened(of_case, records, joint_of, at_face);
}

/// Lets the joints that are intact have the strength of the rate at which they are loaded.
template <class Laws>
template <class Law>
void JointsOf<Laws>::take_rates(const JointParameters<Law, Lanes>& of_case, const Instant& now, std::span<const Due> due,
                                const FaceGeometry& at_face) {
  for (std::size_t n = 0; n < due.size(); ++n) {
    const Index joint = due[n].link;
    if (!by_rate_.has(joint) || state(joint) != JointState::intact) continue;
    const auto lane = static_cast<int>(n);
    const Real opening = std::max({at_face.opening[0][lane], at_face.opening[1][lane], at_face.opening[2][lane]});
    by_rate_.follow(joint, now.seconds(), opening, elastic_peak(of_case.tension)[lane], failure_peak(of_case.tension)[lane]);
  }
}

/// Parameters with the strength of the rate of loading, until the next call in this thread. What an intact joint remembers begins
/// with the opening at which that strength is reached.
template <class Laws>
template <class Law, class Record, class JointOfLane>
const JointParameters<Law, Lanes>& JointsOf<Laws>::strengthened(const JointParameters<Law, Lanes>& of_case,
                                                                const LanePointers<Record>& records, const JointOfLane& joint_of,
                                                                FaceGeometry& at_face) const {
  thread_local JointParameters<Law, Lanes> of_rate;
  of_rate = of_case;
  Lanes factor, of_length;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    factor[static_cast<int>(lane)] = by_rate_.factor(joint_of(lane));
    of_length[static_cast<int>(lane)] = by_rate_.length_factor(joint_of(lane));
  }
  scale_strength(of_rate.tension, factor, of_length);
  scale_strength(of_rate.shear, factor, of_length);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (records[lane]->state != JointState::intact) continue;
    const auto i = static_cast<int>(lane);
    for (int v = 0; v < vertex_count; ++v) at_face.peak[v][i] = elastic_peak(of_rate.tension)[i];
  }
  return of_rate;
}

/// Paths of slip of the joints that `joint_of` names by lane.
template <class Laws>
template <class JointOfLane>
LaneVector JointsOf<Laws>::load_paths(const JointOfLane& joint_of) const {
  LaneVector path;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (std::size_t v = 0; v < vertex_count; ++v)
      path[static_cast<int>(v)][static_cast<int>(lane)] = paths_[at(joint_of(lane))][v];
  return path;
}

/// Stresses that the vertices of the joints bore when they were last evaluated.
template <class Laws>
template <class JointOfLane>
std::array<LaneVector, vertex_count> JointsOf<Laws>::load_stresses(const JointOfLane& joint_of) const {
  std::array<LaneVector, vertex_count> stress;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (std::size_t v = 0; v < vertex_count; ++v)
      for (int axis = 0; axis < 3; ++axis) stress[v][axis][static_cast<int>(lane)] = stresses_[at(joint_of(lane))][v][axis];
  return stress;
}

template <class Laws>
void JointsOf<Laws>::note_stresses(std::span<const Due> due, const FaceGeometry& at_face) {
  for (std::size_t n = 0; n < due.size(); ++n)
    for (std::size_t v = 0; v < vertex_count; ++v)
      for (int axis = 0; axis < 3; ++axis) stresses_[at(due[n].link)][v][axis] = at_face.stress[v][axis][static_cast<int>(n)];
}

/// What a law that remembers the path of slip has besides: paths of slip, fracture energies, and joints that have lost their
/// strength.
template <class Laws>
void JointsOf<Laws>::follow_slip(std::span<const Due> due, const JointChange& change) {
  for (std::size_t n = 0; n < due.size(); ++n) {
    const int lane = static_cast<int>(n);
    const Index joint = due[n].link;
    for (std::size_t v = 0; v < vertex_count; ++v) paths_[at(joint)][v] = change.path[static_cast<int>(v)][lane];
    losses_[at(joint)].opening += change.opening_fracture[lane];
    losses_[at(joint)].shear += change.shear_fracture[lane];
    if (change.sheared[lane] != 0) sheared_.add(joint);
  }
}

/// What joints remember of slip and opening: in lanes, for nobody guesses which of them have slipped. Those that have not keep
/// their bits, whoever else has: to add 0 would change the sign of a 0.
template <class Laws>
void JointsOf<Laws>::remember(const LanePointers<JointRecord>& records, const JointChange& change) {
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::size_t begin = JointRecord::vertex_begin(v);
    auto numbers = load_quad(records, begin);
    for (std::size_t axis = 0; axis < 2; ++axis)
      numbers[axis + 1] = select(change.slipped, numbers[axis + 1] + change.slip[v][axis], numbers[axis + 1]);
    numbers[3] = select(change.softened, change.peak[static_cast<int>(v)], numbers[3]);
    store_quad(numbers, records, begin);
  }
}

/// What changes of joints have cost, and which of them soften or fail.
template <class Laws>
void JointsOf<Laws>::add_work(std::span<const Due> due, const JointChange& change) {
  for (std::size_t lane = 0; lane < due.size(); ++lane)
    losses_[at(due[lane].link)].slip_work += change.slip_work[static_cast<int>(lane)];
  if (!any(change.softened)) return;
  for (std::size_t lane = 0; lane < due.size(); ++lane) {
    const int i = static_cast<int>(lane);
    if (change.softened[i] == 0) continue;
    const bool failed = change.failed[i] != 0;
    JointState& state = records_[at(due[lane].link)].state;
    if (failed)
      state = JointState::broken;
    else if (state != JointState::sheared)
      state = JointState::softening;
    if (!failed) continue;
    losses_[at(due[lane].link)].released = change.released[i];
    failed_.add(due[lane].link);
  }
}

/// Energies of as many joints as there are lanes: elastic in the places of a base step, what fracture has taken, and work of
/// the dashpots after it [J]. Lanes beyond the last joint repeat it; what lanes of another law have means nothing.
template <class Laws>
template <class Law>
[[gnu::flatten]] typename JointsOf<Laws>::LaneEnergies JointsOf<Laws>::energies(
    const KindsOfLaw<Law>& kinds, Index first, const terms::Synchronized<3>& synchronized) const {
  LanePointers<const JointRecord> records;
  LanePointers<const terms::Slot<3, 1>> slots;
  LanePointers<const state::Pose<3>> masters, slaves;
  LanePointers<const state::MeanMotion<3>> master_ahead, slave_ahead;
  const auto joint_of = [&](std::size_t lane) { return std::min(first + static_cast<Index>(lane), count() - 1); };
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Index joint = joint_of(lane);
    records[lane] = &records_[at(joint)];
    slots[lane] = &table_[joint];
    masters[lane] = &synchronized.pose_of(records[lane]->master);
    slaves[lane] = &synchronized.pose_of(records[lane]->slave);
    master_ahead[lane] = &synchronized.ahead[at(records[lane]->master)];
    slave_ahead[lane] = &synchronized.ahead[at(records[lane]->slave)];
  }
  const auto& of_case = parameters(kinds, records, joint_of);
  const LaneJoints<const JointRecord> joints{records};
  FaceGeometry at_face = face_geometry(joints, masters, slaves);
  Lanes dashpots_after = terms::work_after(slots, master_ahead, slave_ahead);
  if (!synchronized.strain.empty()) {
    LanePointers<const state::StrainNow> master_strains, slave_strains;
    LanePointers<const MasterCorners> corners;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      corners[lane] = &master_corners_[at(joint_of(lane))];
      master_strains[lane] = &synchronized.strain[at(records[lane]->master)];
      slave_strains[lane] = &synchronized.strain[at(records[lane]->slave)];
      dashpots_after[static_cast<int>(lane)] +=
          strain_table_.work_after(joint_of(lane), links_[at(joint_of(lane))], table_, synchronized.strain)[0];
    }
    strain_face(joints, corners, load_strain(master_strains), load_strain(slave_strains), at_face);
  }
  const auto& kind = by_rate_.is_used() ? strengthened(of_case, records, joint_of, at_face) : of_case;
  Lanes fracture{};  // a law that softens by slip has it among its losses, and a natural joint none
  if constexpr (laws::RemembersPath<Law>)
    at_face.path = load_paths(joint_of);
  else if (some_soften(kind, at_face))
    fracture = fracture_work(kind, at_face);
  return {elastic_energy(kind, at_face, tension_stress(kind, at_face)), fracture, dashpots_after};
}

template <class Laws>
void JointsOf<Laws>::add_energies(const terms::Synchronized<3>& synchronized, terms::EnergySums& energies) const {
  const auto add_range = [&](std::size_t begin, std::size_t end, terms::EnergySums& own) {
    for (auto first = static_cast<Index>(begin); at(first) < end; first += lane_count)
      add_energies(first, std::min(first + lane_count, static_cast<Index>(end)), synchronized, own);
  };
  parallel::sum_over_ranges(links_.size(), joint_loops::serial_below, energies, add_range);
}

/// Which of as many joints as there are lanes have a law.
template <class Laws>
LaneBits JointsOf<Laws>::lanes_of(std::size_t law, Index begin, Index end) const {
  LaneBits own = 0;
  for (Index joint = begin; joint < end; ++joint)
    if (kinds_.law_of(record(joint).kind) == law) own |= static_cast<LaneBits>(1U << (joint - begin));
  return own;
}

/// Adds the energies of as many joints as there are lanes at most.
template <class Laws>
void JointsOf<Laws>::add_energies(Index begin, Index end, const terms::Synchronized<3>& synchronized,
                                  terms::EnergySums& energies) const {
  LaneBits counted = 0;
  for (Index joint = begin; joint < end; ++joint) {
    if (!synchronized.counts(links_[at(joint)])) continue;
    counted |= static_cast<LaneBits>(1U << (joint - begin));
    energies[terms::EnergyKind::slip] += losses_[at(joint)].slip_work;
    energies[terms::EnergyKind::release] += losses_[at(joint)].released;
    energies[terms::EnergyKind::fracture] += losses_[at(joint)].opening + losses_[at(joint)].shear;
  }
  if (counted == 0) return;
  kinds_.visit_laws([&](const auto& kinds, std::size_t law) {
    LaneBits own = kinds_.has_one_law() ? counted : counted & lanes_of(law, begin, end);
    if (own == 0) return;
    const LaneEnergies found = this->energies(kinds, begin, synchronized);
    for (; own != 0; own &= own - 1) {
      const int lane = std::countr_zero(own);
      if (state(begin + lane) != JointState::broken) energies[terms::EnergyKind::elastic] += found.elastic[lane];
      energies[terms::EnergyKind::fracture] += found.fracture[lane];
      terms::add_work(table_.causes[0], -found.dashpots_after[lane], energies);
    }
  });
}

}  // namespace sazare::methods::blocks
