#include "sazare/methods/blocks/contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sazare/methods/blocks/contact_kernel.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 64;
constexpr int base_steps_between_searches = 8;
constexpr Real skin_of_radius = 0.15;  // of the median inscribed radius: few false neighbours, few searches (measured)

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

Real inscribed_radius(const geometry::Tetrahedron& corners) {
  Real area = 0;
  for (int face = 0; face < 4; ++face) area += geometry::face_area(corners, face);
  return 3 * geometry::volume(corners) / area;
}

Real choose_skin(const std::vector<geometry::Tetrahedron>& corners) {
  std::vector<Real> radii;
  for (const auto& body : corners) radii.push_back(inscribed_radius(body));
  if (radii.empty()) return 0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return skin_of_radius * *middle;
}

}  // namespace

Contacts::Contacts(const laws::SphereContact& law, int edge_division, Joints& joints,
                   std::vector<geometry::Tetrahedron> corners, std::span<const FreeFace> free_faces,
                   const state::Bodies<3>& bodies)
    : law_(law), joints_(&joints), corners_(std::move(corners)),
      surface_(bodies.size(), edge_division, choose_skin(corners_)) {
  table_.incidence = terms::ChangingIncidence(bodies.size());
  fed_.assign(corners_.size(), -1);
  for (std::size_t body = 0; body < corners_.size(); ++body) {
    const auto& inertia = bodies.inertia[body];
    reach_.push_back(bodies.reach[body]);
    softness_.push_back(1 / inertia.mass + reach_.back() * reach_.back() * inertia.inverse_moments.maxCoeff());
  }
  for (const FreeFace& face : free_faces) open_face(face, bodies);
  terms::Changes ignored;
  const std::vector<Index> all(surface_.bodies().begin(), surface_.bodies().end());
  search(all, false, Moment{}, bodies, ignored);
}

std::vector<Index> Contacts::first_links() const {
  std::vector<Index> active;
  for (std::size_t pair = 0; pair < links_.size(); ++pair)
    if (!is_idle(links_[pair])) active.push_back(static_cast<Index>(pair));
  return active;
}

void Contacts::evaluate(const Moment& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (const Due& given : due.subspan(begin, end - begin)) evaluate_pair(now, given, bodies);
  });
}

void Contacts::evaluate_pair(const Moment& now, const Due& due, const state::Bodies<3>& bodies) {
  const Link& link = links_[at(due.link)];
  const auto body = [&](Index number) {
    const auto& motion = bodies.motion[at(number)];
    return ContactBody{motion, bodies.inertia[at(number)], state::pose_at(motion, now)};
  };
  const ContactBody first = body(link.first), second = body(link.second);
  Clearance& clearance = clearance_[at(due.link)];
  if (clearance.holds(first.pose, second.pose, reach_[at(link.first)], reach_[at(link.second)])) return;

  thread_local std::vector<std::pair<SphereTouch, Real>> touching;
  touching.clear();
  Real nearest = surface_.skin();
  for (SpherePair& pair : spheres_[at(due.link)]) {
    const SphereTouch touched = touch(surface_.sphere(pair.first), surface_.sphere(pair.second), first.pose, second.pose);
    nearest = std::min(nearest, -touched.overlap);
    if (touched.overlap < pair.rest) pair.rest = std::max(touched.overlap, Real{0});
    if (touched.overlap > pair.rest) touching.emplace_back(touched, touched.overlap - pair.rest);
  }
  clearance = {nearest, second.pose.position - first.pose.position, first.pose.rotation, second.pose.rotation};
  if (touching.empty()) return;

  const auto longest = std::max(first.motion.due - first.motion.last_kick, second.motion.due - second.motion.last_kick);
  const Real step = std::max(static_cast<Real>(longest) * now.tick_seconds, due.acting);
  ContactImpulse on_first, on_second;
  for (const auto& [touched, pressed] : touching)
    add_touch(law_, touched, pressed, step * static_cast<Real>(touching.size()), due.acting, first, second, on_first, on_second);
  auto& slot = table_[due.link];
  if (terms::deposit<3, 2>(slot, 0, first.motion, now, due, {on_first.total, {on_first.dashpot, on_first.friction}}))
    struck_.add(link.first);
  if (terms::deposit<3, 2>(slot, 1, second.motion, now, due, {on_second.total, {on_second.dashpot, on_second.friction}}))
    struck_.add(link.second);
  terms::mark(slot, now, due);
  for (const Index of : {link.first, link.second}) std::atomic_ref(fed_[at(of)]).store(now.tick, std::memory_order_relaxed);
}

