#include "sazare/methods/blocks/charges/charge_gas.hpp"

#include <cstring>
#include <numeric>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::blocks {

ChargeGas::ChargeGas(std::vector<Charge> charges, std::vector<ChargedFace> faces, const state::Bodies<3>& bodies)
    : charges_(std::move(charges)),
      faces_(std::move(faces)),
      rates_(static_cast<std::size_t>(bodies.size())),
      told_(faces_.size()),
      first_delay_(std::numeric_limits<Real>::infinity()) {
  for (const ChargedFace& face : faces_) {
    links_.push_back({face.body, Link::outside});
    wetted_.push_back({.place = face.start});
  }
  for (const Charge& charge : charges_) first_delay_ = std::min(first_delay_, charge.delay);
  collars_.resize(charges_.size());
  taken_.resize(charges_.size());
  find_rates(bodies);
  sum_up();
  table_.causes = {terms::Cause::load};
  table_.slots.resize(faces_.size());
  table_.incidence = terms::FixedIncidence(bodies.size(), links_);
  strain_table_ = {bodies, faces_.size()};
}

namespace {

/// Where the centre of a face is from that of its body, and its velocity by the strain of the body, in world axes.
struct StrainedCentre {
  Vector3 arm;
  Vector3 speed = Vector3::Zero();  // [m/s]
};

StrainedCentre strained_centre(const ChargedFace& face, const Matrix3& rotation, const state::Bodies<3>& bodies) {
  if (bodies.strain.empty()) return {rotation * face.centre};
  const state::Strain& strain = bodies.strain[at(face.body)];
  return {rotation * (face.centre + tensor_of(strain.strain) * face.centre),
          rotation * (tensor_of(strain.predicted_rate) * face.centre)};
}

}  // namespace

/// Gas is a spring between the faces of its hole: where all of them move outwards by u, the pressure falls by n p A u/V. No way
/// of moving is stiffer, and the gas is never stiffer than right after its detonation.
void ChargeGas::find_rates(const state::Bodies<3>& bodies) {
  std::vector<Real> walls(charges_.size(), 0);
  for (const ChargedFace& face : faces_) walls[at(face.charge)] += face.area.norm();
  for (const ChargedFace& face : faces_) {
    const Charge& charge = charges_[at(face.charge)];
    const Real relative = charge.hole_area / charge.area;
    const Real pressure = laws::jwl_pressure(charge.gas, relative, charge.energy);
    const Real softening = laws::jwl_exponent(charge.gas, relative, charge.energy) * pressure /
                           (charge.hole_area * charge.filled.length());  // -dp/dV [Pa/m3]
    rates_[at(face.body)].stiffness += softening * walls[at(face.charge)] * face.area.norm() / bodies.inertia[at(face.body)].mass;
  }
}

std::vector<Index> ChargeGas::first_links() const {
  std::vector<Index> all(links_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void ChargeGas::evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) {
  now_ = states(now.seconds());
  news_.resize(due.size());
  parallel::parallel_for(due.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) news_[i] = {due[i].link, move(due[i], now, bodies)};
  });
}

/// Takes a face to where it is now, and writes its force.
ChargeGas::Told ChargeGas::move(const Due& due, const Instant& now, const state::Bodies<3>& bodies) {
  const ChargedFace& face = faces_[at(due.link)];
  const Charge& charge = charges_[at(face.charge)];
  Wetted& wetted = wetted_[at(due.link)];
  const auto& motion = bodies.motion[at(face.body)];
  const auto [arm, straining] = strained_centre(face, motion.rotation, bodies);
  const Vector3 place = motion.position + arm;
  if ((place - face.start).squaredNorm() > charge.cut_distance * charge.cut_distance) wetted.acts = 0;
  const Real pressure = now_[at(face.charge)].pressure;
  const Vector3 area = wetted.acts * face.part.covered_by(charge.burnt(now.seconds())) * (motion.rotation * face.area);
  const Vector3 moved = place - wetted.place;
  wetted.room -= 0.5 * (wetted.area + area).dot(moved);
  wetted.work -= 0.5 * (wetted.pressure * wetted.area + pressure * area).dot(moved);
  wetted.place = place;
  wetted.area = area;
  wetted.pressure = pressure;
  terms::PairForce<3> total;
  total.add_at(motion.position - bodies.pole + arm, pressure * area);  // on the outside, the second body
  if (strain_table_.exists) {
    const Vector6 on_body = -force_on_strain(motion.rotation.transpose() * (pressure * area), face.centre);
    strain_table_[due.link].write(table_[due.link].evaluated < 0, on_body, {});
  }
  terms::write<3, 0>(table_[due.link], now, due, total, {});
  const Real rate = -area.dot(motion.velocity_at(arm) + straining);
  return {LinearGrowth::through(now.seconds(), wetted.room, rate),
          LinearGrowth::through(now.seconds(), wetted.work, pressure * rate)};
}

