#include "sazare/methods/mps/failing_forces.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace sazare::methods::mps {

template <int D>
FailingForces<D>::FailingForces(const state::Particles<D>& particles, LinkTable<D> links, GroundStrength<D> strength,
                                const LooseRules& rules)
    : links_(std::move(links)),
      strength_(std::move(strength)),
      contacts_(particles, links_, rules),
      spacing_(particles.spacing),
      whole_links_(particles.size(), 0),
      lost_links_(particles.size(), 0) {
  for (auto* tensors : {&frames_, &stretch_})
    for (state::Column& column : *tensors) column.assign(particles.padded(), 0);
  for (Index i = 0; i < particles.count; ++i)
    for (std::size_t n = 0; n < links_.directions.size(); ++n) whole_links_[at(i)] += links_.is_present(n, i) ? 1 : 0;
}

template <int D>
void FailingForces<D>::evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  measure_stretch(links_, particles, stretch_);
  strength_.flow(particles, stretch_);
  strength_.make_frames(particles, frames_);
  break_links(particles);
  evaluate_links(links_, RotationRemoval::mean_rotation, particles, frames_, pressure_, acceleration);
  contacts_.evaluate(particles, links_, strength_, acceleration);
}

template <int D>
void FailingForces<D>::find_ruptured(Index particle, std::vector<Link>& found) const {
  for (std::size_t n = 0; n < links_.directions.size(); ++n) {
    if (!links_.is_present(n, particle)) continue;
    const Index other = links_.directions[n].neighbor[at(particle)];
    if (strength_.flowed()[at(other)] != 0 && other < particle) continue;  // the other one has found this link
    const Real slip = strength_.slip()[at(particle)] + strength_.slip()[at(other)];
    const StrengthOfGround &own = strength_.ground(particle), &others = strength_.ground(other);
    if (own.yields && others.yields && slip >= own.rupture_strain + others.rupture_strain)
      found.push_back({particle, other, static_cast<std::int64_t>(n)});
  }
}

template <int D>
void FailingForces<D>::break_links(const state::Particles<D>& particles) {
  std::vector<Link> ruptured;
  const auto& flowed = strength_.flowed();
  for (auto next = std::ranges::find(flowed, 1); next != flowed.end(); next = std::find(next + 1, flowed.end(), 1))
    find_ruptured(static_cast<Index>(next - flowed.begin()), ruptured);
  if (ruptured.empty()) return;
  const Real before = energy_around(particles, ruptured) + contacts_.energy(particles, strength_);
  for (Link& link : ruptured) {
    link.length = unstressed_length(link);
    cut(link);
  }
  rupture_ += before - energy_around(particles, ruptured) - contacts_.energy(particles, strength_);
  broken_.insert(broken_.end(), ruptured.begin(), ruptured.end());
}

template <int D>
void FailingForces<D>::cut(const Link& link) {
  links_.set_share(static_cast<std::size_t>(link.direction), link.first, 0);
  links_.set_share(links_.opposite(static_cast<std::size_t>(link.direction)), link.second, 0);
  for (const Index particle : {link.first, link.second}) {
    strength_.measure(particle, links_);
    ++lost_links_[at(particle)];
  }
  const laws::LinkDirection<D>& law = links_.directions[static_cast<std::size_t>(link.direction)].law;
  contacts_.add(link.first, link.second, link.length, share_of_column(law));
}

/// Length of the link without stress, as it began in the mean frame of its particles.
template <int D>
Real FailingForces<D>::unstressed_length(const Link& link) const {
  const auto& start = links_.directions[static_cast<std::size_t>(link.direction)].law.start;
  laws::Components<D, Real> relaxed{};
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) {
      const state::Column& frame = frames_[D * i + k];
      relaxed[i] += 0.5 * (frame[at(link.first)] + frame[at(link.second)]) * start[k];
    }
  return std::sqrt(laws::product<D, Real>(relaxed, relaxed));
}

/// Stiffness of a link over that of all links that a column has in one direction: shortened by a strain e along one axis, they
/// hold as much energy as the column's lambda + 2 mu.
template <int D>
Real FailingForces<D>::share_of_column(const laws::LinkDirection<D>& law) const {
  Real column = 0;
  for (const auto& direction : links_.directions) {
    const auto& start = direction.law.start;
    const Real square = laws::product<D, Real>(start, start), along = start[0] * start[0] / square;
    column += 0.5 * direction.law.spring * along * along * square;  // every link belongs to two particles
  }
  return law.spring * spacing_ * spacing_ / column;
}

/// Energy of all blocks that have a particle of these links.
template <int D>
Real FailingForces<D>::energy_around(const state::Particles<D>& particles, const std::vector<Link>& links) const {
  std::set<std::size_t> blocks;
  for (const Link& link : links)
    for (const Index particle : {link.first, link.second}) blocks.insert(at(particle) / lane_count);
  Real total = 0;
  for (const std::size_t block : blocks) total += energy_of_block(links_, particles, frames_, block);
  return total;
}

template <int D>
Real FailingForces<D>::energy(const state::Particles<D>& particles) {
  strength_.make_frames(particles, frames_);
  return energy_of_links(links_, RotationRemoval::mean_rotation, particles, frames_) + contacts_.energy(particles, strength_);
}

template <int D>
Real FailingForces<D>::broken_fraction(Index particle) const {
  const Index whole = whole_links_[at(particle)];
  return whole > 0 ? static_cast<Real>(lost_links_[at(particle)]) / static_cast<Real>(whole) : 0;
}

template <int D>
void FailingForces<D>::columns(Archive& archive) {
  archive.folder("strength", [&] { strength_.columns(archive); });
  archive("broken", broken_);
  archive("rupture", rupture_);
  if (archive.reading())
    for (const Link& link : broken_) cut(link);
  archive.folder("contacts", [&] { contacts_.columns(archive); });
}

template class FailingForces<2>;
template class FailingForces<3>;

}  // namespace sazare::methods::mps
