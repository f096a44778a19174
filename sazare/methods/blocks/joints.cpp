#include "sazare/methods/blocks/joints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/methods/blocks/joint_rates.hpp"
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

void set_lane(LaneVector& lanes, int lane, const Vector3& value) {
  for (int axis = 0; axis < 3; ++axis) lanes[axis][lane] = value[axis];
}

void set_joint(JointBlock& block, int lane, const JointFace& face, const JointKind& kind, const state::Bodies<3>& bodies) {
  const auto &master = bodies.motion[at(face.master)], &slave = bodies.motion[at(face.slave)];
  const auto& c = face.corners;
  const Matrix3 frame = master.rotation.transpose() * face_axes(c);
  for (int axis = 0; axis < 3; ++axis) set_lane(block.frame[axis], lane, frame.col(axis));
  for (std::size_t v = 0; v < vertex_count; ++v) {
    set_lane(block.corner[v], lane, frame.transpose() * (master.rotation.transpose() * (c[v] - master.position)));
    set_lane(block.arm[v], lane, slave.rotation.transpose() * (c[v] - slave.position));
    block.peak[v][lane] = kind.tension.elastic_opening;
    block.unloading[v][lane] = kind.tension.stiffness;
  }
  block.vertex_area[lane] = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 6;
  block.master[at(lane)] = face.master;
  block.slave[at(lane)] = face.slave;
  block.kind[at(lane)] = face.kind;
}

}  // namespace

/// Lanes of one block that are due.
struct Joints::DueBlock {
  std::size_t block = 0;
  std::array<const Due*, lane_count> lanes{};
};

Joints::Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies)
    : kinds_(std::move(kinds)),
      blocks_((faces.size() + lane_count - 1) / lane_count, JointBlock{}),
      at_face_(at(bodies.size()), {-1, -1, -1, -1}),
      rates_(at(bodies.size())) {
  for (const JointFace& face : faces) {
    const auto joint = static_cast<Index>(links_.size());
    at_face_[at(face.master)][at(face.master_face)] = joint;
    at_face_[at(face.slave)][at(face.slave_face)] = joint;
    links_.push_back({face.master, face.slave});
    set_joint(blocks_[place_of(joint).block], place_of(joint).lane, face, kinds_[at(face.kind)], bodies);
  }
  table_.slots.resize(faces.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
  parallel::parallel_for(rates_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t body = begin; body < end; ++body) update_rates(static_cast<Index>(body), bodies);
  });
}

std::vector<Index> Joints::first_links() const {
  std::vector<Index> all;
  for (Index joint = 0; joint < count(); ++joint)
    if (state(joint) != JointState::broken) all.push_back(joint);
  return all;
}

void Joints::evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end;) {  // joints of one block that follow one another go together
      DueBlock together{place_of(due[i].link).block, {}};
      for (; i < end && place_of(due[i].link).block == together.block; ++i) together.lanes[at(place_of(due[i].link).lane)] = &due[i];
      evaluate_block(now, together, bodies);
    }
  });
}

void Joints::evaluate_block(const Moment& now, const DueBlock& due, const state::Bodies<3>& bodies) {
  JointBlock& block = blocks_[due.block];
  LanePointers<const state::Motion<3>> masters, slaves;
  Lanes acting{};
  LaneMask active{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    masters[lane] = &bodies.motion[at(block.master[lane])];
    slaves[lane] = &bodies.motion[at(block.slave[lane])];
    if (due.lanes[lane] == nullptr) continue;
    acting[static_cast<int>(lane)] = due.lanes[lane]->acting;
    active[static_cast<int>(lane)] = -1;
  }
  JointImpulses given;
  const LaneMask failed =
      blocks::evaluate(block, kinds_of(block), load_bodies(masters, now), load_bodies(slaves, now), active, acting, given);
  deliver(now, due, failed, given, bodies);
}

