#include "sazare/methods/mps/failing_forces.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

template <int D>
FailingForces<D>::FailingForces(const state::Particles<D>& particles, LinkTable<D> links, GroundStrength<D> strength,
                                const LooseRules& rules)
    : links_(std::move(links)),
      strength_(std::move(strength)),
      contacts_(particles, links_, rules),
      gathered_(particles, strength_, rules),
      whole_links_(particles.size(), 0),
      lost_links_(particles.size(), 0),
      work_(particles.padded(), 0) {
  for (auto* tensors : {&stretch_, &virial_})
    for (state::Column& column : *tensors) column.assign(particles.padded(), 0);
  for (state::Column& column : relief_) column.assign(particles.padded(), 0);
  for (state::Column& column : frames_) column.assign(particles.padded(), 0);
  for (Index i = 0; i < particles.count; ++i)
    for (std::size_t n = 0; n < links_.directions.size(); ++n) whole_links_[at(i)] += links_.is_present(n, i) ? 1 : 0;
}

template <int D>
void FailingForces<D>::evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  measure_stretch(links_, particles, stretch_);
  strength_.flow(particles, stretch_);
  gathered_.advance(particles, strength_);
  strength_.make_frames(particles, frames_);
  if (const std::vector<Index> broken = ruptured(); !broken.empty())
    break_ground(particles, broken);
  else if (gathered_.must_search(particles))
    gathered_.search(particles, strength_);
  evaluate_links(links_, RotationRemoval::mean_rotation, particles, frames_, pressure_, acceleration, &virial_);
  add_work_of_flow(particles);
  contacts_.evaluate(particles, links_, strength_, acceleration);
  gathered_.add_forces(particles, strength_, acceleration);
}

template <int D>
std::vector<Index> FailingForces<D>::ruptured() const {
  std::vector<Index> found;
  const auto& flowed = strength_.flowed();
  for (auto next = std::ranges::find(flowed, 1); next != flowed.end(); next = std::find(next + 1, flowed.end(), 1))
    if (const auto i = static_cast<Index>(next - flowed.begin()); strength_.is_ruptured(i)) found.push_back(i);
  return found;
}

/// Ground that has been torn apart keeps the gaps that have opened, without stress.
template <int D>
void FailingForces<D>::break_ground(const state::Particles<D>& particles, std::span<const Index> broken) {
  const auto stored = [&] {
    return energy_around(particles, broken) + contacts_.energy(particles, strength_) + gathered_.energy(strength_);
  };
  const Real before = stored();
  for (const Index particle : broken) {
    const Rotation<D> stress = strength_.stress(particles, stretch_, particle);
    if (stress.trace() < 0)
      gathered_.add(particle, stress, 0);
    else
      gathered_.add(particle, Rotation<D>::Zero(), std::max(strength_.plastic(particle).trace(), Real{0}));
  }
  for (const Index particle : broken) cut_links(particle);
  gathered_.search(particles, strength_);
  rupture_ += before - stored();
}

template <int D>
void FailingForces<D>::cut_links(Index particle) {
  for (std::size_t n = 0; n < links_.directions.size(); ++n) {
    if (!links_.is_present(n, particle)) continue;
    const Index other = links_.directions[n].neighbor[at(particle)];
    cut_.push_back({n, particle, links_.share(n, particle), links_.share(links_.opposite(n), other)});
    set_link(cut_.back(), 0, 0);
    contacts_.loosen(other);
    ++lost_links_[at(particle)];
    ++lost_links_[at(other)];
  }
  strength_.measure(particle, links_);
  contacts_.release(particle);
}

template <int D>
void FailingForces<D>::set_link(const CutLink& link, Real share, Real opposite_share) {
  const Index other = links_.directions[link.direction].neighbor[at(link.particle)];
  links_.set_share(link.direction, link.particle, share);
  links_.set_share(links_.opposite(link.direction), other, opposite_share);
  strength_.measure(other, links_);
}

/// All links are as they were at the beginning.
template <int D>
void FailingForces<D>::restore_links() {
  for (const CutLink& link : cut_) set_link(link, link.share, link.opposite_share);
  for (const CutLink& link : cut_) strength_.measure(link.particle, links_);
  cut_.clear();
  std::ranges::fill(lost_links_, 0);
}

template <int D>
void FailingForces<D>::add_work_of_flow(const state::Particles<D>& particles) {
  constexpr std::size_t serial_packs = 128;
  const auto& flow = strength_.last_flow();
  parallel::parallel_for(particles.padded() / lane_count, serial_packs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin * lane_count; first < end * lane_count; first += lane_count) {
      const auto turn = [&](std::size_t row, std::size_t column) {
        if constexpr (D == 3) return load_lanes(&particles.rotation[3 * row + column][first]);
        const Lanes part = load_lanes(&particles.rotation[row == column ? 0 : 1][first]);
        return row < column ? -part : part;
      };
      Lanes work{};
      std::size_t number = 0;
      for (std::size_t row = 0; row < D; ++row)
        for (std::size_t column = row; column < D; ++column, ++number) {
          Lanes now{};  // R^T times the virial, off the diagonal both parts that a symmetric flow moves
          for (std::size_t k = 0; k < D; ++k) {
            now += turn(k, row) * load_lanes(&virial_[D * k + column][first]);
            if (row != column) now += turn(k, column) * load_lanes(&virial_[D * k + row][first]);
          }
          Real* kept = &relief_[number][first];
          work += 0.5 * (load_lanes(kept) + now) * load_lanes(&flow[D * row + column][first]);
          store_lanes(kept, now);
        }
      store_lanes(&work_[first], work);
    }
  });
  const auto& flowed = strength_.flowed();
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (flowed[i] != 0) flow_ += work_[i];
}

/// Energy of all packs that have one of these particles or a particle that is linked with one.
template <int D>
Real FailingForces<D>::energy_around(const state::Particles<D>& particles, std::span<const Index> broken) const {
  std::set<std::size_t> packs;
  for (const Index particle : broken)
    for (const auto& direction : links_.directions)
      for (const Index one : {particle, direction.neighbor[at(particle)]}) packs.insert(at(one) / lane_count);
  Real total = 0;
  for (const std::size_t pack : packs) total += energy_of_pack(links_, particles, frames_, pack);
  return total;
}

template <int D>
Real FailingForces<D>::energy(const state::Particles<D>& particles) {
  strength_.make_frames(particles, frames_);
  return energy_of_links(links_, RotationRemoval::mean_rotation, particles, frames_) + contacts_.energy(particles, strength_) +
         gathered_.energy(strength_) + strength_.degrading().stored();
}

template <int D>
Real FailingForces<D>::broken_fraction(Index particle) const {
  const Index whole = whole_links_[at(particle)];
  return whole > 0 ? static_cast<Real>(lost_links_[at(particle)]) / static_cast<Real>(whole) : 0;
}

template <int D>
void FailingForces<D>::columns(Archive& archive) {
  archive.folder("strength", [&] { strength_.columns(archive); });
  archive("flow", flow_);
  archive("rupture", rupture_);
  for (std::size_t n = 0; n < relief_.size(); ++n) archive("relief" + std::to_string(n), relief_[n]);
  archive.folder("gathered", [&] { gathered_.columns(archive); });
  archive.folder("contacts", [&] { contacts_.columns(archive); });
  if (!archive.reading()) return;
  restore_links();  // which a run that goes back in time has cut meanwhile
  for (const Index particle : gathered_.particles()) cut_links(particle);
}

template class FailingForces<2>;
template class FailingForces<3>;

}  // namespace sazare::methods::mps
