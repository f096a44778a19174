#include "sazare/methods/blocks/true_faces/face_contacts.hpp"

#include <algorithm>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 8;  // a pair takes a microsecond or two, waking a thread some microseconds
constexpr Real same_direction = 0.7;     // cosine: beyond it two blocks touch anew
constexpr Real carried_at_once = 3;      // heavy bodies that may touch a light one, see laws/sphere_contact.hpp

}  // namespace

FaceContacts::FaceContacts(const laws::FaceOverlap& law, int edge_division, Joints& joints,
                           const geometry::ElementCorners& corners, std::span<const FreeFace> free_faces,
                           const state::Bodies<3>& bodies)
    : BlockContacts(ContactShape::faces, edge_division, joints, corners, bodies), law_(law), stars_(corners_, joints) {
  open_first(free_faces, bodies);
}

void FaceContacts::opened(const FreeFace& face, const state::Bodies<3>& bodies) {
  const Index place = surface_.place_of(face.body);
  if (blocks_.size() <= at(place)) {
    const Matrix3 turned_back = state::start_rotation(bodies, face.body).transpose();
    geometry::Tetrahedron own = corners_.of(face.body);
    for (Vector3& corner : own) corner = turned_back * (corner - bodies.start[at(face.body)]);
    Block& block = blocks_.emplace_back();
    block.solid = geometry::solid_tetrahedron(own);
    block.surface = 3 * geometry::volume(own) / block.solid.radius;
  }
  blocks_[at(place)].open |= std::int64_t{1} << face.face;
}

/// All blocks around the corners of the broken face: chains of joints may have ended with it.
void FaceContacts::add_loosened(Index joint, std::vector<Index>& loosened) const {
  const Link& link = joints_->links()[at(joint)];
  for (int face = 0; face < 4; ++face) {
    if (joints_->joint_at(link.first, face) != joint) continue;
    for (const int corner : geometry::tetrahedron_faces[static_cast<std::size_t>(face)])
      for (const Index body : stars_.around(corners_.tetrahedra[at(link.first)][static_cast<std::size_t>(corner)]))
        if (surface_.place_of(body) >= 0) loosened.push_back(body);
  }
}

std::vector<NearPair> FaceContacts::find_near(Index body, const PoseOf& pose_of) const {
  const state::Pose<3> pose = pose_of(body);
  const geometry::SolidTetrahedron own = placed(body, pose);
  std::vector<NearPair> found;
  for (const Index partner : surface_.candidates(std::span(&body, 1), pose_of)) {
    const state::Pose<3> other = pose_of(partner);
    if (!surface_.are_near(body, pose, partner, other)) continue;
    if (!(geometry::gap(own, placed(partner, other)) < surface_.skin())) continue;
    if (!stars_.hold_together(body, partner)) found.push_back({std::min(body, partner), std::max(body, partner), {}});
  }
  return found;
}

void FaceContacts::begin(Index pair, NearPair near, const PoseOf& pose_of) {
  if (faces_.size() <= at(pair)) faces_.resize(at(pair) + 1);
  faces_[at(pair)] = {};
  faces_[at(pair)].initial_depth =
      geometry::shared_depth(placed(near.first, pose_of(near.first)), placed(near.second, pose_of(near.second)));
}

Real FaceContacts::find_gap(Index pair, const state::StrainedPose& first, const state::StrainedPose& second, Clearance&) {
  const Link& link = links_[at(pair)];
  const Real gap = geometry::gap(placed(link.first, first), placed(link.second, second));
  if (gap >= 0) faces_[at(pair)] = {};
  return std::min(gap, surface_.skin());
}

void FaceContacts::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for_uneven(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& each : due.subspan(begin, end - begin)) evaluate_one(now, each, bodies);
  });
}

void FaceContacts::evaluate_one(const Instant& now, const Due& due, const state::Bodies<3>& bodies) {
  const Link& link = links_[at(due.link)];
  const ContactBody first = body(link.first, bodies), second = body(link.second, bodies);
  if (stays_apart(due.link, update_clearance(due.link, first, second, bodies))) return;
  FacePair& pair = faces_[at(due.link)];
  const state::Pose<3> from_pole{first.motion.position - bodies.pole, first.motion.rotation},
      other_from_pole{second.motion.position - bodies.pole, second.motion.rotation};
  const geometry::TetrahedronOverlap found = overlap_of(link, pair, from_pole, other_from_pole);
  const bool overlap = !found.is_empty() || pair.initial_depth > 0;
  if (found.is_empty()) {
    pair.normal = Vector3::Zero();
    pair.memory = {};
    conclude(now, due, overlap, false, {});
  } else {
    conclude(now, due, overlap, true, force(due, first, second, found, bodies.pole, pair));
  }
}

