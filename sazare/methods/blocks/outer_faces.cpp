#include "sazare/methods/blocks/outer_faces.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

/// Stress of a spring or dashpot pair for a displacement or velocity [Pa].
Vector3 stress(const Vector3& normal, Real across, Real along, const Vector3& motion) {
  const Vector3 normal_part = normal.dot(motion) * normal;
  return across * normal_part + along * (motion - normal_part);
}

/// Where a point of an element is in its frame once it is strained. A rigid one keeps the bits of its points.
Vector3 strained(const Vector3& point, const Vector6& strain) {
  return strain.isZero(0) ? point : Vector3(point + tensor_of(strain) * point);
}

/// Velocity of a point of an element by the rate of its strain [m/s].
Vector3 straining(const BodyMotion& body, const Vector3& point) {
  return body.strain_rate.isZero(0) ? Vector3(Vector3::Zero())
                                    : Vector3(body.pose.rotation * (tensor_of(body.strain_rate) * point));
}

/// What a corner of a face does to the ground.
struct CornerForce {
  Vector3 arm;              ///< of the corner from the body's centre [m]
  Vector3 spring, dashpot;  ///< [N]
};

CornerForce corner_force(const OuterFace& face, std::size_t corner, const BodyMotion& body, const GroundState& ground) {
  const FaceSprings& springs = face.springs;
  const Vector3& corner_at_rest = springs.corners[corner];
  const Vector3 arm = body.pose.rotation * strained(corner_at_rest, body.strain);
  const Vector3 moved = body.pose.position + arm - face.place[corner] - ground.displacement;
  const Vector3 velocity = body.velocity + body.spin.cross(arm) + straining(body, corner_at_rest) - ground.velocity;
  return {arm, springs.corner_area * stress(face.normal, springs.normal_stiffness, springs.shear_stiffness, moved),
          springs.corner_area * stress(face.normal, springs.normal_damping, springs.shear_damping, velocity)};
}

bool moves(const MovingGround& ground) {
  return std::ranges::any_of(ground, [](const auto& along) { return along.has_value(); });
}

}  // namespace

OuterFaces::OuterFaces(std::vector<OuterFace> faces, std::vector<MovingGround> ground, const state::Bodies<3>& bodies)
    : ground_(std::move(ground)), faces_(std::move(faces)), rates_(find_rates(bodies, false)) {
  if (std::ranges::any_of(ground_, moves)) ground_work_.resize(faces_.size(), {Vector3::Zero(), 0, 0});
  for (const OuterFace& face : faces_) links_.push_back({face.body, Link::outside});
  if (std::ranges::any_of(faces_, [](const OuterFace& face) { return face.later.has_value(); }))
    rates_later_ = find_rates(bodies, true);
  strain_table_ = {bodies, faces_.size()};
  table_.causes = {terms::Cause::boundary};
  table_.slots.resize(faces_.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
}

/// Before time begins, or later.
std::vector<terms::Rates> OuterFaces::find_rates(const state::Bodies<3>& bodies, bool later) const {
  std::map<Index, BodyMatrices> matrices;
  for (const OuterFace& face : faces_) {
    matrices[face.body].is_strained = !bodies.strain.empty();
    add_face(matrices[face.body], later && face.later ? *face.later : face.springs);
  }
  std::vector<terms::Rates> rates(static_cast<std::size_t>(bodies.size()));
  for (const auto& [body, sum] : matrices) rates[static_cast<std::size_t>(body)] = largest_rates(sum, bodies, body);
  return rates;
}

std::vector<Index> OuterFaces::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void OuterFaces::take_later_springs() {
  for (OuterFace& face : faces_)
    if (face.later) face.springs = *face.later;
  rates_ = rates_later_;
}

std::vector<Index> OuterFaces::let_go(const state::Bodies<3>& bodies) {
  std::vector<Index> changed;
  for (OuterFace& face : faces_) {
    if (!face.later) continue;
    const auto& motion = bodies.motion[static_cast<std::size_t>(face.body)];
    BodyMotion body{{motion.position, motion.rotation}, Vector3::Zero(), Vector3::Zero()};
    if (!bodies.strain.empty()) body.strain = bodies.strain[static_cast<std::size_t>(face.body)].strain;
    for (std::size_t corner = 0; corner < 3; ++corner)
      face.traction[corner] -=
          corner_force(face, corner, body, {Vector3::Zero(), Vector3::Zero()}).spring / face.springs.corner_area;
    changed.push_back(face.body);
  }
  if (has_held()) take_later_springs();
  return changed;
}

GroundState OuterFaces::ground_at(Index boundary, Real time) const {
  GroundState state{Vector3::Zero(), Vector3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& along = ground_[static_cast<std::size_t>(boundary)][static_cast<std::size_t>(axis)];
    if (!along) continue;
    const laws::MotionState motion = along->at(time);
    state.displacement[axis] = motion.displacement;
    state.velocity[axis] = motion.velocity;
  }
  return state;
}

std::vector<GroundState> OuterFaces::ground_at(Real time) const {
  std::vector<GroundState> states;
  for (std::size_t boundary = 0; boundary < ground_.size(); ++boundary)
    states.push_back(ground_at(static_cast<Index>(boundary), time));
  return states;
}

void OuterFaces::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  const std::vector<GroundState> ground_now = ground_at(now.seconds());
  parallel::parallel_for(due.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (const Due& at : due.subspan(begin, end - begin))
      evaluate_one(now, at, ground_now[static_cast<std::size_t>(faces_[static_cast<std::size_t>(at.link)].boundary)], bodies);
  });
}

