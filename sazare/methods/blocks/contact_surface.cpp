#include "sazare/methods/blocks/contact_surface.hpp"

#include <algorithm>
#include <map>

namespace sazare::methods::blocks {

namespace {

ContactSphere sphere_around_face(const geometry::Tetrahedron& corners, int face) {
  ContactSphere bound{Vector3::Zero(), 0};
  const auto& numbers = geometry::tetrahedron_faces[static_cast<std::size_t>(face)];
  const auto corner = [&](int number) -> const Vector3& { return corners[static_cast<std::size_t>(number)]; };
  for (const int number : numbers) bound.centre += corner(number) / 3;
  for (const int number : numbers) bound.radius = std::max(bound.radius, (corner(number) - bound.centre).norm());
  return bound;
}

}  // namespace

ContactSurface::ContactSurface(Index bodies, int edge_division, Real skin, ContactShape shape, bool strained)
    : edge_division_(edge_division), skin_(skin), shape_(shape), strained_(strained), open_of_(at(bodies), -1) {}

void ContactSurface::open(const FreeFace& face, const geometry::Tetrahedron& corners, const state::Pose<3>& start) {
  Index& open = open_of_[at(face.body)];
  if (open < 0) {
    open = static_cast<Index>(open_bodies_.size());
    open_bodies_.push_back(face.body);
    patches_of_.push_back({-1, -1, -1, -1});
    searched_.push_back(start);
  }
  geometry::Tetrahedron own;
  for (std::size_t corner = 0; corner < 4; ++corner)
    own[corner] = start.rotation.transpose() * (corners[corner] - start.position);
  const auto spheres = contact_spheres(own, face.face, edge_division_);
  patches_of_[at(open)][at(face.face)] = static_cast<Index>(patches_.size());
  const ContactSphere bound = shape_ == ContactShape::faces ? sphere_around_face(own, face.face) : bounding_sphere(spheres);
  patches_.push_back({face.body, static_cast<Index>(spheres_.size()), static_cast<Index>(spheres.size()), bound});
  spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
  if (!strained_) return;
  const Vector3 normal = geometry::outward_normal(own, face.face);
  for (const ContactSphere& sphere : spheres) tangent_points_.push_back(sphere.centre + sphere.radius * normal);
}

Real ContactSurface::moved(Index body, const state::StrainedPose& pose, Real reach) const {
  const auto& from = searched_[at(open_of_[at(body)])];
  return (pose.position - from.position).norm() + reach * (pose.gradient() - from.rotation).norm();
}

void ContactSurface::place_patch(Index number) {
  const Patch& patch = patches_[at(number)];
  const auto& pose = searched_[at(open_of_[at(patch.body)])];
  grid_.place(number, pose.position + pose.rotation * patch.bound.centre, patch.bound.radius);
}

void ContactSurface::place(Index body, const state::StrainedPose& pose) {
  const Index open = open_of_[at(body)];
  searched_[at(open)] = {pose.position, pose.gradient()};
  for (const Index patch : patches_of_[at(open)])
    if (patch >= 0) place_patch(patch);
}

void ContactSurface::match(const Patch& mine, const state::StrainedPose& pose, const Patch& theirs,
                           const state::StrainedPose& other, NearPair& near) const {
  const Vector3 bound = other.position + other.gradient() * theirs.bound.centre;
  for (Index i = mine.first_sphere; i < mine.first_sphere + mine.count; ++i) {
    const ContactSphere a = placed(i, pose);
    if ((bound - a.centre).norm() > a.radius + theirs.bound.radius + skin_) continue;
    for (Index j = theirs.first_sphere; j < theirs.first_sphere + theirs.count; ++j) {
      const ContactSphere b = placed(j, other);
      const Real overlap = a.radius + b.radius - (b.centre - a.centre).norm();
      if (overlap < -skin_) continue;
      const bool in_order = mine.body < theirs.body;
      near.spheres.push_back({in_order ? i : j, in_order ? j : i, std::max(overlap, Real{0}), 0, {}});
    }
  }
}

/// Calls visit(own patch, its centre, another body's patch) for all patches that may be near those of a body.
template <class Visit>
void ContactSurface::visit_near(Index body, const state::StrainedPose& pose, Visit&& visit) const {
  for (const Index number : patches_of(body)) {
    if (number < 0) continue;
    const Patch& mine = patches_[at(number)];
    const Vector3 centre = pose.position + pose.gradient() * mine.bound.centre;
    grid_.visit_near(centre, mine.bound.radius + skin_, [&](Index item) {
      if (patches_[at(item)].body != body) visit(mine, centre, patches_[at(item)]);
    });
  }
}

std::vector<Index> ContactSurface::candidates(std::span<const Index> searched, const PoseOf& pose_of) const {
  std::vector<Index> near;
  for (const Index body : searched)
    visit_near(body, pose_of(body), [&](const Patch&, const Vector3&, const Patch& theirs) { near.push_back(theirs.body); });
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

bool ContactSurface::are_near(Index body, const state::Pose<3>& pose, Index partner, const state::Pose<3>& other) const {
  const auto centre = [&](Index patch, const state::Pose<3>& at_pose) -> Vector3 {
    return at_pose.position + at_pose.rotation * patches_[at(patch)].bound.centre;
  };
  for (const Index mine : patches_of(body))
    for (const Index theirs : patches_of(partner)) {
      if (mine < 0 || theirs < 0) continue;
      const Real reach = patches_[at(mine)].bound.radius + patches_[at(theirs)].bound.radius + skin_;
      if ((centre(theirs, other) - centre(mine, pose)).squaredNorm() < reach * reach) return true;
    }
  return false;
}

std::vector<NearPair> ContactSurface::search(Index body, const std::function<bool(Index)>& skip, const PoseOf& pose_of) const {
  const state::StrainedPose pose = pose_of(body);
  std::map<Index, NearPair> by_partner;
  visit_near(body, pose, [&](const Patch& mine, const Vector3& centre, const Patch& theirs) {
    const auto& placed = searched_[at(open_of_[at(theirs.body)])];  // less than half a skin from where it is
    const Real reach = mine.bound.radius + theirs.bound.radius + 1.5 * skin_;
    if ((placed.position + placed.rotation * theirs.bound.centre - centre).squaredNorm() > reach * reach) return;
    if (skip(theirs.body)) return;
    const state::StrainedPose other = pose_of(theirs.body);
    const Vector3 apart = other.position + other.gradient() * theirs.bound.centre - centre;
    if (apart.norm() < mine.bound.radius + skin_ + theirs.bound.radius) match(mine, pose, theirs, other, by_partner[theirs.body]);
  });
  std::vector<NearPair> found;
  for (auto& [partner, near] : by_partner) {
    if (near.spheres.empty()) continue;
    near.first = std::min(body, partner);
    near.second = std::max(body, partner);
    std::ranges::sort(near.spheres, {}, [](const SpherePair& pair) { return std::pair(pair.first, pair.second); });
    found.push_back(std::move(near));
  }
  return found;
}

void ContactSurface::columns(Archive& archive) {
  archive("spheres", spheres_);
  if (strained_) archive("tangent_points", tangent_points_);
  archive("patches", patches_);
  archive("patches_of", patches_of_);
  archive("open_of", open_of_);
  archive("open_bodies", open_bodies_);
  archive("searched", searched_);
  if (!archive.reading()) return;
  grid_ = {};
  for (Index patch = 0; patch < static_cast<Index>(patches_.size()); ++patch) place_patch(patch);
}

}  // namespace sazare::methods::blocks
