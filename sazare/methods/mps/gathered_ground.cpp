#include "sazare/methods/mps/gathered_ground.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "sazare/core/member_archive.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::mps {

namespace {

constexpr std::size_t serial_below = 64;  // members
constexpr Real support = 2.4;             // spacings within which neighbours are felt
constexpr Real skin = 0.4;                // of the spacing
constexpr Real least_span = 0.3;          // eigenvalue of S below which a direction is hardly spanned; 0.5 across a plane surface
constexpr Real most_stiffness = 1;        // of a particle: the largest eigenvalue of its own part of M^-1 K, times the step's square
constexpr Real opening_alone = 0.1;       // volume strain of the gaps around a particle that is alone [-]
constexpr Real nearest = 0.7;             // spacings below which weights grow no more
constexpr Real drag_share = 0.25;         // of the forces of stress that dashpots may have, over the damping ratio
constexpr Real most_damping = 0.25;       // of a particle's momentum in a step

template <int D>
Real volume_of(const state::Particles<D>& particles, const StrengthOfGround& ground, Index particle) {
  return 1 / (ground.density * particles.inverse_mass[at(particle)]);
}

Real p_wave_velocity(const StrengthOfGround& ground) {
  return std::sqrt((ground.elastic.lame + 2 * ground.elastic.shear_modulus) / ground.density);
}

/// Shape of g by the square of the distance in spacings.
Real shape(Real square) {
  const Real rest = std::max(1 - square / (support * support), Real{0});
  return rest * rest;
}

/// The factor of g with which S of a whole neighbourhood of the lattice is 1.
template <int D>
Real factor_of_lattice() {
  constexpr int reach = static_cast<int>(support), width = 2 * reach + 1;
  constexpr int count = D == 2 ? width * width : width * width * width;
  Real sum = 0;
  for (int number = 0; number < count; ++number) {
    const int x = number % width - reach, y = number / width % width - reach, z = D == 2 ? 0 : number / (width * width) - reach;
    sum += shape(x * x + y * y + z * z) * x * x;
  }
  return 1 / sum;
}

/// Smallest eigenvalue of a symmetric tensor.
template <int D>
Real smallest_eigenvalue(const Rotation<D>& tensor) {
  if constexpr (D == 2) {
    const Real difference = 0.5 * (tensor(0, 0) - tensor(1, 1));
    return 0.5 * tensor.trace() - std::sqrt(difference * difference + tensor(0, 1) * tensor(0, 1));
  }
  return Eigen::SelfAdjointEigenSolver<Rotation<D>>().computeDirect(tensor, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace

template <int D>
GatheredGround<D>::GatheredGround(const state::Particles<D>& particles, const GroundStrength<D>& strength,
                                  const LooseRules& rules)
    : rules_(rules),
      spacing_(particles.spacing),
      whole_(factor_of_lattice<D>()),
      start_(particles.start),
      member_(particles.size(), -1),
      is_cut_(particles.size(), 0),
      begin_{0},
      grid_(rules.period, particles.spacing) {
  for (Index i = 0; i < particles.count; ++i)
    is_cut_[at(i)] = volume_of<D>(particles, strength.ground(i), i) < 0.75 * particles.volume() ? 1 : 0;
  for (state::Column& column : drag_force_) column.assign(particles.size(), 0);
  searched_at_ = last_ = particles.displacement;
}

template <int D>
void GatheredGround<D>::add(Index particle, const Rotation<D>& stress, Real opening) {
  member_[at(particle)] = static_cast<Index>(members_.size());
  members_.push_back({particle, 1, 0, {stress, opening}});
}

template <int D>
std::vector<Index> GatheredGround<D>::particles() const {
  std::vector<Index> result;
  for (const Member& member : members_) result.push_back(member.particle);
  return result;
}

/// g of a neighbour [1/m2].
template <int D>
Real GatheredGround<D>::weight(Real square, Real share) const {
  return share * whole_ * shape(square / (spacing_ * spacing_)) / (spacing_ * spacing_);
}

/// `way(i)` leads to the i-th neighbour, `change(i)` is what differs from it.
template <int D>
template <class Way, class Change>
typename GatheredGround<D>::Around GatheredGround<D>::look_around(std::size_t member, Real wave_velocity, Way&& way, Change&& change) const {
  Around around;
  Real span = 0, single_span = 0;
  Rotation<D> spread = Rotation<D>::Zero(), sum = Rotation<D>::Zero(), squares = Rotation<D>::Zero();
  Vector<D> moment = Vector<D>::Zero();
  for (std::size_t n = begin_[member]; n < begin_[member + 1]; ++n) {
    const Vector<D> to = way(neighbors_[n].particle);
    const Real g = weight(to.squaredNorm(), neighbors_[n].share);
    const Vector<D> part = g * to;
    around.weights += g;
    span += g * to.squaredNorm();
    single_span += (holds(neighbors_[n].particle) ? 1.0 : 0.5) * g * to.squaredNorm();
    moment += part;
    squares += part * part.transpose();
    spread += part * to.transpose();
    sum += change(neighbors_[n].particle) * part.transpose();
  }
  constexpr Real nothing = 1e-6;
  const Real least = smallest_eigenvalue<D>(spread);
  around.is_alone = !(least > nothing);
  if (around.is_alone) return around;
  around.fade = std::min(least / least_span, Real{1});
  around.volume = span / single_span;
  around.inverse = spread.inverse();
  around.gradient = sum * around.inverse;
  // What the gradient is per displacement of the neighbours, and of the particle itself.
  const Rotation<D> slope = around.fade * around.inverse;
  const Real slopes = (slope * squares * slope.transpose()).trace() + (slope * moment).squaredNorm();
  const Real stiffness = slopes * wave_velocity * wave_velocity * rules_.step * rules_.step;
  if (stiffness > most_stiffness) around.fade *= std::sqrt(most_stiffness / stiffness);
  return around;
}

template <int D>
laws::GroundStep<D> GatheredGround<D>::advance_one(const state::Particles<D>& particles, const GroundStrength<D>& strength,
                                                   std::size_t n) {
  Member& member = members_[n];
  if (member.is_new != 0) return {};
  const StrengthOfGround& ground = strength.ground(member.particle);
  const auto change = [&](Index other) -> Vector<D> {
    return (vector_of<D>(particles.displacement, other) - vector_of<D>(last_, other)) -
           (vector_of<D>(particles.displacement, member.particle) - vector_of<D>(last_, member.particle));
  };
  const auto middle = [&](Index other) -> Vector<D> {
    return apart<D>(rules_.period, start_, particles.displacement, member.particle, other) - 0.5 * change(other);
  };
  const Around around = look_around(n, p_wave_velocity(ground), middle, change);
  if (!around.is_alone) {
    const Rotation<D> strain = 0.5 * around.fade * (around.gradient + around.gradient.transpose());
    const Rotation<D> spin = 0.5 * (around.gradient - around.gradient.transpose());
    return laws::advance_ground<D>(ground.residual_strength(), ground.elastic, strain, spin, member.state);
  }
  laws::GroundStep<D> lost;
  lost.dissipated = laws::elastic_energy<D>(ground.elastic, member.state.stress);
  member.state = {Rotation<D>::Zero(), opening_alone};
  return lost;
}

template <int D>
void GatheredGround<D>::advance(const state::Particles<D>& particles, GroundStrength<D>& strength) {
  steps_.resize(members_.size());
  parallel::parallel_for(members_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) steps_[n] = advance_one(particles, strength, n);
  });
  for (std::size_t n = 0; n < members_.size(); ++n) {
    flow_ += members_[n].volume * steps_[n].dissipated;
    strength.add_slip(members_[n].particle, steps_[n].slip);
  }
}

template <int D>
bool GatheredGround<D>::must_search(const state::Particles<D>& particles) const {
  // Two particles may approach each other, and it is asked once in a step.
  return !members_.empty() && some_moved<D>(particles, searched_at_, 0.45 * skin * particles.spacing);
}

/// Lists of all members from the displacements at the last search.
template <int D>
void GatheredGround<D>::list_neighbors() {
  const Real reach = (support + skin) * spacing_;
  grid_.place(start_, searched_at_, static_cast<Index>(member_.size()));
  neighbors_.clear();
  begin_.assign(1, 0);
  std::vector<Index> near;
  for (const Member& member : members_) {
    near.clear();
    const Index own = member.particle;
    grid_.visit_near(vector_of<D>(start_, own) + vector_of<D>(searched_at_, own), reach, [&](Index other) {
      if (other != own && apart<D>(rules_.period, start_, searched_at_, own, other).norm() < reach) near.push_back(other);
    });
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const Index other : near) {
      const bool both_cut = is_cut_[at(member.particle)] != 0 && is_cut_[at(other)] != 0;
      neighbors_.push_back({other, (holds(other) ? 1.0 : 2.0) * (both_cut ? 0.5 : 1.0)});
    }
    begin_.push_back(neighbors_.size());
  }
}

