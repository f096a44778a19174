#include "sazare/methods/blocks/charges/crack_gas.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

CrackGas::CrackGas(ChargeGas& charges, const BondedFaces& joints, GasFaces faces, const state::Bodies<3>& bodies)
    : charges_(&charges), joints_(&joints), network_(charges, std::move(faces)), rates_(at(bodies.size()), 0) {
  table_.causes = {terms::Cause::load};
  table_.incidence = terms::ChangingIncidence(bodies.size());
  for (Index number = 0; number < network_.face_count(); ++number) {
    const geometry::InteriorFace& face = network_.face(number);
    joint_of_.push_back(joints.joint_at(face.element_i, face.face_i));
  }
  strain_table_ = {bodies, 0};
  has_crack_.resize(rates_.size(), 0);
  for (Index body = 0; body < bodies.size(); ++body) softness_.push_back(largest_softness(bodies, body));
}

std::vector<Index> CrackGas::first_links() const {
  std::vector<Index> all;
  for (Index number = 0; number < static_cast<Index>(links_.size()); ++number)
    if (network_.crack(number).has_gas()) all.push_back(number);
  return all;
}

CrackGas::Faces CrackGas::faces_of(const GasCrack& crack, const state::Bodies<3>& bodies) const {
  const geometry::InteriorFace& face = network_.face_of(crack);
  const auto corners = network_.corners_of(crack);
  const Vector3 area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Vector3 centre = (corners[0] + corners[1] + corners[2]) / 3;
  const Matrix3 first = state::start_rotation(bodies, face.element_i).transpose(),
                second = state::start_rotation(bodies, face.element_j).transpose();
  return {first * area, second * area, first * (centre - bodies.start[at(face.element_i)]),
          second * (centre - bodies.start[at(face.element_j)])};
}

/// Where the points of a body are at its own time. A strained face keeps its area and its normal in the body frame.
state::StrainedPose CrackGas::pose_of(Index body, const state::Bodies<3>& bodies) const {
  const auto& motion = bodies.motion[at(body)];
  const state::Pose<3> rigid{motion.position, motion.rotation};
  if (!strain_table_.exists) return rigid;
  return {rigid, bodies.strain[at(body)].strain};
}

CrackGas::Place CrackGas::place_of(const GasCrack& crack, const Faces& faces, const state::Bodies<3>& bodies) const {
  const geometry::InteriorFace& face = network_.face_of(crack);
  const auto &first = bodies.motion[at(face.element_i)], &second = bodies.motion[at(face.element_j)];
  const state::StrainedPose own = pose_of(face.element_i, bodies), other = pose_of(face.element_j, bodies);
  Place place;
  place.first = own.position + own.gradient() * faces.first_centre;
  place.second = other.position + other.gradient() * faces.second_centre;
  const Vector3 first_area = first.rotation * faces.first_area, second_area = second.rotation * faces.second_area;
  const Vector3 normal = (first_area + second_area).normalized(), between = place.second - place.first;
  const bool face_each_other = first_area.dot(second_area) > 0.5 * first_area.squaredNorm();
  place.apart = face_each_other ? between.norm() : std::numeric_limits<Real>::infinity();
  const CrackRoom room = crack_room(charges_->charges()[at(crack.charge)].cracks.aperture, normal.dot(between));
  place.width = room.width;
  place.push = room.rate * first_area.norm() * normal;
  place.volume = room.width * first_area.norm();
  return place;
}

/// Few elements have cracks.
void CrackGas::gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<terms::Impulse<3>> sum,
                      terms::CauseImpulses<3>& parts) const {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (has_crack_[at(which[i])] != 0) table_.gather_one(now, which[i], i, sum[i], parts);
}

void CrackGas::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  parallel::parallel_for(due.size(), 128, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) move(due[i], now, bodies);
  });
}

void CrackGas::gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const {
  if (has_crack_[at(body)] != 0) strain_table_.gather(now, body, table_, sum);
}

/// The points of both bodies where a crack is pushed, in their frames and as if they were not strained.
void CrackGas::push_at(const Vector3& place, const state::StrainedPose& first, const state::StrainedPose& second,
                       Pushed& pushed) const {
  const auto point_of = [&](const state::StrainedPose& body) -> Vector3 {
    if (strain_table_.exists) return body.gradient().inverse() * (place - body.position);
    return body.rotation.transpose() * (place - body.position);
  };
  pushed.first = point_of(first);
  pushed.second = point_of(second);
}

