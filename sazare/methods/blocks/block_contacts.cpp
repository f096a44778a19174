#include "sazare/methods/blocks/block_contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "sazare/geometry/tetrahedron_overlap.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t searched_alone_below = 4;  // bodies; a search takes some microseconds
constexpr int base_steps_between_searches = 8;
constexpr Real skin_of_radius = 0.15;  // of the median inscribed radius: few false neighbours, few searches (measured)

// A clearance is good for so much of the skin. The less, the fewer spheres are looked at that do not touch, and the more often it
// is measured anew, which takes longer than many evaluations.
constexpr Real largest_move = 1.0 / 32, smallest_move = 1.0 / 1024;
constexpr Real usual_evaluations = 80;  // between two measurements

// Strain moves the centre of a sphere as it moves the point where the sphere touches its face, as far as its radius from the
// centre; and no inscribed sphere is larger than a third of the reach.
constexpr Real reach_with_radius = 4.0 / 3;

Real choose_skin(const geometry::ElementCorners& corners) {
  std::vector<Real> radii;
  for (std::size_t body = 0; body < corners.tetrahedra.size(); ++body)
    radii.push_back(geometry::solid_tetrahedron(corners.of(static_cast<Index>(body))).radius);
  if (radii.empty()) return 0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return skin_of_radius * *middle;
}

}  // namespace

BlockContacts::BlockContacts(ContactShape shape, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
                             const state::Bodies<3>& bodies)
    : joints_(&joints),
      corners_(corners),
      strain_table_(shape == ContactShape::spheres ? terms::StrainTable<2, 2>(bodies, 0) : terms::StrainTable<2, 2>()),
      reach_of_spheres_(follows_strains() ? reach_with_radius : 1),
      surface_(bodies.size(), edge_division, choose_skin(corners_), shape, follows_strains()) {
  table_.causes = {terms::Cause::contact_dashpot, terms::Cause::friction};
  table_.incidence = terms::ChangingIncidence(bodies.size());
  touching_.assign(bodies.inertia.size(), 0);
  softness_.reserve(bodies.inertia.size());
  for (Index body = 0; body < bodies.size(); ++body) softness_.push_back(static_cast<float>(largest_softness(bodies, body)));
}

void BlockContacts::open_first(std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies) {
  for (const FreeFace& face : free_faces) open_face(face, bodies);
  terms::Changes ignored;
  const std::vector<Index> all(surface_.bodies().begin(), surface_.bodies().end());
  search(all, false, Instant{}, bodies, ignored);
}

std::vector<Index> BlockContacts::first_links() const {
  std::vector<Index> active;
  for (std::size_t pair = 0; pair < links_.size(); ++pair)
    if (!is_idle(links_[pair])) active.push_back(static_cast<Index>(pair));
  return active;
}

void BlockContacts::conclude(const Instant& now, const Due& due, bool overlap, bool touches, const ContactForce& force) {
  auto& slot = table_[due.link];
  if (!overlap) clearance_[at(due.link)].is_known = 0;  // a gap has opened: once measured, it spares the pair for a while
  const bool did_touch = slot.evaluated >= 0;
  count_touching(links_[at(due.link)], static_cast<int>(touches) - static_cast<int>(did_touch));
  if (touches)
    terms::write<3, 2>(slot, now, due, force.total, {force.dashpot, force.friction});
  else
    clear(due.link);
}

