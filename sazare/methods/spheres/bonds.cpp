#include "sazare/methods/spheres/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sazare/methods/spheres/bond_kernel.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr Index filler = -1;

/// Largest frequency squared of a bond whose ends have these masses and inertias [1/s2].
Real largest_frequency_squared(const laws::BondStiffness<Real>& bond, const std::array<Real, 2>& inverse_mass,
                               const std::array<Real, 2>& inverse_inertia) {
  const Real mass = inverse_mass[0] + inverse_mass[1], inertia = inverse_inertia[0] + inverse_inertia[1];
  // Bending by opposite turns and shear by equal ones; they are coupled where the ends differ.
  const Real bending = bond.bend * inertia, shearing = bond.shear * (0.25 * inertia + mass / (bond.length * bond.length)),
             coupling = std::sqrt(bond.bend * bond.shear) * 0.5 * (inverse_inertia[0] - inverse_inertia[1]);
  const Real mean = 0.5 * (bending + shearing), half = 0.5 * (bending - shearing);
  return std::max({bond.stretch * mass, bond.twist * inertia, mean + std::sqrt(half * half + coupling * coupling)});
}

/// Not less than the largest rate of its dashpots [1/s].
Real largest_damping_rate(const Bond& bond, const std::array<Real, 2>& inverse_mass, const std::array<Real, 2>& inverse_inertia) {
  const Real mass = inverse_mass[0] + inverse_mass[1], inertia = inverse_inertia[0] + inverse_inertia[1],
             length = bond.stiffness.length;
  return std::max(bond.damping.along * mass,
                  bond.damping.across * (mass + 0.25 * length * length * inertia) + bond.damping.turning * inertia);
}

}  // namespace

Bonds::Bonds(std::vector<Bond> bonds, std::vector<laws::BondStrength<Real>> kinds)
    : bonds_(std::move(bonds)), kinds_(std::move(kinds)) {
  for (const auto& kind : kinds_)
    breaks_ =
        breaks_ || kind.tensile < std::numeric_limits<Real>::infinity() || kind.cohesion < std::numeric_limits<Real>::infinity();
  for (const Bond& bond : bonds_) damped_ = damped_ || bond.damping.along > 0;
}

void Bonds::collect() {
  if (!breaks_) return;
  for (std::size_t link = 0; link < source_.size(); ++link) {
    if (source_[link] == filler) continue;
    Bond& bond = bonds_[static_cast<std::size_t>(source_[link])];
    bond.largest_use = largest_use_[link];
    bond.energy_before = energy_before_[link];
  }
}

void Bonds::note_broken(std::size_t link) { bonds_[static_cast<std::size_t>(source_[link])].largest_use = largest_use_[link]; }

void Bonds::append(Index number, bool is_filler) {
  const Bond& bond = bonds_[static_cast<std::size_t>(number)];
  const Real share = is_filler ? 0 : 1;
  source_.push_back(is_filler ? filler : number);
  kind_.push_back(bond.kind);
  length_.push_back(bond.stiffness.length);
  stretch_.push_back(share * bond.stiffness.stretch);
  shear_.push_back(share * bond.stiffness.shear);
  bend_.push_back(share * bond.stiffness.bend);
  twist_.push_back(share * bond.stiffness.twist);
  direction_x_.push_back(bond.direction.x);
  direction_y_.push_back(bond.direction.y);
  direction_z_.push_back(bond.direction.z);
  if (breaks_) {
    radius_.push_back(bond.radius);
    largest_use_.push_back(is_filler ? 0 : bond.largest_use);
    energy_before_.push_back(is_filler ? 0 : bond.energy_before);
  }
  if (!damped_) return;
  along_.push_back(share * bond.damping.along);
  across_.push_back(share * bond.damping.across);
  turning_.push_back(share * bond.damping.turning);
}

void Bonds::drop_broken() {
  collect();
  for (std::size_t n = 0; n < bonds_.size(); ++n) bonds_[n].gone = is_broken(n) ? 1 : 0;
}

