#include "sazare/methods/blocks/contacts.hpp"

#include <algorithm>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

namespace {

constexpr std::size_t serial_below = 64;  // a pair takes some 100 ns, waking a thread some microseconds

}  // namespace

Contacts::Contacts(const laws::SphereContact& law, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
                   std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies)
    : BlockContacts(ContactShape::spheres, edge_division, joints, corners, bodies), law_(law) {
  open_first(free_faces, bodies);
}

void Contacts::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for_uneven(due.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += ContactBatch::most_pairs)
      evaluate_batch(now, due.subspan(first, std::min(ContactBatch::most_pairs, end - first)), bodies);
  });
}

void Contacts::evaluate_batch(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  thread_local ContactBatch batch;
  batch.clear();
  for (const Due& each : due) {
    const Link& link = links_[at(each.link)];
    const ContactBody first = body(link.first, bodies), second = body(link.second, bodies);
    const Real moved = update_clearance(each.link, first, second, bodies);
    if (stays_apart(each.link, moved)) continue;
    batch.begin_pair(each, first, second);
    for (SpherePair& spheres : std::span(spheres_[at(each.link)]).first(at(clearance_[at(each.link)].near))) {
      if (moved < spheres.gap)
        spheres.memory = {};
      else
        batch.add(spheres);
    }
  }
  batch.evaluate(law_, surface_, bodies.pole);
  for (const ContactBatch::Pair& pair : batch.pairs()) {
    if (follows_strains() && pair.touching > 0) write_strain_force(pair.due, batch.strain_force(pair, surface_));
    conclude(now, pair.due, pair.overlap, pair.touching > 0, pair.touching > 0 ? batch.force(pair) : ContactForce{});
  }
}

std::vector<NearPair> Contacts::find_near(Index body, const PoseOf& pose_of) const {
  return surface_.search(
      body, [&](Index partner) { return joints_->bonded(body, partner); }, pose_of);
}

void Contacts::begin(Index pair, NearPair near, const PoseOf&) {
  if (spheres_.size() <= at(pair)) spheres_.resize(at(pair) + 1);
  spheres_[at(pair)] = std::move(near.spheres);
}

void Contacts::renew(Index pair, NearPair near) {
  for (SpherePair& sphere : near.spheres)  // known spheres keep their memory
    for (const SpherePair& known : spheres_[at(pair)])
      if (known.first == sphere.first && known.second == sphere.second) sphere = known;
  spheres_[at(pair)] = std::move(near.spheres);
}

/// With the gaps of all spheres. Those come first that may touch until the next time; the others forget.
Real Contacts::find_gap(Index pair, const state::StrainedPose& first, const state::StrainedPose& second, Clearance& clearance) {
  std::vector<SpherePair>& spheres = spheres_[at(pair)];
  Real gap = surface_.skin();
  const auto is_near = [&](const SpherePair& each) { return each.gap <= clearance.good; };
  for (SpherePair& each : spheres) {
    each.gap = -touch(surface_.placed(each.first, first), surface_.placed(each.second, second)).overlap;
    gap = std::min(gap, each.gap);
    if (each.gap >= 0) each.initial_overlap = 0;
    if (!is_near(each)) each.memory = {};
  }
  const auto far = std::ranges::stable_partition(spheres, is_near);
  clearance.near = static_cast<Index>(spheres.size() - far.size());
  return gap;
}

terms::Rates Contacts::rates(Index body) const {
  terms::Rates sum;
  for (const terms::SlotSide side : table_.incidence.of(body))
    sum += contact_rates(law_, static_cast<Real>(spheres_[at(side.slot)].size()), softness_[at(body)]);
  return sum;
}

void Contacts::add_energies(const terms::Synchronized<3>& at_time, terms::EnergySums& energies) const {
  for (std::size_t pair = 0; pair < links_.size(); ++pair) {
    if (!has_energy(pair, at_time)) continue;
    const Link& link = links_[pair];
    take_back(static_cast<Index>(pair), at_time, energies);
    const state::StrainedPose first = pose_at(link.first, at_time), second = pose_at(link.second, at_time);
    for (const SpherePair& sphere : spheres_[pair]) {
      const SphereTouch touched = touch(surface_.placed(sphere.first, first), surface_.placed(sphere.second, second));
      if (touched.overlap > sphere.initial_overlap)
        energies[terms::EnergyKind::elastic] += laws::sphere_energy(law_, touched.overlap - sphere.initial_overlap);
    }
  }
}

void Contacts::carry(Index pair, Parcel& parcel) {
  parcel(spheres_[at(pair)]);
  BlockContacts::carry(pair, parcel);
}

void Contacts::columns(Archive& archive) {
  std::vector<SpherePair> flat;
  std::vector<Index> counts;
  for (const auto& pairs : spheres_) {
    flat.insert(flat.end(), pairs.begin(), pairs.end());
    counts.push_back(static_cast<Index>(pairs.size()));
  }
  archive("spheres", flat);
  archive("counts", counts);
  BlockContacts::columns(archive);
  if (!archive.reading()) return;
  spheres_.assign(counts.size(), {});
  auto next = flat.begin();
  for (std::size_t pair = 0; pair < counts.size(); ++pair) {
    spheres_[pair].assign(next, next + counts[pair]);
    next += counts[pair];
  }
}

}  // namespace sazare::methods::blocks
