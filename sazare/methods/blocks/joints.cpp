#include "sazare/methods/blocks/joints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 128;  // a joint takes some 20 ns, waking a thread some microseconds

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// Face axes: the normal out of the master and two tangents.
Matrix3 face_axes(const std::array<Vector3, 3>& corners) {
  Matrix3 axes;
  axes.col(0) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  axes.col(1) = (corners[1] - corners[0]).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
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
  const Matrix3 frame = master.rotation.transpose() * face_axes(c);
  JointRecord joint;
  joint.shape.frame = {frame.col(0), frame.col(1), frame.col(2)};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    joint.shape.corner[v] = frame.transpose() * (master.rotation.transpose() * (c[v] - master.position));
    joint.shape.arm[v] = slave.rotation.transpose() * (c[v] - slave.position);
  }
  joint.shape.vertex_area = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 6;
  joint.memory.peak.setConstant(kind.tension.elastic_opening);
  joint.memory.unloading.setConstant(kind.tension.stiffness);
  joint.master = face.master;
  joint.slave = face.slave;
  joint.kind = face.kind;
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
  for (const JointFace& face : faces) {
    at_face_[at(face.master)][at(face.master_face)] = count();
    at_face_[at(face.slave)][at(face.slave_face)] = count();
    records_.push_back(make_joint(face, kinds_[at(face.kind)], bodies));
    links_.push_back({face.master, face.slave});
  }
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
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += lane_count)
      evaluate_lanes(now, due.subspan(i, std::min<std::size_t>(lane_count, end - i)), bodies);
  });
}

/// Evaluates as many joints as there are lanes, or fewer: idle lanes repeat the first.
void Joints::evaluate_lanes(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  LanePointers<JointRecord> records;
  LanePointers<const state::Motion<3>> masters, slaves;
  Lanes acting{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Due& link = due[lane < due.size() ? lane : 0];
    records[lane] = &records_[at(link.link)];
    masters[lane] = &bodies.motion[at(records[lane]->master)];
    slaves[lane] = &bodies.motion[at(records[lane]->slave)];
    acting[static_cast<int>(lane)] = link.acting;
  }
  LaneJoints joints = load_joints(records);
  JointParameters<Lanes> mixed;
  JointImpulses given;
  const JointChange change = blocks::evaluate(joints, kinds_of(records, mixed), load_bodies(masters, now),
                                              load_bodies(slaves, now), acting, given);
  if (any(change.softened | change.slipped)) store_memory(joints.memory, records, static_cast<int>(due.size()));
  deliver(now, due, change, given, bodies);
}

/// From lanes to the slots.
void Joints::deliver(const Moment& now, std::span<const Due> due, const JointChange& change, const JointImpulses& given,
                     const state::Bodies<3>& bodies) {
  struct alignas(64) Record {
    terms::Deposit<3, 1> master, slave;
  };
  static_assert(sizeof(Record) == 24 * sizeof(Real));
  std::array<Record, lane_count> impulses;
  LanePointers<Record> rows;
  for (std::size_t lane = 0; lane < lane_count; ++lane) rows[lane] = &impulses[lane];
  const FaceImpulse &m = given.master, &s = given.slave;
  store_records<24>({m.linear[0], m.linear[1], m.linear[2], m.angular[0], m.angular[1], m.angular[2],
                     m.dashpot_linear[0], m.dashpot_linear[1], m.dashpot_linear[2],
                     m.dashpot_angular[0], m.dashpot_angular[1], m.dashpot_angular[2],
                     s.linear[0], s.linear[1], s.linear[2], s.angular[0], s.angular[1], s.angular[2],
                     s.dashpot_linear[0], s.dashpot_linear[1], s.dashpot_linear[2],
                     s.dashpot_angular[0], s.dashpot_angular[1], s.dashpot_angular[2]}, rows);
  for (std::size_t lane = 0; lane < due.size(); ++lane) {
    JointRecord& joint = records_[at(due[lane].link)];
    if (change.softened[static_cast<int>(lane)] != 0) joint.state = JointState::softening;
    if (change.failed[static_cast<int>(lane)] == 0) {
      deliver_one(now, due[lane], joint, impulses[lane].master, impulses[lane].slave, bodies);
    } else {
      joint.state = JointState::broken;
      failed_.add(due[lane].link);
    }
  }
}

void Joints::deliver_one(const Moment& now, const Due& due, const JointRecord& joint, const terms::Deposit<3, 1>& on_master,
                         const terms::Deposit<3, 1>& on_slave, const state::Bodies<3>& bodies) {
  auto& slot = table_[due.link];
  const auto &master = bodies.motion[at(joint.master)], &slave = bodies.motion[at(joint.slave)];
  if (slot.lagging < 0 && master.due == now.tick && slave.due == now.tick) {  // the usual way, and much the shortest
    slot.waiting = {on_master, on_slave};
    slot.acting = {due.acting, due.acting};
  } else {
    if (terms::deposit(slot, 0, master, now, due, on_master)) struck_.add(joint.master);
    if (terms::deposit(slot, 1, slave, now, due, on_slave)) struck_.add(joint.slave);
  }
  terms::mark(slot, now, due);
}

