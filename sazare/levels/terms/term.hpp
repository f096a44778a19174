#pragma once

/// A term brings state to a law and delivers impulses: one virtual call per term and phase, loops inside.
///
/// In a step the engine calls, for all terms in their fixed order: `evaluate` on the links that are due (in parallel,
/// each link writes only its own slot), then for chunks of due bodies `gather`; then, on one thread, `post_step`, where a
/// term may change what is linked. Whenever a link is due both its bodies stand at that tick.

#include <span>
#include <string_view>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/parcel.hpp"
#include "sazare/levels/terms/energy_balance.hpp"
#include "sazare/levels/terms/peers.hpp"
#include "sazare/levels/terms/slot.hpp"
#include "sazare/levels/terms/strain_forces.hpp"
#include "sazare/levels/terms/work.hpp"

namespace sazare::terms {

/// What bounds the step of one body, its neighbours held: upper bounds that add up over terms.
struct Rates {
  Real stiffness = 0;  ///< largest eigenvalue of M^-1 K [1/s2]
  Real damping = 0;    ///< largest eigenvalue of M^-1 C [1/s]

  Rates& operator+=(const Rates& other) {
    stiffness += other.stiffness;
    damping += other.damping;
    return *this;
  }
};

/// What a term asks of the engine after a step.
struct Changes {
  std::vector<Index> new_links;    ///< links that begin; the term's `links()` knows their bodies
  std::vector<Index> ended_links;  ///< links whose force has ended for good (until it is new again)
  std::vector<Index> inactive;     ///< links that cannot act before the next base step: base steps are enough for them
  std::vector<Index> watching;     ///< links that were inactive and may act from now on
  std::vector<Index> stiffer;      ///< bodies whose rates may have grown: their step is checked at once
  std::vector<Index> softer;       ///< bodies whose rates have fallen: their step may grow at the next base step

  bool empty() const {
    return new_links.empty() && ended_links.empty() && inactive.empty() && watching.empty() && stiffer.empty() && softer.empty();
  }
  void clear() { *this = {}; }
};

/// All bodies at a base step, for the energy balance: the part of the last kicks that acts after now has been taken back.
template <int D>
struct Synchronized {
  std::span<const state::Pose<D>> pose;  ///< per body
  std::span<const MeanMotion<D>> ahead;  ///< mean motion over the part that was taken back, per body
  Real time = 0;                         ///< [s]
  const Peers* peers = nullptr;          ///< who shares the bodies with this process; none: all are its own
  std::span<const state::StrainNow> strain = {};  ///< per body; none where all are rigid

  const state::Pose<D>& pose_of(Index body) const { return pose[static_cast<std::size_t>(body)]; }
  Vector6 strain_of(Index body) const {
    return strain.empty() ? Vector6(Vector6::Zero()) : strain[static_cast<std::size_t>(body)].strain;
  }
  /// Whether the energy of the link is counted by this process.
  bool counts(const Link& link) const { return peers == nullptr || peers->owns(link.first); }
};

template <int D>
class Term {
public:
  virtual ~Term() = default;

  virtual std::string_view name() const = 0;

  /// Bodies of each link by number.
  virtual std::span<const Link> links() const = 0;

  /// Whether links are of two bodies: only such count as pairs.
  virtual bool joins_bodies() const { return true; }

  /// Whether links look at the velocity and the spin with which bodies step, beside what `bytes_for_forces` holds.
  virtual bool looks_at_steps() const { return false; }

  /// Links that act from the beginning.
  virtual std::vector<Index> first_links() const = 0;

  virtual void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<D>& bodies) = 0;

  /// Adds to `sum`, body by body, what it receives; the impulses whose work is summed go into `parts` as well. A chunk of
  /// bodies at most.
  virtual void gather(const Instant& now, std::span<const Index> which, const state::Bodies<D>& bodies, std::span<Impulse<D>> sum,
                      CauseImpulses<D>& parts) const = 0;

  /// Whether it has forces on the strains of bodies, and what one body receives.
  virtual bool acts_on_strains() const { return false; }
  virtual void gather_strain(const Instant&, Index, StrainGathered&) const {}

  /// Work on one thread after a step. All processes of a run do it, and must come to the same changes.
  virtual void post_step(const Instant&, const state::Bodies<D>&, Peers&, Changes&) {}

  /// Work on one thread after a base step, when every body stands at the same time; by all processes, as above.
  virtual void post_base_step(const Instant&, const state::Bodies<D>&, Peers&, Changes&) {}

  virtual Rates rates(Index body) const = 0;

  /// Adds this term's energies at a base step, and takes back the work of parts that act after now: of links that count.
  virtual void add_energies(const Synchronized<D>& at, EnergySums& energies) const = 0;

  /// What a link remembers, on its way to other processes; and what is to be done when all that come have arrived.
  virtual void carry(Index link, Parcel& parcel) = 0;
  virtual void carried() {}

  /// Columns of a checkpoint.
  virtual void columns(Archive& archive) = 0;
};

}  // namespace sazare::terms