/// From lanes to the slots.
void Joints::deliver(const Moment& now, const DueBlock& due, LaneMask failed, const JointImpulses& given,
                     const state::Bodies<3>& bodies) {
  struct alignas(64) Record {
    terms::Deposit<3, 1> master, slave;
  };
  static_assert(sizeof(Record) == 24 * sizeof(Real));
  std::array<Record, lane_count> records;
  LanePointers<Record> rows;
  for (std::size_t lane = 0; lane < lane_count; ++lane) rows[lane] = &records[lane];
  std::array<Lanes, 24> fields;
  std::size_t next = 0;
  for (const FaceImpulse* side : {&given.master, &given.slave})
    for (const LaneVector* vector : {&side->linear, &side->angular, &side->dashpot_linear, &side->dashpot_angular})
      for (int axis = 0; axis < 3; ++axis) fields[next++] = (*vector)[axis];
  store_records<24>(fields, rows);
  const JointBlock& block = blocks_[due.block];
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Due* link = due.lanes[lane];
    if (link == nullptr) continue;
    if (failed[static_cast<int>(lane)] != 0) {
      failed_.add(link->link);
      continue;
    }
    auto& slot = table_[link->link];
    const Index master = block.master[lane], slave = block.slave[lane];
    if (terms::deposit(slot, 0, bodies.motion[at(master)], now, *link, records[lane].master)) struck_.add(master);
    if (terms::deposit(slot, 1, bodies.motion[at(slave)], now, *link, records[lane].slave)) struck_.add(slave);
    terms::mark(slot, now, *link);
  }
}

/// Parameters of each lane.
JointParameters<Lanes> Joints::kinds_of(const JointBlock& block) const {
  JointParameters<Lanes> lanes;
  for (int lane = 0; lane < lane_count; ++lane) {
    const JointKind& kind = kinds_[at(block.kind[at(lane)])];
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
  return lanes;
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
  const auto [number, lane] = place_of(joint);
  const JointBlock& block = blocks_[number];
  JointReport report{block.master[at(lane)], block.slave[at(lane)], block.kind[at(lane)], block.state[at(lane)],
                     vertex_count * block.vertex_area[lane], 0, 0};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    report.opening = std::max(report.opening, block.peak[v][lane]);
    report.slip = std::max(report.slip, std::hypot(block.slip[v][0][lane], block.slip[v][1][lane]));
  }
  return report;
}

void Joints::update_rates(Index body, const state::Bodies<3>& bodies) {
  BodyMatrices matrices;
  for (const Index joint : at_face_[at(body)])
    if (joint >= 0 && state(joint) != JointState::broken) {
      const auto [block, lane] = place_of(joint);
      const JointBlock& of = blocks_[block];
      add_face(matrices, face_springs(of, lane, kinds_[at(of.kind[at(lane)])], of.master[at(lane)] == body));
    }
  rates_[at(body)] = largest_rates(matrices, bodies.inertia[at(body)], bodies.start_rotation[at(body)], bodies.locks[at(body)]);
}

namespace {

/// Bodies of a block's lanes in their places at a base step.
LaneBodies bodies_at(const std::array<Index, lane_count>& which, const terms::Synchronized<3>& synchronized) {
  LaneBodies bodies{};
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto& pose = synchronized.pose_of(which[at(lane)]);
    set_lane(bodies.position, lane, pose.position);
    for (int axis = 0; axis < 3; ++axis) set_lane(bodies.rotation[axis], lane, pose.rotation.col(axis));
  }
  return bodies;
}

}  // namespace

void Joints::add_energies(const terms::Synchronized<3>& synchronized, terms::Ledger& ledger) const {
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    const JointBlock& block = blocks_[number];
    const LaneBodies masters = bodies_at(block.master, synchronized), slaves = bodies_at(block.slave, synchronized);
    const Lanes elastic = elastic_energy(block, kinds_of(block), face_geometry(block, masters, slaves));
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto joint = static_cast<Index>(number * lane_count) + lane;
      if (joint >= count()) break;
      ledger[terms::Account::joint_dashpot] -= table_.work_until(joint, links_[at(joint)], 0, synchronized);
      ledger[terms::Account::slip] += block.slip_work[lane];
      ledger[terms::Account::release] += block.released[lane];
      for (std::size_t v = 0; v < vertex_count; ++v)
        ledger[terms::Account::fracture] +=
            block.vertex_area[lane] * laws::fracture_dissipation(kinds_[at(block.kind[at(lane)])].tension, block.peak[v][lane]);
      if (block.state[at(lane)] != JointState::broken) ledger[terms::Account::elastic] += elastic[lane];
    }
  }
}

void Joints::columns(Archive& archive) {
  archive("blocks", blocks_);
  archive("slots", table_.slots);
  archive("rates", rates_);
  archive("broken", broken_);
  archive("broken_count", broken_count_);
}

}  // namespace sazare::methods::blocks
