#include "sazare/methods/mps/loose_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 64;  // pairs
constexpr Real skin = 0.25;               // of the spacing
constexpr std::uint8_t inner = 0, loose = 1, released = 2;
template <int D>
constexpr Real contacts_around = D == 2 ? 6 : 12;  // of equal discs or spheres

template <int D>
Angular<D> spin_of(const state::Particles<D>& particles, Index particle) {
  Angular<D> spin;
  for (int axis = 0; axis < angular_dimension<D>; ++axis)
    spin[axis] = particles.velocity[static_cast<std::size_t>(D + axis)][at(particle)];
  return spin;
}

/// Stiffness of a pair [N/m; N/m2 in 2-D].
template <int D>
Real stiffness_of(const state::Particles<D>& particles, const StrengthOfGround& a, const StrengthOfGround& b) {
  const Real modulus = 0.5 * (a.elastic.lame + b.elastic.lame) + a.elastic.shear_modulus + b.elastic.shear_modulus;
  return D == 2 ? modulus : modulus * particles.spacing;
}

template <int D>
bool are_linked(const LinkTable<D>& links, Index first, Index second) {
  for (std::size_t n = 0; n < links.directions.size(); ++n)
    if (links.directions[n].neighbor[at(first)] == second && links.is_present(n, first)) return true;
  return false;
}

}  // namespace

template <int D>
LooseContacts<D>::LooseContacts(const state::Particles<D>& particles, const LinkTable<D>& links, const LooseRules& rules)
    : rules_(rules), loose_(particles.size(), inner), grid_(rules.period, particles.spacing) {
  for (Index i = 0; i < particles.count; ++i)
    for (std::size_t n = 0; n < links.directions.size(); ++n)
      if (!links.is_present(n, i)) loose_[at(i)] = loose;
  search(particles, links);
}

template <int D>
Vector<D> LooseContacts<D>::apart(const state::Particles<D>& particles, Index first, Index second) const {
  return mps::apart<D>(rules_.period, particles.start, particles.displacement, first, second);
}

template <int D>
void LooseContacts<D>::loosen(Index particle) {
  if (loose_[at(particle)] == inner) loose_[at(particle)] = loose;
}

template <int D>
void LooseContacts<D>::release(Index particle) {
  loose_[at(particle)] = released;
  std::erase_if(pairs_, [&](const Pair& pair) { return pair.first == particle || pair.second == particle; });
}

template <int D>
void LooseContacts<D>::find_near(const state::Particles<D>& particles, const LinkTable<D>& links, Index particle,
                                 std::vector<Pair>& found) const {
  const Real reach = (1 + skin) * particles.spacing;
  const Vector<D> place = vector_of<D>(particles.start, particle) + vector_of<D>(particles.displacement, particle);
  grid_.visit_near(place, reach, [&](Index other) {
    if (other == particle || loose_[at(other)] == released) return;
    if (loose_[at(other)] == loose && other < particle) return;  // the other one finds this pair
    if (apart(particles, particle, other).norm() > reach || are_linked(links, particle, other)) return;
    found.push_back({std::min(particle, other), std::max(particle, other), {}, Vector3::Zero()});
  });
}

template <int D>
void LooseContacts<D>::search(const state::Particles<D>& particles, const LinkTable<D>& links) {
  grid_.place(particles.start, particles.displacement, particles.count);
  std::vector<Pair> found;
  for (Index i = 0; i < particles.count; ++i)
    if (loose_[at(i)] == loose) find_near(particles, links, i, found);
  const auto key = [](const Pair& pair) { return std::tie(pair.first, pair.second); };
  std::ranges::stable_sort(found, {}, key);  // of two equal ones that which was there before stays
  const auto same = [&](const Pair& a, const Pair& b) { return key(a) == key(b); };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  auto old = pairs_.begin();
  for (Pair& pair : found) {
    while (old != pairs_.end() && key(*old) < key(pair)) ++old;
    if (old != pairs_.end() && same(*old, pair)) pair = *old;
  }
  pairs_ = std::move(found);
  searched_at_ = particles.displacement;
}