template <int D>
void GatheredGround<D>::search(const state::Particles<D>& particles, const GroundStrength<D>& strength) {
  searched_at_ = particles.displacement;
  list_neighbors();
  pushes_.resize(neighbors_.size());
  for (std::size_t n = 0; n < members_.size(); ++n) members_[n].volume = push_from(particles, strength, n);
}

/// Returns the volume of the member.
template <int D>
Real GatheredGround<D>::push_from(const state::Particles<D>& particles, const GroundStrength<D>& strength, std::size_t n) {
  const Index own = members_[n].particle;
  const StrengthOfGround& ground = strength.ground(own);
  const auto way = [&](Index other) { return apart<D>(rules_.period, start_, particles.displacement, own, other); };
  const auto change = [&](Index other) -> Vector<D> { return velocity_of<D>(particles, other) - velocity_of<D>(particles, own); };
  const Around around = look_around(n, p_wave_velocity(ground), way, change);
  const Real volume = around.volume * volume_of<D>(particles, ground, own), mass = 1 / particles.inverse_mass[at(own)];
  const Real rate = rules_.damping_ratio / std::sqrt(2) * p_wave_velocity(ground) / spacing_;
  const Real dashpot = std::min(rate, most_damping / (D * rules_.step)) * mass * D / around.weights;
  const Real core = 0.5 * p_wave_velocity(ground) * p_wave_velocity(ground) * mass / (spacing_ * spacing_);
  const Rotation<D> spread = (volume * around.fade) * members_[n].state.stress * around.inverse;
  Real forces = 0, drags = 0;
  for (std::size_t k = begin_[n]; k < begin_[n + 1]; ++k) {
    pushes_[k] = {};
    const Vector<D> to = way(neighbors_[k].particle);
    const Real distance = to.norm(), depth = std::max(nearest * spacing_ - distance, Real{0});
    pushes_[k].core = 0.5 * core * neighbors_[k].share * depth * depth;
    pushes_[k].stress = core * neighbors_[k].share * depth / distance * to;
    if (around.is_alone) continue;
    const Real g = weight(to.squaredNorm(), neighbors_[k].share);
    pushes_[k].stress -= g * (spread * to);
    pushes_[k].drag = -g * dashpot * (change(neighbors_[k].particle) - around.gradient * to);
    forces += pushes_[k].stress.norm();
    drags += pushes_[k].drag.norm();
  }
  const Real most = drag_share * rules_.damping_ratio * forces;
  for (std::size_t k = begin_[n]; drags > most && k < begin_[n + 1]; ++k) pushes_[k].drag *= most / drags;
  return volume;
}

