#include "sazare/methods/blocks/joints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/core/lane_sum.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/levels/terms/book_ranges.hpp"
#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 1024;       // a joint takes some 35 ns, waking a thread some microseconds
constexpr std::size_t batches_ahead = 4;         // memory answers after some 150 ns, a batch takes as long
constexpr std::size_t loosened_alone_below = 4;  // bodies; the rates of one take some microseconds

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// Sums over the vertices about their middle, see JointRecord.
std::array<float, 3> spread_of(const JointRecord& joint) {
  const Vector3 middle = (joint.vertex[0].corner + joint.vertex[1].corner + joint.vertex[2].corner) / vertex_count;
  Vector3 sums = Vector3::Zero();
  for (const auto& vertex : joint.vertex) {
    const Vector3 from = vertex.corner - middle;
    sums += Vector3(from.y() * from.y(), from.z() * from.z(), from.y() * from.z());
  }
  sums *= Real{joint.vertex_area};
  return {static_cast<float>(sums[0]), static_cast<float>(sums[1]), static_cast<float>(sums[2])};
}

void set_lane(JointParameters<Lanes>& lanes, int lane, const JointKind& kind) {
  lanes.tension.stiffness[lane] = kind.tension.stiffness;
  lanes.tension.strength[lane] = kind.tension.strength;
  lanes.tension.elastic_opening[lane] = kind.tension.elastic_opening;
  lanes.tension.failure_opening[lane] = kind.tension.failure_opening;
  lanes.shear.stiffness[lane] = kind.shear.stiffness;
  lanes.shear.cohesion[lane] = kind.shear.cohesion;
  lanes.shear.friction[lane] = kind.shear.friction;
  lanes.normal_damping[lane] = kind.normal_damping;
  lanes.shear_damping[lane] = kind.shear_damping;
}

JointRecord make_joint(const JointFace& face, const JointKind& kind, const state::Bodies<3>& bodies) {
  const auto &master = bodies.motion[at(face.master)], &slave = bodies.motion[at(face.slave)];
  const auto& c = face.corners;
  JointRecord joint;
  const Vector3 across = (c[1] - c[0]).cross(c[2] - c[0]);
  joint.normal = (master.rotation.transpose() * across).normalized();
  joint.tilt = face_tilt(joint.normal);
  const auto axes = face_axes(joint.normal, joint.tilt);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Vector3 arm = slave.rotation.transpose() * (c[v] - slave.position);
    for (int axis = 0; axis < 3; ++axis) joint.arm[v][at(axis)] = static_cast<float>(arm[axis]);
    const Vector3 vertex = slave.position + slave.rotation * joint.arm_of(v);
    const Vector3 from_master = master.rotation.transpose() * (vertex - master.position);
    for (int axis = 0; axis < 3; ++axis) joint.vertex[v].corner[axis] = axes[at(axis)].dot(from_master);
    joint.vertex[v].peak = kind.tension.elastic_opening;
  }
  joint.vertex_area = static_cast<float>(across.norm() / 6);
  joint.spread = spread_of(joint);
  joint.master = face.master;
  joint.slave = face.slave;
  joint.kind = static_cast<std::int16_t>(face.kind);
  return joint;
}

}  // namespace

Joints::Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies)
    : Joints(kinds, faces, joint_rates(kinds, faces, bodies), bodies) {}

Joints::Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
               const state::Bodies<3>& bodies)
    : kinds_(std::move(kinds)), at_face_(at(bodies.size()), {-1, -1, -1, -1}), rates_(std::move(rates)) {
  for (const JointKind& kind : kinds_) {
    lane_kinds_.emplace_back();
    for (int lane = 0; lane < lane_count; ++lane) set_lane(lane_kinds_.back(), lane, kind);
  }
  reserve_on_large_pages(records_, faces.size());
  for (const JointFace& face : faces) {
    at_face_[at(face.master)][at(face.master_face)] = count();
    at_face_[at(face.slave)][at(face.slave_face)] = count();
    records_.push_back(make_joint(face, kinds_[at(face.kind)], bodies));
    links_.push_back({face.master, face.slave});
  }
  table_.causes = {terms::Cause::joint_dashpot};
  losses_.resize(faces.size());
  reserve_on_large_pages(table_.slots, faces.size());
  table_.slots.resize(faces.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
}

std::vector<Index> Joints::first_links() const {
  std::vector<Index> all;
  for (Index joint = 0; joint < count(); ++joint)
    if (state(joint) != JointState::broken) all.push_back(joint);
  return all;
}

void Joints::evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for_uneven(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += lane_count) {
      if (is_large(records_)) ask_for_some(due.subspan(i, end - i), bodies);
      evaluate_lanes(now, due.subspan(i, std::min<std::size_t>(lane_count, end - i)), bodies);
    }
  });
}

