#include "sazare/methods/blocks/joints.hpp"

#include <algorithm>
#include <utility>

#include "sazare/methods/blocks/joint_rates.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 64;  // a joint takes some 30 ns, waking a thread some microseconds

/// Face axes: the normal out of the master and two tangents.
Matrix3 face_axes(const std::array<Vector3, 3>& corners) {
  Matrix3 axes;
  axes.col(0) = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  axes.col(1) = (corners[1] - corners[0]).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

void set_lane(LaneVector& lanes, int lane, const Vector3& value) {
  for (int i = 0; i < 3; ++i) lanes[static_cast<std::size_t>(i)][lane] = value[i];
}

Joint make_joint(const JointFace& face, const JointKind& kind, const state::Motion<3>& master,
                 const state::Motion<3>& slave) {
  Joint joint;
  const auto& c = face.corners;
  joint.frame = master.rotation.transpose() * face_axes(c);
  for (int lane = 0; lane < 4; ++lane) {  // the idle lane repeats the first vertex, without area
    const Vector3& corner = c[static_cast<std::size_t>(lane % 3)];
    set_lane(joint.corner, lane, joint.frame.transpose() * (master.rotation.transpose() * (corner - master.position)));
    set_lane(joint.arm, lane, slave.rotation.transpose() * (corner - slave.position));
  }
  joint.slip = {Lanes{}, Lanes{}};
  joint.peak = broadcast(kind.tension.elastic_opening);
  joint.unloading = broadcast(kind.tension.stiffness);
  joint.vertex_area = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 6;
  joint.master = face.master;
  joint.slave = face.slave;
  joint.kind = face.kind;
  return joint;
}

}  // namespace

Joints::Joints(std::vector<JointKind> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies)
    : kinds_(std::move(kinds)),
      at_face_(static_cast<std::size_t>(bodies.size()), {-1, -1, -1, -1}),
      rates_(static_cast<std::size_t>(bodies.size())) {
  for (const JointFace& face : faces) {
    const auto joint = static_cast<Index>(joints_.size());
    const auto first = static_cast<std::size_t>(face.master), second = static_cast<std::size_t>(face.slave);
    at_face_[first][static_cast<std::size_t>(face.master_face)] = joint;
    at_face_[second][static_cast<std::size_t>(face.slave_face)] = joint;
    links_.push_back({face.master, face.slave});
    joints_.push_back(make_joint(face, kinds_[static_cast<std::size_t>(face.kind)], bodies.motion[first], bodies.motion[second]));
  }
  table_.slots.resize(faces.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
  for (Index body = 0; body < bodies.size(); ++body) update_rates(body, bodies);
}

std::vector<Index> Joints::first_links() const {
  std::vector<Index> all;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    if (joints_[joint].state != JointState::broken) all.push_back(static_cast<Index>(joint));
  return all;
}

void Joints::evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& at : due.subspan(begin, end - begin)) {
      Joint& joint = joints_[static_cast<std::size_t>(at.link)];
      const auto& master = bodies.motion[static_cast<std::size_t>(joint.master)];
      const auto& slave = bodies.motion[static_cast<std::size_t>(joint.slave)];
      const state::Pose<3> master_pose = state::pose_at(master, now), slave_pose = state::pose_at(slave, now);
      const JointPlace placed = place(joint, master_pose, slave_pose);
      JointImpulse given;
      if (!blocks::evaluate(joint, kind(joint), placed, opening_velocity(placed, master, slave), at.acting, given)) {
        failed_.add(at.link);
        continue;
      }
      auto& slot = table_[at.link];
      const Vector3 apart = slave_pose.position - master_pose.position;
      if (terms::deposit<3, 1>(slot, 0, master, now, at, {reaction(given.total, apart), {reaction(given.dashpot, apart)}}))
        struck_.add(joint.master);
      if (terms::deposit<3, 1>(slot, 1, slave, now, at, {given.total, {given.dashpot}})) struck_.add(joint.slave);
      terms::mark(slot, now, at);
    }
  });
}

void Joints::settle(const Moment&, std::span<const Due>, const state::Bodies<3>& bodies, terms::Changes& changes) {
  changes.struck = struck_.take();
  for (const Index joint : failed_.take()) {
    const Joint& at = joints_[static_cast<std::size_t>(joint)];
    changes.ended_links.push_back(joint);
    for (const Index body : {at.master, at.slave}) {
      update_rates(body, bodies);
      changes.softer.push_back(body);
    }
    broken_.push_back(joint);
    ++broken_count_;
  }
}

std::vector<Index> Joints::take_broken() { return std::exchange(broken_, {}); }

bool Joints::bonded(Index first, Index second) const {
  for (const Index joint : at_face_[static_cast<std::size_t>(first)]) {
    if (joint < 0) continue;
    const Joint& at = joints_[static_cast<std::size_t>(joint)];
    if (at.state != JointState::broken && (at.master == second || at.slave == second)) return true;
  }
  return false;
}

void Joints::update_rates(Index body, const state::Bodies<3>& bodies) {
  const auto at = static_cast<std::size_t>(body);
  BodyMatrices matrices;
  for (const Index number : at_face_[at]) {
    if (number < 0) continue;
    const Joint& joint = joints_[static_cast<std::size_t>(number)];
    if (joint.state != JointState::broken) add_face(matrices, face_springs(joint, kind(joint), joint.master == body));
  }
  rates_[at] = largest_rates(matrices, bodies.inertia[at], bodies.start_rotation[at], bodies.locks[at]);
}

void Joints::add_energies(const terms::Synchronized<3>& at, terms::Ledger& ledger) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    ledger[terms::Account::joint_dashpot] -= table_.work_until(static_cast<Index>(i), links_[i], 0, at);
    ledger[terms::Account::slip] += joint.slip_work;
    ledger[terms::Account::release] += joint.released;
    for (int lane = 0; lane < 3; ++lane)
      ledger[terms::Account::fracture] +=
          joint.vertex_area * laws::fracture_dissipation(kind(joint).tension, joint.peak[lane]);
    if (joint.state == JointState::broken) continue;
    const JointPlace placed = place(joint, at.pose_of(joint.master), at.pose_of(joint.slave));
    ledger[terms::Account::elastic] += elastic_energy(joint, kind(joint), placed.displacement);
  }
}

void Joints::columns(Archive& archive) {
  archive("joints", joints_);
  archive("slots", table_.slots);
  archive("rates", rates_);
  archive("broken", broken_);
  archive("broken_count", broken_count_);
}

}  // namespace sazare::methods::blocks