Real BlockContacts::update_clearance(Index pair, const ContactBody& first, const ContactBody& second,
                                     const state::Bodies<3>& bodies) {
  const Link& link = links_[at(pair)];
  Clearance& clearance = clearance_[at(pair)];
  const state::StrainedPose first_pose = first.pose(), second_pose = second.pose();
  Real moved = 0;
  if (clearance.is_known)
    moved = clearance.moved(first_pose, second_pose, reach_of_spheres_ * bodies.reach[at(link.first)],
                            reach_of_spheres_ * bodies.reach[at(link.second)]);
  ++clearance.evaluations;
  const bool is_used_up = clearance.is_known && moved > clearance.good;
  const bool gap_is_used_up = table_[pair].evaluated < 0 && clearance.gap > 0 && moved >= clearance.gap;
  if (is_used_up) fit_to_motion(clearance);
  if (!clearance.is_known || gap_is_used_up || is_used_up) {
    measure(pair, first_pose, second_pose);
    moved = 0;
  }
  clearance.is_distant = are_distant(first, second, link, clearance.gap - moved, bodies);
  return moved;
}

/// The faster two bodies move against each other, the more their clearance is to be good for.
void BlockContacts::fit_to_motion(Clearance& clearance) const {
  const Real fitting = clearance.good * usual_evaluations / static_cast<Real>(clearance.evaluations);
  clearance.good = std::clamp(fitting, smallest_move * surface_.skin(), largest_move * surface_.skin());
}

/// Whether two bodies, which may still come nearer by `room`, cannot meet within two base steps; their speeds may change by as
/// much as they are, or by a little from rest.
bool BlockContacts::are_distant(const ContactBody& first, const ContactBody& second, const Link& link, Real room,
                                const state::Bodies<3>& bodies) const {
  if (!(room > surface_.skin() / 1000)) return false;
  const auto turning = [](const ContactBody& body) {
    return body.motion.spin.norm() + (body.strain == nullptr ? 0 : body.strain->rate.norm());
  };
  const Real closing = (second.motion.velocity - first.motion.velocity).norm() +
                       reach_of_spheres_ * bodies.reach[at(link.first)] * turning(first) +
                       reach_of_spheres_ * bodies.reach[at(link.second)] * turning(second);
  const Real change = surface_.skin() / 1000 + 2 * base_step_ * (first.motion.velocity.norm() + second.motion.velocity.norm());
  return room > 2 * base_step_ * closing + std::min(surface_.skin() / 100, change);
}

/// Clearance of a pair where it stands.
void BlockContacts::measure(Index pair, const state::StrainedPose& first, const state::StrainedPose& second) {
  Clearance& clearance = clearance_[at(pair)];
  clearance.is_known = 1;
  clearance.evaluations = 0;
  if (clearance.good == 0) clearance.good = smallest_move * surface_.skin();
  clearance.apart = second.position - first.position;
  clearance.first = first.gradient();
  clearance.second = second.gradient();
  clearance.gap = find_gap(pair, first, second, clearance);
}

void BlockContacts::count_touching(const Link& link, int change) {
  if (change == 0) return;
  for (const Index body : {link.first, link.second})
    std::atomic_ref(touching_[at(body)]).fetch_add(change, std::memory_order_relaxed);
}

/// Few blocks touch others.
void BlockContacts::gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&,
                           std::span<state::Impulse<3>> sum, terms::CauseImpulses<3>& parts) const {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (touching_[at(which[i])] > 0) table_.gather_one(now, which[i], i, sum[i], parts);
}

void BlockContacts::gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const {
  if (touching_[at(body)] > 0) strain_table_.gather(now, body, table_, sum);
}

/// A pair has no force any more.
void BlockContacts::clear(Index pair) {
  table_[pair] = {};
  strain_table_.clear(pair);
}

void BlockContacts::open_face(const FreeFace& face, const state::Bodies<3>& bodies) {
  surface_.open(face, corners_.of(face.body), {bodies.start[at(face.body)], state::start_rotation(bodies, face.body)});
  opened(face, bodies);
}

void BlockContacts::add_loosened(Index joint, std::vector<Index>& loosened) const {
  const Link& link = joints_->links()[at(joint)];
  loosened.insert(loosened.end(), {link.first, link.second});
}