/// What dashpots take in a step is the mean of their forces at its ends times the displacement, as the stepper counts work.
template <int D>
void GatheredGround<D>::add_forces(const state::Particles<D>& particles, const GroundStrength<D>& strength,
                                   state::FreedomColumns<D>& acceleration) {
  if (members_.empty()) return;
  volumes_.resize(members_.size());
  parallel::parallel_for(members_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) volumes_[n] = push_from(particles, strength, n);
  });
  for (std::size_t n = 0; n < members_.size(); ++n) {
    const laws::Elasticity& elastic = strength.ground(members_[n].particle).elastic;
    lost_ += (members_[n].volume - volumes_[n]) * laws::elastic_energy<D>(elastic, members_[n].state.stress);
    members_[n].volume = volumes_[n];
  }
  const auto drag_power = [&] {
    Real power = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
      for (std::size_t i = 0; i < particles.size(); ++i) power += drag_force_[axis][i] * particles.velocity[axis][i];
    return power;
  };
  drag_ -= 0.5 * rules_.step * drag_power();
  for (state::Column& column : drag_force_) std::ranges::fill(column, 0);
  for (std::size_t n = 0; n < members_.size(); ++n) {
    const std::size_t own = at(members_[n].particle);
    members_[n].is_new = 0;
    for (std::size_t k = begin_[n]; k < begin_[n + 1]; ++k) {
      const std::size_t other = at(neighbors_[k].particle);
      const Push& push = pushes_[k];
      for (std::size_t axis = 0; axis < D; ++axis) {
        const auto part = static_cast<int>(axis);
        acceleration[axis][other] += (push.stress[part] + push.drag[part]) * particles.inverse_mass[other];
        acceleration[axis][own] -= (push.stress[part] + push.drag[part]) * particles.inverse_mass[own];
        drag_force_[axis][other] += push.drag[part];
        drag_force_[axis][own] -= push.drag[part];
      }
    }
  }
  drag_ -= 0.5 * rules_.step * drag_power();
  last_ = particles.displacement;
}

