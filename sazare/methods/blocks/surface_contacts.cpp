#include "sazare/methods/blocks/surface_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sazare/core/member_archive.hpp"
#include "sazare/geometry/facets/touching_points.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 64;

}  // namespace

SurfaceContacts::SurfaceContacts(const laws::SphereContact& law, const BlockContacts& contacts, const state::Bodies<3>& bodies)
    : law_(law), contacts_(&contacts), reach_(bodies.reach), link_of_(at(bodies.size()), -1) {
  table_.causes = {terms::Cause::contact_dashpot, terms::Cause::friction};
  table_.incidence = terms::ChangingIncidence(bodies.size());
  strain_table_ = {bodies, 0};
  for (Index body = 0; body < bodies.size(); ++body) softness_.push_back(largest_softness(bodies, body));
}

void SurfaceContacts::attach(std::vector<Vector3> nodes, std::vector<std::array<Index, 3>> faces) {
  impulse_.assign(nodes.size(), Vector3::Zero());
  surface_ = geometry::NodalSurface(std::move(nodes), std::move(faces));
  complex_ = surface_.complex();
}

void SurfaceContacts::Work::add(Real seconds, const Push& push, const Vector3& velocity) {
  total -= seconds * push.total.dot(velocity);
  dashpot -= seconds * push.dashpot.dot(velocity);
  friction -= seconds * push.friction.dot(velocity);
}

Vector3 SurfaceContacts::velocity(const Push& push) const {
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += push.shares[k] * surface_.velocity(push.nodes[k]);
  return sum;
}

SurfaceContacts::Work SurfaceContacts::work_ahead() const {
  Work work;
  for (std::size_t link = 0; link < near_.size(); ++link)
    for (const Push& push : near_[link].pushes) work.add(table_.slots[link].ahead, push, velocity(push));
  return work;
}

void SurfaceContacts::add_ahead(std::vector<Vector3>& impulse, Real sign) const {
  for (std::size_t link = 0; link < near_.size(); ++link)
    for (const Push& push : near_[link].pushes)
      for (std::size_t k = 0; k < 3; ++k)
        impulse[at(push.nodes[k])] += sign * table_.slots[link].ahead * push.shares[k] * push.total;
}

void SurfaceContacts::lead(const Instant& now, std::vector<Vector3> from, std::vector<Vector3> with) {
  const Work before = work_ahead();
  surface_.lead(0, 0, std::move(from), std::move(with));
  const Work after = work_ahead();
  work_.total += after.total - before.total;
  work_.dashpot += after.dashpot - before.dashpot;
  work_.friction += after.friction - before.friction;
  std::ranges::fill(impulse_, Vector3::Zero());
  add_ahead(impulse_, 1);
  led_ = now.tick;
}

std::vector<Vector3> SurfaceContacts::impulse() const {
  std::vector<Vector3> now = impulse_;
  add_ahead(now, -1);
  return now;
}

std::vector<Vector3> SurfaceContacts::force() const {
  std::vector<Vector3> sum(impulse_.size(), Vector3::Zero());
  for (const Near& near : near_)
    for (const Push& push : near.pushes)
      for (std::size_t k = 0; k < 3; ++k) sum[at(push.nodes[k])] += push.shares[k] * push.total;
  return sum;
}

void SurfaceContacts::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& given : due.subspan(begin, end - begin)) evaluate_one(now, given, bodies);
  });
  for (const Due& given : due)
    for (const Push& push : near_[at(given.link)].pushes) {
      work_.add(given.acting, push, velocity(push));
      for (std::size_t k = 0; k < 3; ++k) impulse_[at(push.nodes[k])] += given.acting * push.shares[k] * push.total;
    }
}

/// The faces within the radius of a sphere. Returns by how much it overlaps the nearest one.
Real SurfaceContacts::find_near(const ContactSphere& sphere, std::span<const std::int32_t> faces, Real seconds,
                                std::vector<geometry::NearFacet>& near) const {
  near.clear();
  Real deepest = 0;
  for (const std::int32_t face : faces) {
    const auto point = geometry::nearest_on(surface_.corners(static_cast<std::size_t>(face), seconds), sphere.centre);
    const Real distance = (point.place - sphere.centre).norm();
    if (!(distance < sphere.radius) || !(distance > 0) || complex_.facets()[static_cast<std::size_t>(face)].count == 0) continue;
    near.push_back({face, point, distance});
    deepest = std::max(deepest, sphere.radius - distance);
  }
  return deepest;
}