void BlockContacts::post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) {
  for (const Index pair : ending_) links_[at(pair)] = {};
  idle_.insert(idle_.end(), ending_.begin(), ending_.end());
  ending_.clear();
  const std::vector<Index> broken = joints_->take_broken();
  if (broken.empty()) return;
  std::vector<Index> loosened;
  for (const Index number : broken) {
    const Link& joint = joints_->links()[at(number)];
    for (const Index body : {joint.first, joint.second})
      for (int face = 0; face < 4; ++face)
        if (joints_->joint_at(body, face) == number) open_face({body, face}, bodies);
  }
  for (const Index number : broken) add_loosened(number, loosened);
  std::ranges::sort(loosened);
  loosened.erase(std::unique(loosened.begin(), loosened.end()), loosened.end());
  if (!peers.alone()) {
    peers.fetch(loosened);
    peers.fetch(surface_.candidates(loosened, [&](Index body) { return pose_at(body, bodies, now); }));
  }
  search(loosened, false, now, bodies, changes);
}

void BlockContacts::post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers,
                                   terms::Changes& changes) {
  deactivate_the_distant(now, peers, changes);
  if (++base_steps_ % base_steps_between_searches != 0) return;
  peers.fetch(surface_.bodies());
  std::vector<Index> moved;
  for (const Index body : surface_.bodies())
    if (surface_.moved(body, pose_at(body, bodies, now), bodies.reach[at(body)]) > surface_.skin() / 3) moved.push_back(body);
  if (moved.empty()) return;
  std::ranges::sort(moved);
  search(moved, true, now, bodies, changes);
}

/// Makes pairs inactive that the evaluation of this base step has found too far apart to meet before the one after the next.
void BlockContacts::deactivate_the_distant(const Instant& now, terms::Peers& peers, terms::Changes& changes) {
  base_step_ = now.seconds_since(std::exchange(last_base_, now.tick));
  std::vector<Index> changed;
  for (Index pair = 0; pair < static_cast<Index>(links_.size()); ++pair) {
    const Clearance& clearance = clearance_[at(pair)];
    if (clearance.is_distant == clearance.is_inactive || is_idle(links_[at(pair)])) continue;
    if (peers.owns(links_[at(pair)].first)) changed.push_back(pair);
  }
  peers.unite(changed);
  for (const Index pair : changed) {
    Clearance& clearance = clearance_[at(pair)];
    clearance.is_inactive = !clearance.is_inactive;
    clearance.is_distant = clearance.is_inactive;
    (clearance.is_inactive ? changes.inactive : changes.watching).push_back(pair);
  }
}

void BlockContacts::search(std::span<const Index> which, bool may_end, const Instant& now, const state::Bodies<3>& bodies,
                           terms::Changes& changes) {
  const PoseOf pose_of = [&](Index body) { return pose_at(body, bodies, now); };
  for (const Index body : which) surface_.place(body, pose_of(body));
  std::vector<std::vector<NearPair>> found(which.size());
  parallel::parallel_for_uneven(which.size(), searched_alone_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) found[n] = find_near(which[n], pose_of);
  });
  for (std::size_t n = 0; n < which.size(); ++n) merge(which[n], std::move(found[n]), may_end, pose_of, changes);
}

/// Brings the pairs of a body up to what has been found near it; both lists rise by partner.
void BlockContacts::merge(Index body, std::vector<NearPair> found, bool may_end, const PoseOf& pose_of, terms::Changes& changes) {
  const auto listed = table_.incidence.of(body);
  std::vector<Index> gone;
  for (const terms::SlotSide side : listed) {
    const Link& link = links_[at(side.slot)];
    const auto near =
        std::ranges::find_if(found, [&](const NearPair& pair) { return pair.first == link.first && pair.second == link.second; });
    if (near == found.end())
      gone.push_back(side.slot);
    else
      changes.stiffer.insert(changes.stiffer.end(), {link.first, link.second});
  }
  for (NearPair& near : found) {
    const Index pair = pair_of(near.first, near.second);
    if (pair < 0) {
      begin_pair(std::move(near), pose_of, changes);
      continue;
    }
    renew(pair, std::move(near));
    if (clearance_[at(pair)].is_inactive) changes.watching.push_back(pair);  // what has been found may be near
    clearance_[at(pair)] = {};
  }
  if (!may_end) return;
  for (const Index pair : gone)  // one that the search around the other body has just begun stays: they may differ by round-off
    if (std::ranges::find(changes.new_links, pair) == changes.new_links.end()) end_pair(pair, changes);
}