template <int D>
Real GatheredGround<D>::energy(const GroundStrength<D>& strength) const {
  Real total = 0;
  for (const Push& push : pushes_) total += push.core;
  for (const Member& member : members_)
    total += member.volume * laws::elastic_energy<D>(strength.ground(member.particle).elastic, member.state.stress);
  return total;
}

template <int D>
void GatheredGround<D>::columns(Archive& archive) {
  std::vector<Rotation<D>> stress;
  std::vector<Real> opening;
  for (const Member& member : members_) {
    stress.push_back(member.state.stress);
    opening.push_back(member.state.opening);
  }
  archive("member_stress", stress);
  archive("member_opening", opening);
  if (archive.reading()) members_.resize(stress.size());
  archive_members(archive, "member_particle", members_, &Member::particle);
  archive_members(archive, "member_is_new", members_, &Member::is_new);
  archive_members(archive, "member_volume", members_, &Member::volume);
  for (std::size_t n = 0; n < members_.size(); ++n) members_[n].state = {stress[n], opening.at(n)};
  archive("flow", flow_);
  archive("drag", drag_);
  archive("lost", lost_);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = std::to_string(axis);
    archive("searched_at" + name, searched_at_[axis]);
    archive("last" + name, last_[axis]);
    archive("drag_force" + name, drag_force_[axis]);
  }
  if (!archive.reading()) return;
  std::ranges::fill(member_, -1);
  for (std::size_t n = 0; n < members_.size(); ++n) {
    const Index particle = members_[n].particle;
    if (particle < 0 || at(particle) >= member_.size() || holds(particle))
      throw UserError("checkpoint: a gathered particle has a number that the model does not have");
    member_[at(particle)] = static_cast<Index>(n);
  }
  if (members_.empty()) return;
  list_neighbors();
  pushes_.resize(neighbors_.size());
}

template class GatheredGround<2>;
template class GatheredGround<3>;

}  // namespace sazare::methods::mps