/// Where the spheres of a block press into the surface by more than their initial overlap, as spheres that are smaller by as
/// much.
void SurfaceContacts::find_met(const ContactBody& body, Near& near, Real seconds, std::vector<Met>& met) const {
  thread_local std::vector<geometry::NearFacet> faces;
  thread_local geometry::FacetPoints found;
  met.clear();
  const state::StrainedPose pose = body.pose();
  for (Sphere& one : near.spheres) {
    const ContactSphere sphere = contacts_->surface().placed(one.number, pose);
    const Vector3& centre = sphere.centre;
    const Real deepest = find_near(sphere, near.faces, seconds, faces);
    one.initial_overlap = one.is_known != 0 ? std::min(one.initial_overlap, deepest) : deepest;
    one.is_known = 1;
    const Real radius = sphere.radius - one.initial_overlap;
    std::erase_if(faces, [&](const geometry::NearFacet& face) { return !(face.distance < radius); });
    if (faces.empty()) continue;
    found.find(
        complex_, [&](Index node) { return surface_.place(node, seconds); }, centre, radius, radius, faces);
    const Vector3 tangent = body.strain != nullptr ? contacts_->surface().tangent_point(one.number) : Vector3(Vector3::Zero());
    for (const geometry::FacetPoint& point : found.points())
      met.push_back({point, radius - point.distance, one.number, centre, tangent});
  }
}

SurfaceContacts::Touch& SurfaceContacts::touch_of(const Met& met, Near& near) {
  Touch& touch =
      geometry::touching_point(near.touches, -met.point.normal, [&](const Touch& one) { return one.sphere == met.sphere; });
  touch.sphere = met.sphere;
  return touch;
}

/// Pushes the surface in one point; `shared` is what all points of the block have in common.
const SurfaceContacts::Push& SurfaceContacts::push(const ContactBody& body, const Met& met, Real seconds,
                                                   laws::SphereMotion shared, Near& near) const {
  const auto face = surface_.point(static_cast<std::size_t>(met.point.facet), seconds, met.point.place);
  const Vector3 arm = met.point.place - body.motion.position, normal = -met.point.normal;
  shared.overlap = met.overlap;
  near.elastic += met.point.count * laws::sphere_energy(law_, met.overlap);
  Push& push = near.pushes.emplace_back();
  push.nodes = face.nodes;
  push.shares = face.shares;
  push.dashpot = push.friction = Vector3::Zero();
  if (met.point.share > 0) {
    Touch& touch = touch_of(met, near);
    geometry::turn_point(touch, normal, shared.elapsed * face.spin().dot(normal));
    const laws::SphereForce given = force_at(
        law_, normal, face.velocity() - body.motion.velocity_at(arm) - body.straining(met.tangent),
        [&](const Vector3& along) { return body.softness(arm, along, met.tangent); }, shared, touch.memory);
    push.dashpot = met.point.share * given.dashpot * normal;
    push.friction = met.point.share * given.friction;
  }
  push.total = met.point.count * law_.stiffness * met.overlap * normal + push.dashpot + push.friction;
  return push;
}

/// What the block is pushed by where a point counts more or less as the centre of its sphere moves: it acts in that centre.
Vector3 SurfaceContacts::push_by_slope(const Met& met, Near& near) const {
  const Vector3 force = laws::sphere_energy(law_, met.overlap) * met.point.slope;
  near.pushes.back().total += force;
  return force;
}

