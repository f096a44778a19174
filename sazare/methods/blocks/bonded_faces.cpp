#include "sazare/methods/blocks/bonded_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/core/large_tables.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t loosened_alone_below = 4;  // bodies; the rates of one take some microseconds

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

/// The initial tractions of a face. The area of the record is rounded; the force is that over the whole face.
FaceStress initial_stress(const JointRecord& joint, const JointFace& face, const Matrix3& to_master) {
  const auto axes = face_axes(joint.normal, joint.tilt);
  const auto& c = face.corners;
  const Real whole = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 6 / Real{joint.vertex_area};
  FaceStress stress;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Vector3 traction = whole * (to_master * face.traction[v]);
    stress[v] = {axes[0].dot(traction), axes[1].dot(traction), axes[2].dot(traction)};
  }
  return stress;
}

/// Moves the corners on the master so that the springs carry the initial tractions.
void preload(JointRecord& joint, const FaceStress& stress, const ElasticJoint& kind) {
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (stress[v].isZero(0)) continue;
    joint.vertex[v].corner[0] -= kind.opening_under(stress[v][0]);
    for (int along : {1, 2}) joint.vertex[v].corner[along] -= stress[v][along] / kind.shear_stiffness;
  }
}

JointRecord make_joint(const JointFace& face, const ElasticJoint& kind, const state::Bodies<3>& bodies) {
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
    joint.vertex[v].peak = kind.largest_opening;
  }
  joint.vertex_area = static_cast<float>(across.norm() / 6);
  joint.spread = spread_of(joint);
  joint.master = face.master;
  joint.slave = face.slave;
  joint.kind = static_cast<std::int16_t>(face.kind);
  return joint;
}

/// Of a joint that has neither slipped nor been preloaded.
MasterCorners corners_on_master(const JointRecord& joint) {
  const auto axes = face_axes(joint.normal, joint.tilt);
  MasterCorners corners;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Vector3& in_face = joint.vertex[v].corner;
    corners.vertex[v] = in_face[0] * axes[0] + in_face[1] * axes[1] + in_face[2] * axes[2];
  }
  return corners;
}

}  // namespace

BondedFaces::BondedFaces(std::vector<ElasticJoint> kinds, std::span<const JointFace> faces, std::vector<terms::Rates> rates,
                         std::vector<laws::DynamicIncrease> rate_laws, const state::Bodies<3>& bodies, bool some_remember_path)
    : elastic_(std::move(kinds)), at_face_(at(bodies.size()), {-1, -1, -1, -1}), rates_(std::move(rates)) {
  const bool some_natural = std::ranges::any_of(elastic_, &ElasticJoint::is_natural);
  reserve_on_large_pages(records_, faces.size());
  for (const JointFace& face : faces) {
    at_face_[at(face.master)][at(face.master_face)] = count();
    at_face_[at(face.slave)][at(face.slave_face)] = count();
    const ElasticJoint joint = elastic_joint(elastic_, face);
    records_.push_back(make_joint(face, joint, bodies));
    if (!bodies.strain.empty()) master_corners_.push_back(corners_on_master(records_.back()));
    const FaceStress stress = initial_stress(records_.back(), face, bodies.motion[at(face.master)].rotation.transpose());
    preload(records_.back(), stress, joint);
    if (some_natural) stresses_.push_back(stress);
    links_.push_back({face.master, face.slave});
  }
  if (std::ranges::any_of(faces, [](const JointFace& face) { return face.own.has_value(); }))
    for (const JointFace& face : faces) own_springs_.push_back(elastic_joint(elastic_, face));
  table_.causes = {terms::Cause::joint_dashpot};
  losses_.resize(faces.size());
  std::vector<JointRate> loading;
  for (const JointFace& face : faces) loading.push_back(face.rate);
  by_rate_ = {std::move(rate_laws), std::move(loading)};
  if (some_remember_path) {
    paths_.resize(faces.size());
    was_sheared_.resize(faces.size());
  }
  reserve_on_large_pages(table_.slots, faces.size());
  table_.slots.resize(faces.size());
  strain_table_ = {bodies, faces.size()};
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
}