/// All processes hear what the faces have told.
void ChargeGas::post_step(const Instant& now, const state::Bodies<3>&, terms::Peers& peers, terms::Changes&) {
  if (now.seconds() < first_delay_) return news_.clear();
  const std::vector<std::byte> all = peers.gather(std::as_bytes(std::span(news_)));
  news_.resize(all.size() / sizeof(ToldBy));
  if (!news_.empty()) std::memcpy(news_.data(), all.data(), all.size());
  take(news_);
  news_.clear();
  step_collars(now.seconds());
}

void ChargeGas::step_collars(Real time) {
  for (std::size_t i = 0; i < charges_.size(); ++i) {
    const Charge& charge = charges_[i];
    if (!charge.collar.vents) continue;
    if (!charge.reaches_collar(time)) {
      collars_[i].time = time;
      continue;
    }
    const ChargeState gas = state(i, time);
    step(charge.collar, collars_[i], {gas.pressure, gas.volume, gas.energy(), gas.mass, 1 + charge.gas.omega}, time);
  }
}

void ChargeGas::take(std::span<const ToldBy> news) {
  std::vector<bool> changed(charges_.size(), false);
  for (const ToldBy& of : news) {
    const std::size_t charge = at(faces_[at(of.face)].charge);
    Told& told = told_[at(of.face)];
    sums_[charge].exact_room.replace(told.room, of.told.room);
    sums_[charge].exact_work.replace(told.work, of.told.work);
    told = of.told;
    changed[charge] = true;
  }
  for (std::size_t charge = 0; charge < charges_.size(); ++charge)
    if (changed[charge]) sums_[charge].find_values();
}

void ChargeGas::sum_up() {
  sums_.assign(charges_.size(), {});
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    Sums& sums = sums_[at(faces_[face].charge)];
    sums.exact_room.replace({}, told_[face].room);
    sums.exact_work.replace({}, told_[face].work);
  }
  for (Sums& sums : sums_) sums.find_values();
}

ChargeState ChargeGas::state(std::size_t charge, Real time) const {
  return charge_state(charges_[charge], collars_[charge].at(time), taken_[charge], sums_[charge].room.at(time),
                      sums_[charge].work.at(time));
}

std::vector<ChargeState> ChargeGas::states(Real time) const {
  std::vector<ChargeState> found;
  for (std::size_t charge = 0; charge < charges_.size(); ++charge) found.push_back(state(charge, time));
  return found;
}

void ChargeGas::add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const {
  for (std::size_t face = 0; face < faces_.size(); ++face)
    if (at.counts(links_[face])) {
      table_.take_back(static_cast<Index>(face), links_[face], at, energies);
      strain_table_.take_back(static_cast<Index>(face), links_[face], table_, at, energies);
    }
}

void ChargeGas::carry(Index link, Parcel& parcel) {
  parcel(wetted_[at(link)]);
  parcel(table_[link]);
  strain_table_.carry(link, parcel);
}

void ChargeGas::columns(Archive& archive) {
  archive("wetted", wetted_);
  archive("told", told_);
  archive("collars", collars_);
  archive("slots", table_.slots);
  strain_table_.columns(archive);
  if (archive.reading()) sum_up();
}

}  // namespace sazare::methods::blocks