Index BlockContacts::pair_of(Index first, Index second) const {
  for (const terms::SlotSide side : table_.incidence.of(first)) {
    const Link& link = links_[at(side.slot)];
    if (link.first == first && link.second == second) return side.slot;
  }
  return -1;
}

void BlockContacts::list_side(Index body, terms::SlotSide side) {
  auto& list = table_.incidence.list(body);
  const auto partner = [&](const terms::SlotSide& of) {
    const Link& link = links_[at(of.slot)];
    return of.side == 0 ? link.second : link.first;
  };
  list.insert(std::ranges::lower_bound(list, partner(side), {}, partner), side);
}

void BlockContacts::begin_pair(NearPair near, const PoseOf& pose_of, terms::Changes& changes) {
  Index pair = static_cast<Index>(links_.size());
  if (idle_.empty()) {
    links_.emplace_back();
    clearance_.emplace_back();
    table_.slots.emplace_back();
  } else {
    pair = idle_.back();
    idle_.pop_back();
    table_[pair] = {};
  }
  strain_table_.begin(pair);
  links_[at(pair)] = {near.first, near.second};
  clearance_[at(pair)] = {};
  list_side(near.first, {pair, 0});
  list_side(near.second, {pair, 1});
  changes.new_links.push_back(pair);
  changes.stiffer.insert(changes.stiffer.end(), {near.first, near.second});
  begin(pair, std::move(near), pose_of);
}

void BlockContacts::end_pair(Index pair, terms::Changes& changes) {
  const Link link = links_[at(pair)];
  for (const Index body : {link.first, link.second}) {
    std::erase_if(table_.incidence.list(body), [&](const terms::SlotSide& side) { return side.slot == pair; });
    changes.softer.push_back(body);
  }
  if (table_[pair].evaluated >= 0) count_touching(link, -1);
  clear(pair);
  end(pair);
  changes.ended_links.push_back(pair);
  ending_.push_back(pair);
}

void BlockContacts::carry(Index pair, Parcel& parcel) {
  parcel(clearance_[at(pair)]);
  parcel(table_[pair]);
  strain_table_.carry(pair, parcel);
}

void BlockContacts::carried() {
  std::ranges::fill(touching_, 0);
  for (std::size_t pair = 0; pair < links_.size(); ++pair)
    if (!is_idle(links_[pair]) && table_.slots[pair].evaluated >= 0) count_touching(links_[pair], 1);
}

void BlockContacts::columns(Archive& archive) {
  archive("links", links_);
  archive("idle", idle_);
  archive("ending", ending_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
  archive("base_steps", base_steps_);
  archive("touching", touching_);
  archive("clearance", clearance_);
  archive("last_base", last_base_);
  archive("base_step", base_step_);
  archive.folder("surface", [&] { surface_.columns(archive); });
  if (!archive.reading()) return;
  table_.incidence = terms::ChangingIncidence(static_cast<Index>(softness_.size()));
  for (Index pair = 0; pair < static_cast<Index>(links_.size()); ++pair) {
    if (is_idle(links_[at(pair)]) || std::ranges::find(ending_, pair) != ending_.end()) continue;
    list_side(links_[at(pair)].first, {pair, 0});
    list_side(links_[at(pair)].second, {pair, 1});
  }
}

}  // namespace sazare::methods::blocks
