#pragma once

/// Contacts of particles that no link joins: where links broke, and where free surfaces meet.

#include "sazare/laws/sphere_contact.hpp"
#include "sazare/methods/mps/ground_strength.hpp"
#include "sazare/methods/mps/particle_places.hpp"

namespace sazare::methods::mps {

/// What particles are in contact; discs or spheres as wide as the spacing.
struct LooseRules {
  Real step = 0;                 ///< [s]
  Real damping_ratio = 0;        ///< of the dashpots, over critical [-]
  Periods period{};              ///< of the body
};

/// Two particles of unbroken ground that no link joins and that meet, as on the free surfaces of two bodies, press on each other as
/// discs or spheres as wide as the spacing, with the stiffness of a column of ground as wide as they are, lambda + 2 mu, and slide
/// with the friction of the weaker of their grounds (laws/sphere_contact.hpp).
///
/// Loose are particles without some of their links, so those of free surfaces, until they are gathered (gathered_ground.hpp). Pairs
/// are kept while they may touch, in the order of their numbers; they are searched again when a particle has moved by more than
/// half the skin against another.
template <int D>
class LooseContacts {
public:
  LooseContacts(const state::Particles<D>& particles, const LinkTable<D>& links, const LooseRules& rules);

  /// This particle has lost links.
  void loosen(Index particle);
  /// From now on this particle touches nobody.
  void release(Index particle);

  /// Adds the accelerations that contacts give.
  void evaluate(const state::Particles<D>& particles, const LinkTable<D>& links, const GroundStrength<D>& strength,
                state::FreedomColumns<D>& acceleration);

  Real energy(const state::Particles<D>& particles, const GroundStrength<D>& strength) const;  ///< [J; J/m in 2-D]
  Real dissipated() const { return dissipated_; }  ///< by friction and dashpots [J; J/m in 2-D]
  Index touching() const { return touching_; }     ///< pairs at the last evaluation

  void columns(Archive& archive);

private:
  struct Pair {
    Index first = 0, second = 0;
    laws::SphereMemory memory;
    Vector3 inelastic = Vector3::Zero();  ///< dashpot and friction on the second at the last evaluation [N]
  };
  struct Force {
    Vector<D> on_second = Vector<D>::Zero();  ///< [N]
    Vector<D> arm = Vector<D>::Zero();        ///< from the first to the contact [m]
    Real loss = 0;                            ///< of the last step [J]
    bool touches = false;
  };

  Vector<D> apart(const state::Particles<D>& particles, Index first, Index second) const;
  Real energy_of(const state::Particles<D>& particles, const GroundStrength<D>& strength, const Pair& pair) const;
  Force force(const state::Particles<D>& particles, const GroundStrength<D>& strength, Pair& pair) const;
  void search(const state::Particles<D>& particles, const LinkTable<D>& links);
  void find_near(const state::Particles<D>& particles, const LinkTable<D>& links, Index particle, std::vector<Pair>& found) const;

  LooseRules rules_;
  std::vector<std::uint8_t> loose_;  ///< by particle: inner, loose or released
  std::vector<Pair> pairs_;
  std::vector<Force> forces_;                 ///< by pair, of the last evaluation
  std::array<state::Column, D> searched_at_;  ///< displacements at the last search [m]
  ParticleGrid<D> grid_;
  Real dissipated_ = 0;
  Index touching_ = 0;
};

extern template class LooseContacts<2>;
extern template class LooseContacts<3>;

}  // namespace sazare::methods::mps