void OuterFaces::evaluate_one(const Instant& now, const Due& due, const GroundState& ground, const state::Bodies<3>& bodies) {
  const OuterFace& face = faces_[static_cast<std::size_t>(due.link)];
  const auto& motion = bodies.motion[static_cast<std::size_t>(face.body)];
  BodyMotion body{{motion.position, motion.rotation}, motion.predicted_velocity, motion.predicted_spin};
  if (!bodies.strain.empty()) {
    body.strain = bodies.strain[static_cast<std::size_t>(face.body)].strain;
    body.strain_rate = bodies.strain[static_cast<std::size_t>(face.body)].predicted_rate;
  }
  terms::PairForce<3> total, dashpots;
  Vector6 total_on_strain = Vector6::Zero(), dashpots_on_strain = Vector6::Zero();  // on the body
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const CornerForce force = corner_force(face, corner, body, ground);
    const Vector3 point = motion.position - bodies.pole + force.arm;
    const Vector3 sum = force.spring + force.dashpot - face.springs.corner_area * face.traction[corner];
    dashpots.add_at(point, force.dashpot);  // the ground is the second body
    total.add_at(point, sum);
    if (!strain_table_.exists) continue;
    const auto on_body = [&](const Vector3& on_ground) {
      return Vector6(-force_on_strain(motion.rotation.transpose() * on_ground, face.springs.corners[corner]));
    };
    total_on_strain += on_body(sum);
    dashpots_on_strain += on_body(force.dashpot);
  }
  auto& slot = table_[due.link];
  if (strain_table_.exists) strain_table_[due.link].write(slot.evaluated < 0, total_on_strain, {dashpots_on_strain});
  terms::write<3, 1>(slot, now, due, total, {dashpots});
  if (!ground_work_.empty()) count_work(due, now, ground);
}

/// The force of a face is given until `ahead` seconds after its evaluation, and begins where the one before has ended.
void OuterFaces::count_work(const Due& due, const Instant& now, const GroundState& ground_now) {
  const Index boundary = faces_[static_cast<std::size_t>(due.link)].boundary;
  if (!moves(ground_[static_cast<std::size_t>(boundary)])) return;
  GroundWork& done = ground_work_[static_cast<std::size_t>(due.link)];
  const Vector3 until = due.ahead == 0 ? ground_now.displacement : ground_at(boundary, now.seconds() + due.ahead).displacement;
  const Vector3 moved = until - done.given_until;
  const auto& slot = table_[due.link];
  done.work -= slot.total.linear.dot(moved);
  done.dissipated -= slot.part[0].linear.cast<Real>().dot(moved);
  done.given_until = until;
}