/// Asks for what as many joints as there are lanes will need, some batches later.
void Joints::ask_for_some(std::span<const Due> due, const state::Bodies<3>& bodies) const {
  constexpr std::size_t begin = batches_ahead * lane_count, end = begin + lane_count;
  for (std::size_t n = begin; n < std::min(end, due.size()); ++n) {
    const Index joint = due[n].link;
    ask_for(records_[at(joint)]);
    ask_for(table_[joint]);
    for (const Index body : {links_[at(joint)].first, links_[at(joint)].second})
      ask_for(bodies.motion[at(body)], state::bytes_for_forces<3>);
  }
}

/// Evaluates as many joints as there are lanes, or fewer: idle lanes repeat the first.
[[gnu::flatten]] void Joints::evaluate_lanes(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
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
  const JointForce force =
      blocks::evaluate(LaneJoints<JointRecord>{records}, kinds_of(records), masters, slaves, bodies.pole, failed, change);
  terms::write(slots, now, in_lanes, force.total, force.dashpots, failed);
  if (!change.has_happened) return;
  remember(records, change);
  book(due, change);
}

/// What joints remember of slip and opening: in lanes, for nobody guesses which of them have slipped. Those that have not keep
/// their bits, whoever else has: to add 0 would change the sign of a 0.
void Joints::remember(const LanePointers<JointRecord>& records, const JointChange& change) {
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::size_t begin = JointRecord::vertex_begin(v);
    auto numbers = load_quad(records, begin);
    for (std::size_t axis = 0; axis < 2; ++axis)
      numbers[axis + 1] = select(change.slipped, numbers[axis + 1] + change.slip[v][axis], numbers[axis + 1]);
    numbers[3] = change.peak[static_cast<int>(v)];
    store_quad(numbers, records, begin);
  }
}

/// What changes of joints have cost, and which of them soften or fail.
void Joints::book(std::span<const Due> due, const JointChange& change) {
  for (std::size_t lane = 0; lane < due.size(); ++lane)
    losses_[at(due[lane].link)].slip_work += change.slip_work[static_cast<int>(lane)];
  if (!any(change.softened)) return;
  for (std::size_t lane = 0; lane < due.size(); ++lane) {
    const int i = static_cast<int>(lane);
    if (change.softened[i] == 0) continue;
    const bool failed = change.failed[i] != 0;
    records_[at(due[lane].link)].state = failed ? JointState::broken : JointState::softening;
    if (!failed) continue;
    losses_[at(due[lane].link)].released = change.released[i];
    failed_.add(due[lane].link);
  }
}

/// Parameters of each lane, until the next call in this thread.
template <class Record>
const JointParameters<Lanes>& Joints::kinds_of(const LanePointers<Record>& joints) const {
  thread_local JointParameters<Lanes> mixed;
  if (lane_kinds_.size() == 1) return lane_kinds_[0];
  const Index kind = joints[0]->kind;
  if (std::ranges::all_of(joints, [&](const JointRecord* joint) { return joint->kind == kind; })) return lane_kinds_[at(kind)];
  for (int lane = 0; lane < lane_count; ++lane) set_lane(mixed, lane, kinds_[at(joints[at(lane)]->kind)]);
  return mixed;
}

void Joints::settle(const Moment&, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) {
  std::vector<Index> failed = failed_.take();
  peers.unite(failed);
  for (const Index joint : failed) records_[at(joint)].state = JointState::broken;  // it may have failed in another process
  std::vector<Index> softer;
  for (const Index joint : failed) {
    changes.ended_links.push_back(joint);
    table_.incidence.end(joint, links_[at(joint)]);
    softer.insert(softer.end(), {links_[at(joint)].first, links_[at(joint)].second});
    broken_.push_back(joint);
    ++broken_count_;
  }
  std::ranges::sort(softer);
  softer.erase(std::unique(softer.begin(), softer.end()), softer.end());
  parallel::parallel_for(softer.size(), loosened_alone_below, [&](std::size_t begin, std::size_t end) {
    for (const Index body : std::span(softer).subspan(begin, end - begin)) update_rates(body, bodies);
  });
  changes.softer.insert(changes.softer.end(), softer.begin(), softer.end());
}

std::vector<Index> Joints::take_broken() { return std::exchange(broken_, {}); }

bool Joints::bonded(Index first, Index second) const {
  for (const Index joint : at_face_[at(first)]) {
    if (joint < 0 || state(joint) == JointState::broken) continue;
    if (links_[at(joint)].first == second || links_[at(joint)].second == second) return true;
  }
  return false;
}