/// Takes a crack to where its faces are now, and writes its force. The point where it was moves with both bodies: that is the
/// work, with the mean of the force before and now.
void CrackGas::move(const Due& due, const Instant& now, const state::Bodies<3>& bodies) {
  const GasCrack& crack = network_.crack(due.link);
  const Link& link = links_[at(due.link)];
  Pushed& pushed = pushed_[at(due.link)];
  const state::StrainedPose first = pose_of(link.first, bodies), second = pose_of(link.second, bodies);
  const Place place = place_of(crack, faces_[at(due.link)], bodies);
  const Vector3 parted =
      (second.position + second.gradient() * pushed.second) - (first.position + first.gradient() * pushed.first);
  const Real soon = network_.pressure(crack, place.volume, pushed.work + pushed.force.dot(parted));
  pushed.work += 0.5 * (pushed.force + soon * place.push).dot(parted);
  pushed.force = network_.pressure(crack, place.volume, pushed.work) * place.push;
  push_at(place.middle(), first, second, pushed);
  pushed.width = place.width;
  pushed.apart = place.apart;
  terms::PairForce<3> total;
  total.add_at(place.middle() - bodies.pole, pushed.force);
  if (strain_table_.exists) write_strain_force(due, pushed, bodies);
  terms::write<3, 0>(table_[due.link], now, due, total, {});
}

void CrackGas::write_strain_force(const Due& due, const Pushed& pushed, const state::Bodies<3>& bodies) {
  const auto turned_back = [&](Index body) { return Vector3(bodies.motion[at(body)].rotation.transpose() * pushed.force); };
  const Link& link = links_[at(due.link)];
  terms::StrainForces<2, 0>::Numbers on_both;
  on_both.head<6>() = -force_on_strain(turned_back(link.first), pushed.first);
  on_both.tail<6>() = force_on_strain(turned_back(link.second), pushed.second);
  strain_table_[due.link].write(table_[due.link].evaluated < 0, on_both, {});
}

void CrackGas::post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) {
  const Real span = now.seconds_since(std::exchange(last_base_, now.tick));
  exchange_news(peers);
  end_gaping_ones(changes);
  const auto tell = [&] {
    for (std::size_t charge = 0; charge < charges_->charges().size(); ++charge)
      charges_->set_taken(charge, network_.taken(charge));
  };
  tell();
  open_new(now, bodies, peers, changes);
  if (links_.empty()) return;
  network_.spread(charges_->states(now.seconds()), now.seconds(), span);
  tell();
  find_rates(changes);
}

/// Every crack that has gas was evaluated at this base step: who speaks for its first body tells the others.
void CrackGas::exchange_news(terms::Peers& peers) {
  std::vector<Told> news;
  for (const Index number : first_links()) {
    const Pushed& pushed = pushed_[at(number)];
    if (peers.owns(links_[at(number)].first)) news.push_back({number, 0, pushed.work, pushed.width, pushed.apart});
  }
  const std::vector<std::byte> all = peers.gather(std::as_bytes(std::span(news)));
  news.resize(all.size() / sizeof(Told));
  if (!news.empty()) std::memcpy(news.data(), all.data(), all.size());
  std::ranges::sort(news, {}, &Told::crack);
  for (const Told& of : news) {
    network_.change(of.crack, of.work, of.width * faces_[at(of.crack)].first_area.norm(), of.width, of.apart);
    pushed_[at(of.crack)].work = 0;
  }
}

void CrackGas::end_gaping_ones(terms::Changes& changes) {
  for (const Index number : first_links()) {
    const GasCrack& crack = network_.crack(number);
    const Real widest =
        std::min(charges_->charges()[at(crack.charge)].cut_distance, std::sqrt(faces_[at(number)].first_area.norm()));
    if (crack.apart <= widest) continue;
    network_.end(number);
    table_[number] = {};
    strain_table_.clear(number);
    for (const Index body : {links_[at(number)].first, links_[at(number)].second})
      std::erase_if(table_.incidence.list(body), [&](const terms::SlotSide& side) { return side.slot == number; });
    changes.ended_links.push_back(number);
  }
}