void SurfaceContacts::evaluate_one(const Instant& now, const Due& due, const state::Bodies<3>& bodies) {
  const ContactBody body = this->body(links_[at(due.link)].first, bodies);
  Near& near = near_[at(due.link)];
  near.pushes.clear();
  near.elastic = 0;
  for (Touch& touch : near.touches) touch.is_touching = 0;
  thread_local std::vector<Met> met;
  find_met(body, near, time(now), met);
  laws::SphereMotion shared;
  shared.contacts = static_cast<Real>(std::ranges::count_if(met, [](const Met& one) { return one.point.share > 0; }));
  shared.step = std::max(due.acting, 2 * due.ahead);
  shared.elapsed = due.acting;
  ContactForce force;
  StrainForce on_strain;
  for (const Met& one : met) {
    const Push& given = push(body, one, time(now), shared, near);
    const Vector3 point = one.point.place - bodies.pole;
    force.dashpot.add_at(point, given.dashpot);
    force.friction.add_at(point, given.friction);
    force.total.add_at(point, given.total);
    if (!one.point.slope.isZero(0)) force.total.add_at(one.centre - bodies.pole, push_by_slope(one, near));
    if (strain_table_.exists) on_strain.add(near.pushes.back(), one.tangent, body.motion.rotation);
  }
  std::erase_if(near.touches, [](const Touch& touch) { return touch.is_touching == 0; });
  auto& slot = table_[due.link];
  if (met.empty()) return clear(due.link);
  if (strain_table_.exists)
    strain_table_[due.link].write(slot.evaluated < 0, on_strain.total, {on_strain.dashpot, on_strain.friction});
  terms::write<3, 2>(slot, now, due, force.total, {force.dashpot, force.friction});
}

/// What pushes the surface pushes the block back.
void SurfaceContacts::StrainForce::add(const Push& push, const Vector3& tangent, const Matrix3& rotation) {
  const auto on_block = [&](const Vector3& force) { return Vector6(-force_on_strain(rotation.transpose() * force, tangent)); };
  total += on_block(push.total);
  dashpot += on_block(push.dashpot);
  friction += on_block(push.friction);
}

/// A block has no force from the surface any more.
void SurfaceContacts::clear(Index link) {
  table_[link] = {};
  strain_table_.clear(link);
}

void SurfaceContacts::gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&,
                             std::span<state::Impulse<3>> sum, terms::CauseImpulses<3>& parts) const {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (const Index link = link_of_[at(which[i])]; link >= 0 && table_[link].evaluated >= 0)
      table_.gather_one(now, which[i], i, sum[i], parts);
}

void SurfaceContacts::gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const {
  if (const Index link = link_of_[at(body)]; link >= 0 && table_[link].evaluated >= 0)
    strain_table_.gather(now, body, table_, sum);
}

/// Faces that have opened may touch at once.
void SurfaceContacts::post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers&, terms::Changes& changes) {
  if (surface_.exists() && contacts_->surface().sphere_count() != known_spheres_) search(now, bodies, changes);
}

void SurfaceContacts::post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers&, terms::Changes& changes) {
  const Real step = now.seconds_since(std::exchange(last_base_, now.tick));
  if (!surface_.exists()) return;
  Real fastest = 0;
  for (const Index body : contacts_->surface().bodies()) {
    const auto& motion = bodies.motion[at(body)];
    const Real straining = strain_table_.exists ? bodies.strain[at(body)].rate.norm() : 0;
    fastest = std::max(fastest, motion.velocity.norm() + reach_[at(body)] * (motion.spin.norm() + straining));
  }
  const Real next = step * (fastest + surface_.largest_speed());
  travel_ += next;
  if (travel_ + next > 0.5 * contacts_->surface().skin()) search(now, bodies, changes);
}

/// Which spheres of which blocks are nearer to the surface than the skin.
void SurfaceContacts::search(const Instant& now, const state::Bodies<3>& bodies, terms::Changes& changes) {
  travel_ = 0;
  known_spheres_ = contacts_->surface().sphere_count();
  neighbors::SphereGrid grid;
  std::vector<geometry::Triangle> triangles;
  for (std::size_t face = 0; face < surface_.face_count(); ++face) {
    const geometry::Triangle& corners = triangles.emplace_back(surface_.corners(face, time(now)));
    const Vector3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    Real radius = 0;
    for (const Vector3& corner : corners) radius = std::max(radius, (corner - middle).norm());
    grid.place(static_cast<Index>(face), middle, radius);
  }
  for (const Index body : contacts_->surface().bodies())
    take_over(body, near_to(body, state::strained_pose_at(bodies, body, now), grid, triangles), changes);
}

