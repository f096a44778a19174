#include "sazare/methods/blocks/water/water_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/laws/water/submerged_part.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::int64_t base_steps_between_looks = 8;  // at faces that come apart
constexpr std::size_t serial_below = 256;     // an element takes some 100 ns
constexpr Real steps_of_drag =
    4;  // where one would be stable: a force that grows with the square of the speed then works within 1 %

/// The corners of a local face.
std::array<Vector3, 3> corners_of_face(const std::array<Vector3, 4>& corners, Index face) {
  std::array<Vector3, 3> found;
  std::size_t next = 0;
  for (std::size_t n = 0; n < 4; ++n)
    if (n != at(face)) found[next++] = corners[n];
  return found;
}

/// Outward, with the length of the area [m2].
Vector3 outward_area(const std::array<Vector3, 4>& corners, Index face) {
  const auto [a, b, c] = corners_of_face(corners, face);
  const Vector3 area = 0.5 * (b - a).cross(c - a);
  return area.dot(corners[at(face)] - a) > 0 ? Vector3(-area) : area;
}

Vector3 middle_of(const std::array<Vector3, 3>& corners) { return (corners[0] + corners[1] + corners[2]) / 3; }

}  // namespace

struct WaterLoads::Load {
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  Vector6 strain = Vector6::Zero();  ///< on the strain [N m]

  /// A force at a point of the body, given by where that is if it is unstrained, in its frame.
  void add(const Vector3& push, const Vector3& place, const Matrix3& gradient, const Matrix3& rotation) {
    force += push;
    moment += (gradient * place).cross(push);
    strain += force_on_strain(rotation.transpose() * push, place);
  }
};

WaterLoads::WaterLoads(laws::WaterField water, Real drag_coefficient, const geometry::ElementCorners& corners,
                       std::vector<WettedFace> faces, const BondedFaces& joints, const state::Bodies<3>& bodies)
    : water_(std::move(water)), drag_coefficient_(drag_coefficient), faces_(std::move(faces)), joints_(&joints) {
  for (Index body = 0; body < bodies.size(); ++body) {
    const auto& motion = bodies.motion[at(body)];
    Corners& own = corners_.emplace_back(corners.of(body));
    volume_.push_back(geometry::volume(own));
    for (Vector3& corner : own) corner = motion.rotation.transpose() * (corner - motion.position);
    links_.push_back({body, Link::outside});
  }
  std::ranges::stable_sort(faces_, {}, &WettedFace::body);
  for (Index body = 0; body <= bodies.size(); ++body)
    first_face_.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(faces_, body, {}, &WettedFace::body) - faces_.begin()));
  for (const WettedFace& face : faces_) {
    is_washed_.push_back(face.other_body < 0 ? 1 : 0);
    width_.push_back(std::sqrt(outward_area(corners_[at(face.body)], face.face).norm()));
  }
  find_drag_rates(bodies);
  table_.causes = {terms::Cause::load};
  table_.slots.resize(links_.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
  strain_table_ = {bodies, links_.size()};
}

/// The flow meets at most half of a body's faces.
void WaterLoads::find_drag_rates(const state::Bodies<3>& bodies) {
  const Real flow = water_.largest_speed();
  for (std::size_t body = 0; body < volume_.size(); ++body) {
    Real area = 0;
    for (std::size_t face = first_face_[body]; face < first_face_[body + 1]; ++face)
      area += 0.5 * outward_area(corners_[body], faces_[face].face).norm();
    const Real mass = bodies.inertia[body].mass, drag = water_.density * drag_coefficient_ * area;  // of a speed [kg/m]
    const Real weight = std::abs(mass - water_.density * volume_[body]) * water_.gravity;
    const Real sinking = drag > 0 ? std::sqrt(2 * weight / drag) : 0;
    drag_rate_.push_back(steps_of_drag * drag * (flow + sinking + bodies.motion[body].velocity.norm()) / mass);
  }
}

std::vector<Index> WaterLoads::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void WaterLoads::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& link : due.subspan(begin, end - begin)) {
      const Load load = load_on(link.link, now, bodies);
      auto& slot = table_[link.link];
      if (strain_table_.exists) strain_table_[link.link].write(slot.evaluated < 0, load.strain, {});
      terms::PairForce<3> reaction;  // on the outside, the second body
      reaction.add_at(bodies.motion[at(link.link)].position - bodies.pole, -load.force);
      reaction.moment -= load.moment;
      terms::write<3, 0>(slot, now, link, reaction, {});
    }
  });
}