std::vector<Index> BondedFaces::first_links() const {
  std::vector<Index> all;
  for (Index joint = 0; joint < count(); ++joint)
    if (state(joint) != JointState::broken) all.push_back(joint);
  return all;
}

/// Counts joints that have lost their strength under pressure, whichever process has found them.
void BondedFaces::note_sheared(terms::Peers& peers) {
  std::vector<Index> sheared = sheared_.take();
  peers.unite(sheared);
  for (const Index joint : sheared) {
    if (was_sheared_[at(joint)] != 0) continue;
    was_sheared_[at(joint)] = 1;
    records_[at(joint)].state = JointState::sheared;
    ++broken_count_;
  }
}

void BondedFaces::post_step(const Instant&, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) {
  if (!paths_.empty()) note_sheared(peers);
  std::vector<Index> failed = failed_.take();
  peers.unite(failed);
  for (const Index joint : failed) records_[at(joint)].state = JointState::broken;  // it may have failed in another process
  std::vector<Index> softer;
  for (const Index joint : failed) {
    changes.ended_links.push_back(joint);
    table_.incidence.end(joint, links_[at(joint)]);
    softer.insert(softer.end(), {links_[at(joint)].first, links_[at(joint)].second});
    broken_.push_back(joint);
    if (was_sheared_.empty() || was_sheared_[at(joint)] == 0) ++broken_count_;
  }
  std::ranges::sort(softer);
  softer.erase(std::unique(softer.begin(), softer.end()), softer.end());
  parallel::parallel_for(softer.size(), loosened_alone_below, [&](std::size_t begin, std::size_t end) {
    for (const Index body : std::span(softer).subspan(begin, end - begin)) update_rates(body, bodies);
  });
  changes.softer.insert(changes.softer.end(), softer.begin(), softer.end());
}

std::vector<Index> BondedFaces::take_broken() { return std::exchange(broken_, {}); }

bool BondedFaces::bonded(Index first, Index second) const {
  for (const Index joint : at_face_[at(first)]) {
    if (joint < 0 || state(joint) == JointState::broken) continue;
    if (links_[at(joint)].first == second || links_[at(joint)].second == second) return true;
  }
  return false;
}

void BondedFaces::update_rates(Index body, const state::Bodies<3>& bodies) {
  BodyMatrices matrices;
  matrices.is_strained = !bodies.strain.empty();
  for (const Index number : at_face_[at(body)])
    if (number >= 0 && state(number) != JointState::broken) {
      const JointRecord& joint = records_[at(number)];
      add_face(matrices, face_springs(joint, elastic(number), body, bodies));
    }
  const terms::Rates held = largest_rates(matrices, bodies, body);
  auto& rates = rates_[at(body)];
  rates = {std::min(rates.stiffness, held.stiffness), std::min(rates.damping, held.damping)};
}

void BondedFaces::carry(Index joint, Parcel& parcel) {
  parcel(records_[at(joint)].vertex);
  parcel(records_[at(joint)].state);
  parcel(losses_[at(joint)]);
  if (!paths_.empty()) parcel(paths_[at(joint)]);
  if (!stresses_.empty()) parcel(stresses_[at(joint)]);
  by_rate_.carry(joint, parcel);
  parcel(table_[joint]);
  strain_table_.carry(joint, parcel);
}

void BondedFaces::columns(Archive& archive) {
  archive("joints", records_);
  archive("losses", losses_);
  archive("slip_paths", paths_);
  archive("was_sheared", was_sheared_);
  if (!stresses_.empty()) archive("stresses", stresses_);
  by_rate_.columns(archive);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
  archive("rates", rates_);
  archive("broken", broken_);
  archive("broken_count", broken_count_);
  if (!archive.reading()) return;
  for (Index joint = 0; joint < count(); ++joint)
    if (state(joint) == JointState::broken) table_.incidence.end(joint, links_[at(joint)]);
}

}  // namespace sazare::methods::blocks
