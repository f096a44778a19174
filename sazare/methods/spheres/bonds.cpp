#include "sazare/methods/spheres/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/methods/spheres/bond_kernel.hpp"

namespace sazare::methods::spheres {

namespace {

/// What a bond remembers.
struct BondMemory {
  Index bond = 0;
  Real largest_use = 0, energy_before = 0;
};

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
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  for (const auto& kind : kinds_) traits_.breaks = traits_.breaks || kind.tensile < infinity || kind.cohesion < infinity;
  for (const Bond& bond : bonds_) traits_.damped = traits_.damped || bond.damping.along > 0;
}

void Bonds::collect(const RankTiles* ranks) {
  if (!traits_.breaks) return;
  std::vector<BondMemory> known;
  for (const BondLinks& links : levels_)
    for (std::size_t tile = 0; tile < links.broken.size(); ++tile) {
      if (ranks != nullptr && !ranks->owners().owns(tile)) continue;
      for (std::size_t link = links.ends.begin[tile]; link < links.ends.begin[tile + 1]; ++link)
        if (links.source[link] != BondLinks::filler)
          known.push_back({links.source[link], links.largest_use[link], links.energy_before[link]});
    }
  if (ranks != nullptr) known = ranks->join(known, parallel::Topic::search);
  for (const BondMemory& of : known) {
    Bond& bond = bonds_[static_cast<std::size_t>(of.bond)];
    bond.largest_use = of.largest_use;
    bond.energy_before = of.energy_before;
  }
}

std::vector<Bonds::Broken> Bonds::take_broken(std::size_t coarsest, const RankTiles* ranks) {
  std::vector<Broken> all;
  for (std::size_t level = coarsest; level < levels_.size(); ++level)
    for (const auto& tile : levels_[level].broken)
      for (const BrokenLink& one : tile)
        all.push_back({level, one.link, levels_[level].largest_use[one.link], one.allowed_overlap});
  if (ranks != nullptr) {
    all = ranks->join(all, parallel::Topic::changes);
    std::ranges::sort(all, {}, [](const Broken& one) { return std::array{one.level, one.link}; });  // as one process finds them
  }
  for (const Broken& one : all)
    bonds_[static_cast<std::size_t>(levels_[one.level].source[one.link])].largest_use = one.largest_use;
  return all;
}

void Bonds::drop_broken() {
  for (std::size_t n = 0; n < bonds_.size(); ++n) bonds_[n].gone = is_broken(n) ? 1 : 0;
}

void Bonds::arrange(std::span<const Index> place, const Levels& levels) {
  std::vector<std::vector<BondLinks::Placed>> placed(levels.count);
  const auto level_of = [&](Index sphere) -> std::size_t {
    return levels.of.empty() ? 0 : static_cast<std::size_t>(levels.of[static_cast<std::size_t>(sphere)]);
  };
  for (std::size_t n = 0; n < bonds_.size(); ++n) {
    Bond& bond = bonds_[n];
    if (bond.gone != 0) continue;
    Index i = place[static_cast<std::size_t>(bond.first)], j = place[static_cast<std::size_t>(bond.second)];
    if (i > j) {
      std::swap(i, j);
      std::swap(bond.first, bond.second);
      bond.direction = zero_vector<Real>() - bond.direction;
    }
    placed[std::max(level_of(bond.first), level_of(bond.second))].push_back({i, j, static_cast<Index>(n)});
  }
  const std::size_t tiles = neighbors::tiles_of(place.size());
  levels_.resize(levels.count);
  for (std::size_t level = 0; level < levels.count; ++level) {
    std::ranges::sort(placed[level], {}, [](const BondLinks::Placed& one) {
      return std::array{one.first, one.second, one.bond};
    });
    levels_[level].lay_out(placed[level], bonds_, traits_, tiles);
  }
}

template <bool breaks, bool damped>
ContactSums Bonds::evaluate_with(const state::Spheres& spheres, const Task& task) {
  BondLinks& links = levels_[task.level];
  BondKernel<breaks, damped> kernel(links, kinds_, spheres, task);
  for (std::size_t link = links.ends.begin[task.tile]; link < links.ends.begin[task.tile + 1]; link += lane_count)
    kernel.evaluate(link);
  return kernel.sums();
}

ContactSums Bonds::evaluate(const state::Spheres& spheres, const Task& task) {
  levels_[task.level].broken[task.tile].clear();
  const auto [breaks, damped] = traits_;
  if (breaks) return damped ? evaluate_with<true, true>(spheres, task) : evaluate_with<true, false>(spheres, task);
  return damped ? evaluate_with<false, true>(spheres, task) : evaluate_with<false, false>(spheres, task);
}

void Bonds::columns(Archive& archive) { archive("bonds", bonds_); }

std::vector<Real> stable_steps(std::span<const Bond> bonds, const state::Spheres& spheres) {
  std::vector<Real> shares(spheres.size(), 0);
  for (const Bond& bond : bonds)
    for (const Index end : {bond.first, bond.second}) shares[static_cast<std::size_t>(end)] += 1;
  std::vector<Real> limits(spheres.size(), std::numeric_limits<Real>::infinity());
  for (const Bond& bond : bonds) {
    std::array<Real, 2> inverse_mass{}, inverse_inertia{};
    for (std::size_t n = 0; n < 2; ++n) {
      const auto end = static_cast<std::size_t>(n == 0 ? bond.first : bond.second);
      inverse_mass[n] = shares[end] * spheres.kick[end].inverse_mass;
      inverse_inertia[n] = shares[end] * spheres.kick[end].inverse_inertia;
    }
    const Real square = largest_frequency_squared(bond.stiffness, inverse_mass, inverse_inertia),
               rate = largest_damping_rate(bond, inverse_mass, inverse_inertia);
    if (!(square > 0)) continue;
    for (const Index end : {bond.first, bond.second}) {
      Real& limit = limits[static_cast<std::size_t>(end)];
      limit = std::min(limit, 2 / (rate + std::sqrt(rate * rate + square)));
    }
  }
  return limits;
}

Real stable_step(std::span<const Bond> bonds, const state::Spheres& spheres) {
  return std::ranges::min(stable_steps(bonds, spheres));
}

}  // namespace sazare::methods::spheres