/// Few blocks touch others: those that have not been fed since their last kick are passed over.
void Contacts::gather(const Moment& now, std::span<const Index> which, const state::Bodies<3>& bodies,
                      std::span<state::Impulse<3>> sum) const {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (fed_[at(which[i])] > bodies.motion[at(which[i])].last_kick)
      table_.gather(now, which.subspan(i, 1), bodies, sum.subspan(i, 1));
}

void Contacts::book(std::span<const Index> which, std::span<const Tick> previous_kick,
                    std::span<const state::MeanMotion<3>> mean) {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (fed_[at(which[i])] > previous_kick[i])
      table_.book(which.subspan(i, 1), previous_kick.subspan(i, 1), mean.subspan(i, 1));
}

void Contacts::open_face(const FreeFace& face, const state::Bodies<3>& bodies) {
  surface_.open(face, corners_[at(face.body)], {bodies.start[at(face.body)], bodies.start_rotation[at(face.body)]});
}

void Contacts::settle(const Moment& now, std::span<const Due>, const state::Bodies<3>& bodies, terms::Changes& changes) {
  changes.struck = struck_.take();
  for (const Index pair : ending_) links_[at(pair)] = {};
  idle_.insert(idle_.end(), ending_.begin(), ending_.end());
  ending_.clear();
  const std::vector<Index> broken = joints_->take_broken();
  if (broken.empty()) return;
  std::vector<Index> opened;
  for (const Index number : broken) {
    const Link& joint = joints_->links()[at(number)];
    for (const Index body : {joint.first, joint.second}) {
      opened.push_back(body);
      for (int face = 0; face < 4; ++face)
        if (joints_->joint_at(body, face) == number) open_face({body, face}, bodies);
    }
  }
  std::ranges::sort(opened);
  opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
  search(opened, false, now, bodies, changes);
}

void Contacts::settle_base(const Moment& now, const state::Bodies<3>& bodies, terms::Changes& changes) {
  if (++base_steps_ % base_steps_between_searches != 0) return;
  std::vector<Index> moved;
  for (const Index body : surface_.bodies())
    if (surface_.moved(body, state::pose_at(bodies.motion[at(body)], now), reach_[at(body)]) > surface_.skin() / 3)
      moved.push_back(body);
  if (moved.empty()) return;
  std::ranges::sort(moved);
  search(moved, true, now, bodies, changes);
}

void Contacts::search(std::span<const Index> which, bool may_end, const Moment& now, const state::Bodies<3>& bodies,
                      terms::Changes& changes) {
  for (const Index body : which) surface_.place(body, state::pose_at(bodies.motion[at(body)], now));
  for (const Index body : which) {
    auto found = surface_.search(body, [&](Index partner) { return joints_->bonded(body, partner); });
    merge(body, std::move(found), may_end, changes);
  }
}

/// Brings the pairs of a body up to what has been found near it; both lists rise by partner.
void Contacts::merge(Index body, std::vector<NearPair> found, bool may_end, terms::Changes& changes) {
  const auto listed = table_.incidence.of(body);
  std::vector<Index> gone;
  for (const terms::SlotSide side : listed) {
    const Link& link = links_[at(side.slot)];
    const auto near = std::ranges::find_if(
        found, [&](const NearPair& pair) { return pair.first == link.first && pair.second == link.second; });
    if (near == found.end())
      gone.push_back(side.slot);
    else
      changes.stiffer.insert(changes.stiffer.end(), {link.first, link.second});
  }
  for (NearPair& near : found) {
    const Index pair = pair_of(near.first, near.second);
    if (pair < 0) {
      begin_pair(std::move(near), changes);
      continue;
    }
    for (SpherePair& sphere : near.spheres)  // known spheres keep their memory
      for (const SpherePair& known : spheres_[at(pair)])
        if (known.first == sphere.first && known.second == sphere.second) sphere.rest = known.rest;
    spheres_[at(pair)] = std::move(near.spheres);
    clearance_[at(pair)].gap = 0;
  }
  if (!may_end) return;
  for (const Index pair : gone) end_pair(pair, changes);
}

Index Contacts::pair_of(Index first, Index second) const {
  for (const terms::SlotSide side : table_.incidence.of(first)) {
    const Link& link = links_[at(side.slot)];
    if (link.first == first && link.second == second) return side.slot;
  }
  return -1;
}

void Contacts::list_side(Index body, terms::SlotSide side) {
  auto& list = table_.incidence.list(body);
  const auto partner = [&](const terms::SlotSide& of) {
    const Link& link = links_[at(of.slot)];
    return of.side == 0 ? link.second : link.first;
  };
  list.insert(std::ranges::lower_bound(list, partner(side), {}, partner), side);
}

