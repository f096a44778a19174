#pragma once

/// Pairs of blocks whose contact is evaluated together: their spheres in lanes, whichever pair they are of.

#include <span>
#include <vector>

#include "sazare/methods/blocks/contact_kernel.hpp"

namespace sazare::methods::blocks {

class ContactBatch {
public:
  /// So many pairs fill the lanes and stay in the first-level cache.
  static constexpr std::size_t most_pairs = 64;

  struct Pair {
    Due due;
    ContactBody first, second;
    bool overlap = false;         ///< two of its spheres overlap, be it less than their initial overlap
    std::size_t touching = 0;     ///< spheres that give a force
    std::size_t first_touch = 0;  ///< their place among those of all pairs
  };

  void clear();

  /// Begins a pair. Bodies must outlive the batch.
  void begin_pair(const Due& due, const ContactBody& first, const ContactBody& second) { pairs_.push_back({due, first, second}); }

  /// Adds spheres of the last pair that may touch.
  void add(SpherePair& spheres) { may_touch_.push_back({&spheres, pairs_.size() - 1}); }

  /// Finds which spheres touch, and their forces, with moments about a pole; the others forget.
  void evaluate(const laws::SphereContact& law, const ContactSurface& surface, const Vector3& pole);

  std::span<const Pair> pairs() const { return pairs_; }

  /// Sum over the spheres of a pair, in the order in which they were added.
  ContactForce force(const Pair& pair) const;
  /// What that is on the strains of both, which move the tangent points of the spheres.
  ContactStrainForce strain_force(const Pair& pair, const ContactSurface& surface) const;

private:
  struct Member {
    SpherePair* spheres = nullptr;
    std::size_t pair = 0;
  };
  struct InLanes;

  InLanes in_lanes(std::span<const Member> members, const ContactSurface& surface) const;
  void find_touching(const ContactSurface& surface);
  void keep_if_touching(const Member& member, Real overlap);
  void push(const laws::SphereContact& law, const Vector3& pole, const InLanes& members, std::span<ContactForce> forces) const;

  std::vector<Pair> pairs_;
  std::vector<Member> may_touch_, touching_;
  std::vector<ContactForce> forces_;  ///< by touching member
};

}  // namespace sazare::methods::blocks