void OuterFaces::add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const {
  const std::vector<GroundState> ground_now = ground_at(at.time);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (!at.counts(links_[i])) continue;
    const OuterFace& face = faces_[i];
    const auto& body = at.pose_of(face.body);
    const GroundState& ground = ground_now[static_cast<std::size_t>(face.boundary)];
    table_.take_back(static_cast<Index>(i), links_[i], at, energies);
    strain_table_.take_back(static_cast<Index>(i), links_[i], table_, at, energies);
    if (!ground_work_.empty()) {
      const Vector3 ahead = displacement_ahead(i, ground);
      energies[terms::EnergyKind::work] += ground_work_[i].work + table_[static_cast<Index>(i)].total.linear.dot(ahead);
      energies[terms::EnergyKind::boundary] += dissipated_by_ground(i, ground);
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3 place = strained(face.springs.corners[corner], at.strain_of(face.body));
      const Vector3 moved = body.position + body.rotation * place - face.place[corner] - ground.displacement;
      energies[terms::EnergyKind::elastic] +=
          face.springs.corner_area *
          (0.5 * moved.dot(stress(face.normal, face.springs.normal_stiffness, face.springs.shear_stiffness, moved)) -
           face.traction[corner].dot(moved));
    }
  }
}

/// Work of moving ground that goes into the dashpots of a face [J].
Real OuterFaces::dissipated_by_ground(std::size_t face, const GroundState& ground) const {
  const auto& slot = table_[static_cast<Index>(face)];
  return ground_work_[face].dissipated + slot.part[0].linear.cast<Real>().dot(displacement_ahead(face, ground));
}

void OuterFaces::add_dissipated(const terms::Synchronized<3>& at, const std::function<bool(Index)>& owns,
                                const std::function<Real(Index)>& work_on, std::span<ExactSum> by_boundary) const {
  std::map<Index, Real> area;
  for (const OuterFace& face : faces_)
    if (owns(face.body)) area[face.body] += face.springs.corner_area;
  const std::vector<GroundState> ground_now = ground_at(at.time);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const OuterFace& face = faces_[i];
    if (!owns(face.body)) continue;
    const auto boundary = static_cast<std::size_t>(face.boundary);
    by_boundary[boundary] -= work_on(face.body) * (face.springs.corner_area / area[face.body]);
    by_boundary[boundary] += table_.work_after(static_cast<Index>(i), links_[i], at)[0];
    if (strain_table_.exists)
      by_boundary[boundary] += strain_table_.work_after(static_cast<Index>(i), links_[i], table_, at.strain)[0];
    if (!ground_work_.empty()) by_boundary[boundary] += dissipated_by_ground(i, ground_now[boundary]);
  }
}

std::vector<Vector3> OuterFaces::forces(Real time, const std::function<BodyMotion(Index)>& motion_of) const {
  std::vector<Vector3> sums(ground_.size(), Vector3::Zero());
  const std::vector<GroundState> ground = ground_at(time);
  for (const OuterFace& face : faces_) {
    const auto boundary = static_cast<std::size_t>(face.boundary);
    const BodyMotion body = motion_of(face.body);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const CornerForce force = corner_force(face, corner, body, ground[boundary]);
      sums[boundary] -= force.spring + force.dashpot - face.springs.corner_area * face.traction[corner];
    }
  }
  return sums;
}

void OuterFaces::carry(Index link, Parcel& parcel) {
  parcel(table_[link]);
  if (has_held()) parcel(faces_[static_cast<std::size_t>(link)].traction);
  strain_table_.carry(link, parcel);
  if (!ground_work_.empty()) parcel(ground_work_[static_cast<std::size_t>(link)]);
}

void OuterFaces::columns(Archive& archive) {
  archive("slots", table_.slots);
  if (has_held()) {  // there are checkpoints of what has let go alone
    std::vector<std::array<Vector3, 3>> tractions;
    for (const OuterFace& face : faces_) tractions.push_back(face.traction);
    archive("tractions", tractions);
    for (std::size_t i = 0; i < faces_.size(); ++i) faces_[i].traction = tractions[i];
    if (archive.reading()) take_later_springs();
  }
  strain_table_.columns(archive);
  if (!ground_work_.empty()) archive("ground_work", ground_work_);
}

}  // namespace sazare::methods::blocks