template <int D>
typename LooseContacts<D>::Force LooseContacts<D>::force(const state::Particles<D>& particles, const GroundStrength<D>& strength,
                                                         Pair& pair) const {
  Force result;
  const Vector<D> way = apart(particles, pair.first, pair.second);
  const Real distance = way.norm(), overlap = particles.spacing - distance;
  if (!(overlap > 0)) {
    pair.memory = {};
    pair.inelastic.setZero();
    return result;
  }
  const StrengthOfGround &a = strength.ground(pair.first), &b = strength.ground(pair.second);
  const Vector<D> normal = way / distance;
  result.touches = true;
  result.arm = 0.5 * distance * normal;
  const Real masses = particles.inverse_mass[at(pair.first)] + particles.inverse_mass[at(pair.second)];
  const Real inertias = particles.inverse_inertia[at(pair.first)] + particles.inverse_inertia[at(pair.second)];
  const Angular<D> spin = spin_of(particles, pair.first) + spin_of(particles, pair.second);
  const Vector<D> moving = velocity_of(particles, pair.second) - velocity_of(particles, pair.first),
                  parting = moving - turned(spin, result.arm);
  laws::SphereMotion motion;
  motion.overlap = overlap;
  motion.opening_speed = parting.dot(normal);
  motion.sliding = in_space<D>(parting - motion.opening_speed * normal);
  motion.normal_mass = 1 / masses;
  motion.sliding_mass = 1 / (masses + result.arm.squaredNorm() * inertias);
  motion.contacts = contacts_around<D>;
  motion.step = motion.elapsed = rules_.step;
  laws::SphereContact law;
  law.stiffness = stiffness_of(particles, a, b);
  law.damping = 2 * rules_.damping_ratio * std::sqrt(law.stiffness * motion.normal_mass);
  law.friction = std::min(a.residual_strength().tan_friction, b.residual_strength().tan_friction);
  Real turn = 0;
  if constexpr (D == 3) turn = 0.5 * rules_.step * spin.dot(normal);
  pair.memory.turn(in_space<D>(normal), in_space<D>(rules_.step / distance * moving), turn);
  const laws::SphereForce push = laws::sphere_force(law, motion, pair.memory);
  result.on_second = (push.elastic + push.dashpot) * normal + push.friction.template head<D>();
  // In a step the mean of the forces at its ends does work, as the stepper counts it.
  const Vector3 inelastic = push.dashpot * in_space<D>(normal) + push.friction;
  result.loss = -0.5 * rules_.step * in_space<D>(parting).dot(inelastic + pair.inelastic);
  pair.inelastic = inelastic;
  return result;
}

template <int D>
void LooseContacts<D>::evaluate(const state::Particles<D>& particles, const LinkTable<D>& links,
                                const GroundStrength<D>& strength, state::FreedomColumns<D>& acceleration) {
  if (some_moved<D>(particles, searched_at_, 0.5 * skin * particles.spacing)) search(particles, links);
  forces_.resize(pairs_.size());
  parallel::parallel_for(pairs_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) forces_[n] = force(particles, strength, pairs_[n]);
  });
  touching_ = 0;
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const Force& push = forces_[n];
    if (!push.touches) continue;
    const std::size_t first = at(pairs_[n].first), second = at(pairs_[n].second);
    const Angular<D> torque = -moment(push.arm, push.on_second);  // the same on both: arms and forces are opposite
    for (std::size_t axis = 0; axis < D; ++axis) {
      acceleration[axis][first] -= push.on_second[static_cast<int>(axis)] * particles.inverse_mass[first];
      acceleration[axis][second] += push.on_second[static_cast<int>(axis)] * particles.inverse_mass[second];
    }
    for (std::size_t axis = D; axis < acceleration.size(); ++axis) {
      acceleration[axis][first] += torque[static_cast<int>(axis - D)] * particles.inverse_inertia[first];
      acceleration[axis][second] += torque[static_cast<int>(axis - D)] * particles.inverse_inertia[second];
    }
    dissipated_ += push.loss;
    ++touching_;
  }
}

template <int D>
Real LooseContacts<D>::energy_of(const state::Particles<D>& particles, const GroundStrength<D>& strength,
                                 const Pair& pair) const {
  const Real overlap = std::max(particles.spacing - apart(particles, pair.first, pair.second).norm(), Real{0});
  return 0.5 * stiffness_of(particles, strength.ground(pair.first), strength.ground(pair.second)) * overlap *
         overlap;
}

template <int D>
Real LooseContacts<D>::energy(const state::Particles<D>& particles, const GroundStrength<D>& strength) const {
  Real total = 0;
  for (const Pair& pair : pairs_) total += energy_of(particles, strength, pair);
  return total;
}

template <int D>
void LooseContacts<D>::columns(Archive& archive) {
  archive("loose", loose_);
  archive("pairs", pairs_);
  for (std::size_t axis = 0; axis < D; ++axis) archive("searched_at" + std::to_string(axis), searched_at_[axis]);
  archive("dissipated", dissipated_);
}

template class LooseContacts<2>;
template class LooseContacts<3>;

}  // namespace sazare::methods::mps