void Joints::update_rates(Index body, const state::Bodies<3>& bodies) {
  BodyMatrices matrices;
  for (const Index number : at_face_[at(body)])
    if (number >= 0 && state(number) != JointState::broken) {
      const JointRecord& joint = records_[at(number)];
      add_face(matrices, face_springs(joint, kinds_[at(joint.kind)], body, bodies));
    }
  const terms::Rates held =
      largest_rates(matrices, bodies.inertia[at(body)], state::start_rotation(bodies, body), bodies.locks[at(body)]);
  auto& rates = rates_[at(body)];
  rates = {std::min(rates.stiffness, held.stiffness), std::min(rates.damping, held.damping)};
}

/// Of as many joints as there are lanes: elastic energy in the places of a base step, what fracture has taken, and work of the
/// dashpots after it [J]. Lanes beyond the last joint repeat it.
[[gnu::flatten]] Joints::LaneEnergies Joints::energies(Index first, const terms::Synchronized<3>& synchronized) const {
  LanePointers<const JointRecord> records;
  LanePointers<const terms::Slot<3, 1>> slots;
  LanePointers<const state::Pose<3>> masters, slaves;
  LanePointers<const state::MeanMotion<3>> master_ahead, slave_ahead;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Index joint = std::min(first + static_cast<Index>(lane), count() - 1);
    records[lane] = &records_[at(joint)];
    slots[lane] = &table_[joint];
    masters[lane] = &synchronized.pose_of(records[lane]->master);
    slaves[lane] = &synchronized.pose_of(records[lane]->slave);
    master_ahead[lane] = &synchronized.ahead[at(records[lane]->master)];
    slave_ahead[lane] = &synchronized.ahead[at(records[lane]->slave)];
  }
  const auto& kind = kinds_of(records);
  const FaceGeometry at = face_geometry(LaneJoints<const JointRecord>{records}, masters, slaves);
  const bool soften = some_soften(kind, at);
  return {elastic_energy(kind, at, tension_stress(kind, at, soften)), soften ? fracture_work(kind, at) : Lanes{},
          terms::work_after(slots, master_ahead, slave_ahead)};
}

/// Sums of the accounts that joints have, in lanes.
struct Joints::Sums {
  LaneSum elastic, fracture, release, slip, dashpots;

  explicit Sums(terms::Books& books)
      : elastic(books[terms::Account::elastic]),
        fracture(books[terms::Account::fracture]),
        release(books[terms::Account::release]),
        slip(books[terms::Account::slip]),
        dashpots(books[terms::account_of(terms::Cause::joint_dashpot)]) {}
};

void Joints::add_energies(const terms::Synchronized<3>& synchronized, terms::Books& books) const {
  terms::book_ranges(links_.size(), serial_below, books, [&](std::size_t begin, std::size_t end, terms::Books& own) {
    Sums sums(own);
    for (auto first = static_cast<Index>(begin); at(first) < end; first += lane_count)
      add_energies(first, std::min(first + lane_count, static_cast<Index>(end)), synchronized, sums);
  });
}

/// Those of as many joints as there are lanes at most.
void Joints::add_energies(Index begin, Index end, const terms::Synchronized<3>& synchronized, Sums& sums) const {
  LaneBits counted = 0, broken = 0;
  Lanes slip_work{}, released{};
  for (Index joint = begin; joint < end; ++joint) {
    const int lane = joint - begin;
    if (!synchronized.counts(links_[at(joint)])) continue;
    counted |= static_cast<LaneBits>(1U << lane);
    if (state(joint) == JointState::broken) broken |= static_cast<LaneBits>(1U << lane);
    slip_work[lane] = losses_[at(joint)].slip_work;
    released[lane] = losses_[at(joint)].released;
  }
  if (counted == 0) return;
  const LaneEnergies found = energies(begin, synchronized);
  const LaneMask count = mask_of(counted);
  sums.elastic += select(count & ~mask_of(broken), found.elastic, Lanes{});
  sums.fracture += select(count, found.fracture, Lanes{});
  terms::book_work(table_.causes[0], -select(count, found.dashpots_after, Lanes{}), sums.dashpots);
  sums.slip += slip_work;
  sums.release += released;
}

void Joints::carry(Index joint, Parcel& parcel) {
  parcel(records_[at(joint)].vertex);
  parcel(records_[at(joint)].state);
  parcel(losses_[at(joint)]);
  parcel(table_[joint]);
}

void Joints::columns(Archive& archive) {
  archive("joints", records_);
  archive("losses", losses_);
  archive("slots", table_.slots);
  archive("rates", rates_);
  archive("broken", broken_);
  archive("broken_count", broken_count_);
  if (!archive.reading()) return;
  for (Index joint = 0; joint < count(); ++joint)
    if (state(joint) == JointState::broken) table_.incidence.end(joint, links_[at(joint)]);
}

}  // namespace sazare::methods::blocks