/// Parameters of each lane; `mixed` holds them where the lanes are of several kinds.
const JointParameters<Lanes>& Joints::kinds_of(const LanePointers<JointRecord>& joints, JointParameters<Lanes>& mixed) const {
  const Index kind = joints[0]->kind;
  if (std::ranges::all_of(joints, [&](const JointRecord* joint) { return joint->kind == kind; })) return lane_kinds_[at(kind)];
  for (int lane = 0; lane < lane_count; ++lane) set_lane(mixed, lane, kinds_[at(joints[at(lane)]->kind)]);
  return mixed;
}

void Joints::settle(const Moment&, std::span<const Due>, const state::Bodies<3>& bodies, terms::Changes& changes) {
  changes.struck = struck_.take();
  for (const Index joint : failed_.take()) {
    changes.ended_links.push_back(joint);
    for (const Index body : {links_[at(joint)].first, links_[at(joint)].second}) {
      update_rates(body, bodies);
      changes.softer.push_back(body);
    }
    broken_.push_back(joint);
    ++broken_count_;
  }
}

std::vector<Index> Joints::take_broken() { return std::exchange(broken_, {}); }

bool Joints::bonded(Index first, Index second) const {
  for (const Index joint : at_face_[at(first)]) {
    if (joint < 0 || state(joint) == JointState::broken) continue;
    if (links_[at(joint)].first == second || links_[at(joint)].second == second) return true;
  }
  return false;
}

JointReport Joints::report(Index joint) const {
  const JointRecord& record = records_[at(joint)];
  JointReport report{record.master, record.slave, record.kind, record.state, vertex_count * record.shape.vertex_area,
                     record.memory.peak.maxCoeff(), 0};
  for (const auto& slip : record.memory.slip) report.slip = std::max(report.slip, std::hypot(slip[0], slip[1]));
  return report;
}

void Joints::update_rates(Index body, const state::Bodies<3>& bodies) {
  BodyMatrices matrices;
  for (const Index number : at_face_[at(body)])
    if (number >= 0 && state(number) != JointState::broken) {
      const JointRecord& joint = records_[at(number)];
      add_face(matrices, face_springs(joint, kinds_[at(joint.kind)], joint.master == body));
    }
  rates_[at(body)] = largest_rates(matrices, bodies.inertia[at(body)], bodies.start_rotation[at(body)], bodies.locks[at(body)]);
}

namespace {

void set_lane(LaneBodies& bodies, int lane, const state::Pose<3>& pose) {
  for (int row = 0; row < 3; ++row) {
    bodies.position[row][lane] = pose.position[row];
    for (int column = 0; column < 3; ++column) bodies.rotation[column][row][lane] = pose.rotation(row, column);
  }
}

}  // namespace

/// Elastic energy [J] of as many joints as there are lanes, in the places of a base step; lanes beyond the last joint
/// repeat it.
Lanes Joints::elastic_energies(Index first, const terms::Synchronized<3>& synchronized) const {
  std::array<JointRecord, lane_count> own;
  LanePointers<JointRecord> records;
  LaneBodies master{}, slave{};
  for (int lane = 0; lane < lane_count; ++lane) {
    const JointRecord& joint = own[at(lane)] = records_[at(std::min(first + lane, count() - 1))];
    records[at(lane)] = &own[at(lane)];
    set_lane(master, lane, synchronized.pose_of(joint.master));
    set_lane(slave, lane, synchronized.pose_of(joint.slave));
  }
  const LaneJoints joints = load_joints(records);
  JointParameters<Lanes> mixed;
  return elastic_energy(joints, kinds_of(records, mixed), face_geometry(joints.shape, master, slave));
}

void Joints::add_energies(const terms::Synchronized<3>& synchronized, terms::Ledger& ledger) const {
  Lanes elastic{};
  for (Index number = 0; number < count(); ++number) {
    const JointRecord& joint = records_[at(number)];
    ledger[terms::Account::joint_dashpot] -= table_.work_until(number, links_[at(number)], 0, synchronized);
    ledger[terms::Account::slip] += joint.memory.slip_work;
    ledger[terms::Account::release] += joint.memory.released;
    for (int v = 0; v < vertex_count; ++v)
      ledger[terms::Account::fracture] +=
          joint.shape.vertex_area * laws::fracture_dissipation(kinds_[at(joint.kind)].tension, joint.memory.peak[v]);
    if (number % lane_count == 0) elastic = elastic_energies(number, synchronized);
    if (joint.state != JointState::broken) ledger[terms::Account::elastic] += elastic[static_cast<int>(number % lane_count)];
  }
}

void Joints::columns(Archive& archive) {
  archive("joints", records_);
  archive("slots", table_.slots);
  archive("rates", rates_);
  archive("broken", broken_);
  archive("broken_count", broken_count_);
}

}  // namespace sazare::methods::blocks