void Contacts::begin_pair(NearPair near, terms::Changes& changes) {
  Index pair = static_cast<Index>(links_.size());
  if (idle_.empty()) {
    links_.emplace_back();
    spheres_.emplace_back();
    clearance_.emplace_back();
    table_.slots.emplace_back();
  } else {
    pair = idle_.back();
    idle_.pop_back();
    table_[pair] = {};
  }
  links_[at(pair)] = {near.first, near.second};
  spheres_[at(pair)] = std::move(near.spheres);
  clearance_[at(pair)].gap = 0;
  list_side(near.first, {pair, 0});
  list_side(near.second, {pair, 1});
  changes.new_links.push_back(pair);
  changes.stiffer.insert(changes.stiffer.end(), {near.first, near.second});
}

void Contacts::end_pair(Index pair, terms::Changes& changes) {
  const Link link = links_[at(pair)];
  for (const Index body : {link.first, link.second}) {
    std::erase_if(table_.incidence.list(body), [&](const terms::SlotSide& side) { return side.slot == pair; });
    changes.softer.push_back(body);
  }
  for (const auto& work : table_[pair].work)
    for (std::size_t cause = 0; cause < ended_work_.size(); ++cause) ended_work_[cause] += work[cause];
  table_[pair] = {};
  spheres_[at(pair)].clear();
  changes.ended_links.push_back(pair);
  ending_.push_back(pair);
}

terms::Rates Contacts::rates(Index body) const {
  terms::Rates sum;
  for (const terms::SlotSide side : table_.incidence.of(body)) {
    const auto count = static_cast<Real>(spheres_[at(side.slot)].size());
    Real damping = 0;  // the step's cap needs no smaller step
    if (law_.cap == laws::DampingCap::literal) damping = law_.damping;
    if (law_.cap == laws::DampingCap::critical)
      damping = std::min(law_.damping, 2 * std::sqrt(law_.stiffness / softness_[at(body)]));
    sum += {count * law_.stiffness * softness_[at(body)], count * damping * softness_[at(body)]};
  }
  return sum;
}

void Contacts::add_energies(const terms::Synchronized<3>& at_time, terms::Ledger& ledger) const {
  std::array<Real, 2> work = ended_work_;
  for (std::size_t pair = 0; pair < links_.size(); ++pair) {
    const Link& link = links_[pair];
    if (is_idle(link)) continue;
    for (const int cause : {dashpot, friction})
      work[static_cast<std::size_t>(cause)] += table_.work_until(static_cast<Index>(pair), link, cause, at_time);
    for (const SpherePair& sphere : spheres_[pair]) {
      const SphereTouch touched = touch(surface_.sphere(sphere.first), surface_.sphere(sphere.second),
                                        at_time.pose_of(link.first), at_time.pose_of(link.second));
      if (touched.overlap > sphere.rest)
        ledger[terms::Account::elastic] += laws::sphere_energy(law_, touched.overlap - sphere.rest);
    }
  }
  ledger[terms::Account::contact_dashpot] -= work[dashpot];
  ledger[terms::Account::friction] -= work[friction];
}

void Contacts::columns(Archive& archive) {
  std::vector<SpherePair> flat;
  std::vector<Index> counts;
  for (const auto& pairs : spheres_) {
    flat.insert(flat.end(), pairs.begin(), pairs.end());
    counts.push_back(static_cast<Index>(pairs.size()));
  }
  std::vector<Real> ended(ended_work_.begin(), ended_work_.end());
  archive("links", links_);
  archive("spheres", flat);
  archive("counts", counts);
  archive("idle", idle_);
  archive("ending", ending_);
  archive("slots", table_.slots);
  archive("ended_work", ended);
  archive("base_steps", base_steps_);
  archive("fed", fed_);
  archive.folder("surface", [&] { surface_.columns(archive); });
  if (!archive.reading()) return;
  std::copy(ended.begin(), ended.end(), ended_work_.begin());
  spheres_.assign(counts.size(), {});
  clearance_.assign(counts.size(), {});
  auto next = flat.begin();
  for (std::size_t pair = 0; pair < counts.size(); ++pair) {
    spheres_[pair].assign(next, next + counts[pair]);
    next += counts[pair];
  }
  table_.incidence = terms::ChangingIncidence(static_cast<Index>(corners_.size()));
  for (Index pair = 0; pair < static_cast<Index>(links_.size()); ++pair) {
    if (is_idle(links_[at(pair)])) continue;
    list_side(links_[at(pair)].first, {pair, 0});
    list_side(links_[at(pair)].second, {pair, 1});
  }
}

}  // namespace sazare::methods::blocks