/// Overlap of a pair beyond the depth at which it rests; that becomes less as the two part.
geometry::TetrahedronOverlap FaceContacts::overlap_of(const Link& link, FacePair& pair, const state::Pose<3>& first,
                                                      const state::Pose<3>& second) const {
  if (pair.initial_depth > 0)
    pair.initial_depth =
        std::min(pair.initial_depth, geometry::shared_depth(placed(link.first, first), placed(link.second, second)));
  const Real inset = pair.initial_depth / 2;
  return geometry::overlap(placed(link.first, first, inset), placed(link.second, second, inset),
                           static_cast<geometry::FaceBits>(block(link.first).open),
                           static_cast<geometry::FaceBits>(block(link.second).open));
}

/// How many contacts the mass of a pair may have to be shared among.
Real FaceContacts::sharing(const Link& link) const {
  const std::size_t most = std::max(table_.incidence.of(link.first).size(), table_.incidence.of(link.second).size());
  return std::max(Real{1}, static_cast<Real>(most) / carried_at_once);
}

ContactForce FaceContacts::force(const Due& due, const ContactBody& first, const ContactBody& second,
                                 const geometry::TetrahedronOverlap& overlap, const Vector3& pole, FacePair& pair) const {
  const Vector3 &normal = overlap.normal, point = overlap.place + pole;
  const Vector3 arm = point - first.motion.position, other_arm = point - second.motion.position;
  const Vector3 opening = second.motion.velocity_at(other_arm) - first.motion.velocity_at(arm);
  const Real turn = 0.5 * due.acting * (first.motion.predicted_spin + second.motion.predicted_spin).dot(normal);
  if (normal.dot(pair.normal) < same_direction)
    pair.memory = {};
  else
    pair.memory.turn(normal, normal - pair.normal, turn);
  pair.normal = normal;

  const laws::SphereContact spheres = law_.over(overlap.area);
  const Vector3 elastic = law_.stiffness * overlap.push;
  laws::SphereMotion shared;
  shared.overlap = std::max(Real{0}, elastic.dot(normal)) / spheres.stiffness;
  shared.contacts = sharing(links_[at(due.link)]);
  shared.step = std::max(due.acting, 2 * due.ahead);
  shared.elapsed = due.acting;
  const auto softness = [&](const Vector3& along) { return first.softness(arm, along) + second.softness(other_arm, along); };
  const laws::SphereForce given = force_at(spheres, normal, opening, softness, shared, pair.memory);

  ContactForce sum;
  sum.dashpot.add_at(overlap.place, given.dashpot * normal);
  sum.friction.add_at(overlap.place, given.friction);
  sum.total.linear = elastic;
  sum.total.moment = law_.stiffness * overlap.turning;
  sum.total += sum.dashpot;
  sum.total += sum.friction;
  return sum;
}

/// Whatever lies within a convex block has no more surface than the block, and those of its neighbours that press on it share
/// that; half of the stiffness comes from its own faces within them and half from theirs.
terms::Rates FaceContacts::rates(Index body) const {
  Real area = 0;
  const auto pairs = table_.incidence.of(body);
  if (pairs.empty()) return {};
  const Real own = block(body).surface;
  for (const terms::SlotSide side : pairs) {
    const Link& link = links_[at(side.slot)];
    area += 0.5 * std::min(own, block(side.side == 0 ? link.second : link.first).surface);
  }
  return contact_rates(law_.over(std::min(area, own)), 1, softness_[at(body)]);
}

void FaceContacts::add_energies(const terms::Synchronized<3>& at_time, terms::EnergySums& energies) const {
  for (std::size_t pair = 0; pair < links_.size(); ++pair) {
    if (!has_energy(pair, at_time)) continue;
    const Link& link = links_[pair];
    take_back(static_cast<Index>(pair), at_time, energies);
    const Real inset = faces_[pair].initial_depth / 2;
    energies[terms::EnergyKind::elastic] +=
        law_.stiffness * geometry::overlap_weight(placed(link.first, at_time.pose_of(link.first), inset),
                                                  placed(link.second, at_time.pose_of(link.second), inset));
  }
}

void FaceContacts::carry(Index pair, Parcel& parcel) {
  parcel(faces_[at(pair)]);
  BlockContacts::carry(pair, parcel);
}

void FaceContacts::columns(Archive& archive) {
  archive("blocks", blocks_);
  archive("faces", faces_);
  BlockContacts::columns(archive);
}

}  // namespace sazare::methods::blocks