bool CrackGas::is_apart(Index number) const {
  const Index joint = joint_of_[at(number)];
  return joint < 0 || joints_->state(joint) == JointState::broken;
}

void CrackGas::open_new(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) {
  const Real time = now.seconds();
  const auto opening = network_.opening(charges_->states(time), time, [&](Index face) { return is_apart(face); });
  if (opening.empty()) return;
  std::vector<Index> beside;
  for (const OpeningFace& of : opening)
    for (const Index body : {network_.face(of.face).element_i, network_.face(of.face).element_j}) beside.push_back(body);
  std::ranges::sort(beside);
  beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
  peers.fetch(beside);
  for (const OpeningFace& of : opening) {
    const GasCrack crack{.face = of.face, .charge = of.charge};
    const Faces faces = faces_of(crack, bodies);
    const Place place = place_of(crack, faces, bodies);
    network_.add(of, place.volume, place.width);
    changes.new_links.push_back(static_cast<Index>(links_.size()));
    add_link(crack);
    faces_.push_back(faces);
    Pushed& pushed = pushed_.emplace_back();
    push_at(place.middle(), pose_of(links_.back().first, bodies), pose_of(links_.back().second, bodies), pushed);
    pushed.width = place.width;
    pushed.apart = place.apart;
    table_.slots.emplace_back();
    strain_table_.begin(static_cast<Index>(links_.size()) - 1);
  }
}

void CrackGas::add_link(const GasCrack& crack) {
  const geometry::InteriorFace& face = network_.face_of(crack);
  const auto number = static_cast<Index>(links_.size());
  links_.push_back({face.element_i, face.element_j});
  if (!crack.has_gas()) return;
  table_.incidence.list(face.element_i).push_back({number, 0});
  table_.incidence.list(face.element_j).push_back({number, 1});
  has_crack_[at(face.element_i)] = has_crack_[at(face.element_j)] = 1;
}

/// The gas of a crack is a spring between its faces: where they part by u, its pressure falls by m (c/V)^2 A u. What is told is
/// up to a quarter more, so that it seldom changes.
void CrackGas::find_rates(terms::Changes& changes) {
  std::vector<Index> bodies;
  for (const Link& link : links_) bodies.insert(bodies.end(), {link.first, link.second});
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (const Index body : bodies) {
    Real stiffness = 0;
    for (const terms::SlotSide side : table_.incidence.of(body)) {
      const GasCrack& crack = network_.crack(side.slot);
      if (crack.mass > 0)
        stiffness += crack.mass * crack.sound * crack.sound * faces_[at(side.slot)].first_area.squaredNorm() /
                     (crack.volume * crack.volume) * softness_[at(body)];
    }
    Real& told = rates_[at(body)];
    if (stiffness > told) {
      told = 1.25 * stiffness;
      changes.stiffer.push_back(body);
    } else if (stiffness < 0.5 * told) {
      told = 1.25 * stiffness;
      changes.softer.push_back(body);
    }
  }
}

void CrackGas::add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const {
  for (std::size_t crack = 0; crack < links_.size(); ++crack)
    if (at.counts(links_[crack])) {
      table_.take_back(static_cast<Index>(crack), links_[crack], at, energies);
      strain_table_.take_back(static_cast<Index>(crack), links_[crack], table_, at, energies);
    }
}

void CrackGas::carry(Index link, Parcel& parcel) {
  parcel(pushed_[at(link)]);
  parcel(table_[link]);
  strain_table_.carry(link, parcel);
}

void CrackGas::columns(Archive& archive) {
  archive.folder("network", [&] { network_.columns(archive); });
  archive("pushed", pushed_);
  archive("faces", faces_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
  archive("rates", rates_);
  archive("last_base", last_base_);
  if (!archive.reading()) return;
  links_.clear();
  table_.incidence = terms::ChangingIncidence(static_cast<Index>(rates_.size()));
  for (const GasCrack& crack : network_.cracks()) add_link(crack);
  for (std::size_t charge = 0; charge < charges_->charges().size(); ++charge) charges_->set_taken(charge, network_.taken(charge));
}

}  // namespace sazare::methods::blocks