/// Until time begins the water is as it is then, but does not flow.
WaterLoads::Load WaterLoads::load_on(Index body, const Instant& now, const state::Bodies<3>& bodies) const {
  const Real time = std::max<Real>(0, now.seconds());
  const auto& motion = bodies.motion[at(body)];
  const Real surface = water_.surface(motion.position, time);
  Load load;
  Matrix3 gradient = motion.rotation;
  if (!bodies.strain.empty()) gradient += motion.rotation * tensor_of(bodies.strain[at(body)].strain);
  laws::CutSimplex<4> cut{corners_[at(body)], {}};
  for (std::size_t n = 0; n < 4; ++n)
    cut.depth[n] = surface - water_.elevation(motion.position + gradient * cut.corner[n]);
  const laws::SubmergedPart part = laws::submerged_part(cut);
  if (!(part.share > 0)) return load;
  const Real stretch = bodies.strain.empty() ? 1 : (motion.rotation.transpose() * gradient).determinant();
  const Real mass = water_.density * volume_[at(body)] * stretch * part.share;
  const Vector3 place = part.moment / part.share;
  laws::WaterMotion flow;
  if (now.has_begun()) flow = water_.motion(motion.position + gradient * place, surface, time);
  load.add(mass * (water_.gravity * water_.up + flow.acceleration), place, gradient, motion.rotation);
  if (!now.has_begun()) return load;
  for (std::size_t face = first_face_[at(body)]; face < first_face_[at(body) + 1]; ++face)
    if (is_washed_[face] != 0) add_drag(face, time, bodies, gradient, load);
  return load;
}

/// Drag on the submerged part of a face that the flow meets.
void WaterLoads::add_drag(std::size_t face, Real time, const state::Bodies<3>& bodies, const Matrix3& gradient, Load& load) const {
  const WettedFace& of = faces_[face];
  const auto& motion = bodies.motion[at(of.body)];
  const Corners& corners = corners_[at(of.body)];
  laws::CutSimplex<3> cut{corners_of_face(corners, of.face), {}};
  const Vector3 middle = motion.position + gradient * middle_of(cut.corner);
  const Real surface = water_.surface(middle, time);
  for (std::size_t n = 0; n < 3; ++n)
    cut.depth[n] = surface - water_.elevation(motion.position + gradient * cut.corner[n]);
  const laws::SubmergedPart part = laws::submerged_part(cut);
  if (!(part.share > 0)) return;
  const Vector3 place = part.moment / part.share, arm = gradient * place;
  const Vector3 flow = water_.motion(motion.position + arm, surface, time).velocity - motion.velocity_at(arm);
  const Real against = -(motion.rotation * outward_area(corners, of.face)).dot(flow);  // area met times the speed [m3/s]
  if (!(against > 0)) return;
  load.add(0.5 * water_.density * drag_coefficient_ * part.share * against * flow, place, gradient, motion.rotation);
}

/// How far the middle of a face is from that of the face that was behind it [m].
Real WaterLoads::apart(const WettedFace& face, const Instant& now, const state::Bodies<3>& bodies) const {
  const auto middle = [&](Index body, Index local) -> Vector3 {
    const state::StrainedPose pose = state::strained_pose_at(bodies, body, now);
    return pose.position + pose.gradient() * middle_of(corners_of_face(corners_[at(body)], local));
  };
  return (middle(face.body, face.face) - middle(face.other_body, face.other)).norm();
}

void WaterLoads::post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes&) {
  if (looks_++ % base_steps_between_looks != 0) return;
  std::vector<std::size_t> open;
  std::vector<Index> seen;
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    const WettedFace& of = faces_[face];
    if (of.other_body < 0) continue;
    const Index joint = joints_->joint_at(of.body, of.face);
    if (joint >= 0 && joints_->state(joint) != JointState::broken) continue;
    open.push_back(face);
    seen.insert(seen.end(), {of.body, of.other_body});
  }
  if (open.empty()) return;
  std::ranges::sort(seen);
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  peers.fetch(seen);
  for (const std::size_t face : open) is_washed_[face] = apart(faces_[face], now, bodies) > width_[face] ? 1 : 0;
}

void WaterLoads::add_energies(const terms::Synchronized<3>& at_time, terms::EnergySums& energies) const {
  for (Index body = 0; body < static_cast<Index>(links_.size()); ++body) {
    if (!at_time.counts(links_[at(body)])) continue;
    table_.take_back(body, links_[at(body)], at_time, energies);
    strain_table_.take_back(body, links_[at(body)], table_, at_time, energies);
  }
}

void WaterLoads::carry(Index link, Parcel& parcel) {
  parcel(table_[link]);
  strain_table_.carry(link, parcel);
}

void WaterLoads::columns(Archive& archive) {
  archive("looks", looks_);
  archive("washed", is_washed_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
}

}  // namespace sazare::methods::blocks
