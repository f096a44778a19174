#pragma once

/// Bonds between spheres, in columns that lanes read, by the block of the first sphere.

#include <span>
#include <vector>

#include "sazare/laws/sphere_bond.hpp"
#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/methods/spheres/load_table.hpp"

namespace sazare::methods::spheres {

/// A bond between two spheres by their numbers, and what has become of it.
struct Bond {
  Index first = 0, second = 0;
  Index kind = 0;   ///< whose strength it has
  Index gone = 0;   ///< 1 when it is broken and no longer laid out
  Real radius = 0;  ///< [m]
  laws::BondStiffness<Real> stiffness;
  laws::BondDamping<Real> damping;
  Triple<Real> direction;  ///< from the first to the second at the start
  Real largest_use = 0;    ///< so far
  Real energy_before = 0;  ///< what damage may take, at the last evaluation [J]
};

/// A bond that has just broken: its place among the links, and the overlap beyond which alone its spheres push each other [m].
struct BrokenLink {
  std::size_t link = 0;
  Real allowed_overlap = 0;
};

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
  /// Takes back what the columns know.
  void collect();

  /// Forgets the bonds that have broken; `arrange` is to follow.
  void drop_broken();
  /// Lays out the bonds for spheres of which `place` says by number where they stand.
  void arrange(std::span<const Index> place);
  const BlockLinks& links() const { return links_; }
  /// First spheres, in the order of `links`.
  const std::vector<Index>& first() const { return first_; }

  struct Task {
    std::size_t block = 0;
    Real step = 0;                 ///< [s]
    const ContactTable& contacts;  ///< what spheres are to each other when their bond has broken
    LoadTable& loads;
    state::SphereLoad* own;  ///< the loads of the block's spheres
  };

  /// Adds the forces of a block's bonds to the loads.
  ContactSums evaluate(const state::Spheres& spheres, const Task& task);

  /// The bonds of a block that broke at the last evaluation.
  std::span<const BrokenLink> broken(std::size_t block) const { return broken_[block]; }

  /// To be called for each of them.
  void note_broken(std::size_t link);

  void columns(Archive& archive);

private:
  template <bool breaks, bool damped>
  friend class BondKernel;
  template <bool breaks, bool damped>
  ContactSums evaluate_with(const state::Spheres& spheres, const Task& task);
  void append(Index bond, bool filler);

  std::vector<Bond> bonds_;
  std::vector<laws::BondStrength<Real>> kinds_;
  bool breaks_ = false, damped_ = false;

  /// By link: a block's bonds, filled up to whole lanes by bonds that do nothing.
  BlockLinks links_;
  std::vector<Index> first_, kind_, source_;
  std::vector<Real> length_, stretch_, shear_, bend_, twist_, direction_x_, direction_y_, direction_z_;
  std::vector<Real> radius_, largest_use_, energy_before_;  ///< where bonds break
  std::vector<Real> along_, across_, turning_;              ///< where they have dashpots
  std::vector<std::vector<BrokenLink>> broken_;             ///< by block
};

/// Limit of the step by the bonds alone [s]: the least of any bond whose spheres share their masses and inertias among all their
/// bonds, and so never above that of all together [Irons1971]. A bond of frequency w and damping rate g has w^2 h^2 + 4 g h = 4,
/// where the step begins to swing from side to side, its dashpots at the velocity foreseen.
Real stable_step(std::span<const Bond> bonds, const state::Spheres& spheres);

}  // namespace sazare::methods::spheres
