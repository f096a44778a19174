#pragma once

/// Bonds between spheres.

#include <span>
#include <vector>

#include "sazare/methods/spheres/bond_links.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/ranks/rank_tiles.hpp"

namespace sazare::methods::spheres {

class Bonds {
public:
  Bonds() = default;
  Bonds(std::vector<Bond> bonds, std::vector<laws::BondStrength<Real>> kinds);

  bool empty() const { return bonds_.empty(); }
  bool is_broken(std::size_t bond) const {
    return bonds_[bond].largest_use >= kinds_[static_cast<std::size_t>(bonds_[bond].kind)].ultimate;
  }
  /// In the order in which they were given. What weakens them stands here since `collect` was called last, what broke them at
  /// once.
  const std::vector<Bond>& bonds() const { return bonds_; }
  const std::vector<laws::BondStrength<Real>>& kinds() const { return kinds_; }
  /// Takes back what the columns know; those of all ranks where several share the spheres, which all call it.
  void collect(const RankTiles* ranks);

  /// Whether any may break.
  bool may_break() const { return traits_.breaks; }
  /// Forgets the bonds that have broken, of which all is collected; `arrange` is to follow.
  void drop_broken();
  /// Time levels of the spheres; a bond has the finer one of its two.
  struct Levels {
    std::size_t count = 1;
    std::span<const std::int8_t> of;  ///< by number of the sphere; empty: all have level 0
  };
  /// Lays out the bonds for spheres of which `place` says by number where they stand.
  void arrange(std::span<const Index> place, const Levels& levels);
  const BondLinks& links(std::size_t level) const { return levels_[level]; }

  struct Task {
    std::size_t tile = 0;
    Real step = 0;                 ///< [s]
    const ContactTable& contacts;  ///< what spheres are to each other when their bond has broken
    LoadTable& loads;
    state::SphereLoad* own;  ///< the loads of the tile's spheres
    std::size_t level = 0;
  };

  /// Adds the forces of a tile's bonds of a level to the loads.
  ContactSums evaluate(const state::Spheres& spheres, const Task& task);

  /// A link of a level that has broken, and the overlap beyond which alone its spheres push each other [m].
  struct Broken {
    std::size_t level = 0, link = 0;
    Real largest_use = 0, allowed_overlap = 0;
  };
  /// Those that broke at the last evaluation of the levels from a coarsest one on, which it notes; of all ranks, which all call
  /// it.
  std::vector<Broken> take_broken(std::size_t coarsest, const RankTiles* ranks);

  /// What is written must have been collected.
  void columns(Archive& archive);

private:
  template <bool breaks, bool damped>
  ContactSums evaluate_with(const state::Spheres& spheres, const Task& task);

  std::vector<Bond> bonds_;
  std::vector<laws::BondStrength<Real>> kinds_;
  BondLinks::Traits traits_;
  std::vector<BondLinks> levels_;  ///< by time level
};

/// Limits of the step by the bonds alone, by sphere [s]; infinite where it has none. A bond's limit is that of its own where its
/// spheres share their masses and inertias among all their bonds, and so the least of them never above that of all together
/// [Irons1971]. A bond of frequency w and damping rate g has w^2 h^2 + 4 g h = 4, where the step begins to swing from side to
/// side, its dashpots at the predicted velocity.
std::vector<Real> stable_steps(std::span<const Bond> bonds, const state::Spheres& spheres);
/// The least of them [s].
Real stable_step(std::span<const Bond> bonds, const state::Spheres& spheres);

}  // namespace sazare::methods::spheres