/// Faces near a block, and those of its spheres that are near one of them.
SurfaceContacts::Near SurfaceContacts::near_to(Index body, const state::StrainedPose& pose, const neighbors::SphereGrid& grid,
                                               std::span<const geometry::Triangle> triangles) const {
  const ContactSurface& open = contacts_->surface();
  const Real reach = reach_[at(body)] + open.skin();
  const auto distance = [&](Index face, const Vector3& place) {
    return (geometry::nearest_point(triangles[at(face)], place) - place).norm();
  };
  Near found;
  grid.visit_near(pose.position, reach, [&](Index face) {
    if (distance(face, pose.position) <= reach) found.faces.push_back(face);
  });
  std::ranges::sort(found.faces);
  if (found.faces.empty()) return found;
  open.visit_spheres(body, [&](Index number) {
    const ContactSphere sphere = open.placed(number, pose);
    const auto is_near = [&](std::int32_t face) { return distance(face, sphere.centre) <= sphere.radius + open.skin(); };
    if (std::ranges::any_of(found.faces, is_near)) found.spheres.push_back({number, 0, 0});
  });
  return found;
}

/// Begins, goes on with or ends the link of a block with the surface.
void SurfaceContacts::take_over(Index body, Near found, terms::Changes& changes) {
  Index& link = link_of_[at(body)];
  const bool was_near = link >= 0 && near_[at(link)].is_near();
  if (!found.is_near() && !was_near) return;
  if (link < 0) {
    link = static_cast<Index>(links_.size());
    links_.push_back({body, Link::outside});
    near_.emplace_back();
    table_.slots.emplace_back();
    strain_table_.begin(link);
    table_.incidence.list(body).push_back({link, 0});
  }
  Near& near = near_[at(link)];
  if (!found.is_near()) {
    near = {};
    clear(link);
    changes.ended_links.push_back(link);
    changes.softer.push_back(body);
    return;
  }
  for (Sphere& sphere : found.spheres)  // known ones keep what they remember
    for (const Sphere& known : near.spheres)
      if (known.number == sphere.number) sphere = known;
  near.faces = std::move(found.faces);
  near.spheres = std::move(found.spheres);
  if (!was_near) changes.new_links.push_back(link);
  changes.stiffer.push_back(body);
}

terms::Rates SurfaceContacts::rates(Index body) const {
  const Index link = link_of_[at(body)];
  if (link < 0) return {};
  const auto count = static_cast<Real>(near_[at(link)].spheres.size());
  return contact_rates(law_, count, softness_[at(body)]);
}

/// Elastic energy is that of the last evaluation, at this base step. All links count: a run that is coupled is one process.
void SurfaceContacts::add_energies(const terms::Synchronized<3>& at_time, terms::EnergySums& energies) const {
  for (std::size_t link = 0; link < links_.size(); ++link) {
    table_.take_back(static_cast<Index>(link), links_[link], at_time, energies);
    strain_table_.take_back(static_cast<Index>(link), links_[link], table_, at_time, energies);
    energies[terms::EnergyKind::elastic] += near_[link].elastic;
  }
  const Work ahead = work_ahead();
  energies[terms::EnergyKind::work] += work_.total - ahead.total;
  energies[terms::EnergyKind::contact_dashpot] += work_.dashpot - ahead.dashpot;
  energies[terms::EnergyKind::friction] += work_.friction - ahead.friction;
}

void SurfaceContacts::columns(Archive& archive) {
  if (!surface_.exists()) return;
  archive.folder("nodes", [&] { surface_.columns(archive); });
  archive("led", led_);
  archive("link_of", link_of_);
  archive("links", links_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
  archive("impulse", impulse_);
  std::vector<Work> work{work_};
  archive("work", work);
  work_ = work.at(0);
  archive("last_base", last_base_);
  archive("travel", travel_);
  archive("known_spheres", known_spheres_);
  near_.resize(links_.size());
  archive_lists(archive, "faces", near_, &Near::faces);
  archive_lists(archive, "spheres", near_, &Near::spheres);
  archive_lists(archive, "touches", near_, &Near::touches);
  archive_lists(archive, "pushes", near_, &Near::pushes);
  archive_members(archive, "elastic", near_, &Near::elastic);
  if (!archive.reading()) return;
  table_.incidence = terms::ChangingIncidence(static_cast<Index>(link_of_.size()));
  for (Index link = 0; link < static_cast<Index>(links_.size()); ++link)
    table_.incidence.list(links_[at(link)].first).push_back({link, 0});
}

}  // namespace sazare::methods::blocks
