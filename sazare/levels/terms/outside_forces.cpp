#include "sazare/levels/terms/outside_forces.hpp"

#include <numeric>
#include <stdexcept>

namespace sazare::terms {

namespace {

/// On the outside, the second body of a link, as slots have it.
PairForce<3> reaction(const OutsideForces::Load& load, const Vector3& centre, const Vector3& pole) {
  PairForce<3> force;
  force.add_at(centre - pole, -load.force);
  force.moment -= load.moment;
  return force;
}

}  // namespace

OutsideForces::OutsideForces(const state::Bodies<3>& bodies) : loads_(at(bodies.size())) {
  for (Index body = 0; body < bodies.size(); ++body) links_.push_back({body, Link::outside});
  table_.causes = {Cause::load};
  table_.slots.resize(loads_.size());
  table_.incidence = FixedIncidence(bodies.size(), links_);
}

std::vector<Index> OutsideForces::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void OutsideForces::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  for (const Due& link : due) {
    const Load load = now.has_begun() ? loads_[at(link.link)] : Load{};
    const PairForce<3> force = reaction(load, bodies.motion[at(link.link)].position, bodies.pole);
    write<3, 0>(table_[link.link], now, link, force, {});
  }
}

std::vector<OutsideForces::Lacking> OutsideForces::set(std::span<const Load> loads, const Instant& now,
                                                       const state::Bodies<3>& bodies) {
  if (loads.size() != loads_.size()) throw std::logic_error("outside forces: one for each body is needed");
  std::vector<Lacking> lacking;
  for (Index body = 0; body < bodies.size(); ++body) {
    const Load more{loads[at(body)].force - loads_[at(body)].force, loads[at(body)].moment - loads_[at(body)].moment};
    if (loads[at(body)] == loads_[at(body)]) continue;
    loads_[at(body)] = loads[at(body)];
    Slot<3, 0>& slot = table_[body];
    if (slot.evaluated < 0) continue;  // nothing has been kicked
    if (slot.evaluated != static_cast<Real>(now.tick)) throw std::logic_error("outside forces are given at base steps");
    const PairForce<3> force = reaction(more, state::pose_at(bodies.motion[at(body)], now).position, bodies.pole);
    slot.total += force;
    slot.previous = slot.total.as<float>();  // it is known: nothing is to be smoothed
    Lacking& of = lacking.emplace_back();
    of.body = body;
    of.impulse.linear = -slot.acting * force.linear;
    of.impulse.angular = -slot.acting * force.moment;
  }
  return lacking;
}

void OutsideForces::add_energies(const Synchronized<3>& at_time, EnergySums& energies) const {
  for (Index body = 0; body < static_cast<Index>(links_.size()); ++body)
    if (at_time.counts(links_[at(body)])) table_.take_back(body, links_[at(body)], at_time, energies);
}

void OutsideForces::carry(Index link, Parcel& parcel) {
  parcel(loads_[at(link)]);
  parcel(table_[link]);
}

void OutsideForces::columns(Archive& archive) {
  archive("loads", loads_);
  archive("slots", table_.slots);
}

}  // namespace sazare::terms