void Bonds::arrange(std::span<const Index> place) {
  struct Placed {
    Index first, second, bond;
  };
  std::vector<Placed> placed;
  placed.reserve(bonds_.size());
  for (std::size_t n = 0; n < bonds_.size(); ++n) {
    Bond& bond = bonds_[n];
    if (bond.gone != 0) continue;
    Index i = place[static_cast<std::size_t>(bond.first)], j = place[static_cast<std::size_t>(bond.second)];
    if (i > j) {
      std::swap(i, j);
      std::swap(bond.first, bond.second);
      bond.direction = Triple<Real>{} - bond.direction;
    }
    placed.push_back({i, j, static_cast<Index>(n)});
  }
  std::ranges::sort(placed, {}, [](const Placed& one) { return std::array{one.first, one.second, one.bond}; });
  links_.begin.assign(1, 0);
  for (auto* column : {&links_.second, &first_, &kind_, &source_}) column->clear();
  for (auto* column : {&length_, &stretch_, &shear_, &bend_, &twist_, &direction_x_, &direction_y_, &direction_z_, &radius_,
                       &largest_use_, &energy_before_, &along_, &across_, &turning_})
    column->clear();
  const std::size_t blocks = (place.size() + neighbors::block_size - 1) / neighbors::block_size;
  auto next = placed.begin();
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto end = static_cast<Index>((block + 1) * neighbors::block_size);
    const Placed* last = nullptr;
    const auto add = [&](const Placed& one, bool is_filler) {
      first_.push_back(one.first);
      links_.second.push_back(one.second);
      append(one.bond, is_filler);
    };
    for (; next != placed.end() && next->first < end; ++next) {
      last = &*next;
      add(*last, false);
    }
    while (last != nullptr && first_.size() % lane_count != 0) add(*last, true);
    links_.begin.push_back(first_.size());
  }
  broken_.assign(blocks, {});
}

template <bool breaks, bool damped>
ContactSums Bonds::evaluate_with(const state::Spheres& spheres, const Task& task) {
  BondKernel<breaks, damped> kernel(*this, spheres, task);
  for (std::size_t link = links_.begin[task.block]; link < links_.begin[task.block + 1]; link += lane_count)
    kernel.evaluate(link);
  return kernel.sums();
}

ContactSums Bonds::evaluate(const state::Spheres& spheres, const Task& task) {
  broken_[task.block].clear();
  if (breaks_) return damped_ ? evaluate_with<true, true>(spheres, task) : evaluate_with<true, false>(spheres, task);
  return damped_ ? evaluate_with<false, true>(spheres, task) : evaluate_with<false, false>(spheres, task);
}

void Bonds::columns(Archive& archive) {
  if (!archive.reading()) collect();
  archive("bonds", bonds_);
}

Real stable_step(std::span<const Bond> bonds, const state::Spheres& spheres) {
  std::vector<Real> shares(spheres.size(), 0);
  for (const Bond& bond : bonds)
    for (const Index end : {bond.first, bond.second}) shares[static_cast<std::size_t>(end)] += 1;
  Real limit = std::numeric_limits<Real>::infinity();
  for (const Bond& bond : bonds) {
    std::array<Real, 2> inverse_mass{}, inverse_inertia{};
    for (std::size_t n = 0; n < 2; ++n) {
      const auto end = static_cast<std::size_t>(n == 0 ? bond.first : bond.second);
      inverse_mass[n] = shares[end] * spheres.kick[end].inverse_mass;
      inverse_inertia[n] = shares[end] * spheres.kick[end].inverse_inertia;
    }
    const Real square = largest_frequency_squared(bond.stiffness, inverse_mass, inverse_inertia),
               rate = largest_damping_rate(bond, inverse_mass, inverse_inertia);
    if (square > 0) limit = std::min(limit, 2 / (rate + std::sqrt(rate * rate + square)));
  }
  return limit;
}

}  // namespace sazare::methods::spheres
