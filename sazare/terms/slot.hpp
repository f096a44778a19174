#pragma once

/// A link's own place for the impulses it gives to its bodies until they fetch them.
///
/// Every evaluation deposits; a body gathers at its own times. Between two kicks of the coarser body the impulses add up,
/// and their first moments in time with them: at the kick each impulse then counts as if it had been given at the moment
/// of its evaluation. So the scheme keeps its second order at mixed levels, and with arms taken about the drifted
/// positions at that moment it keeps the angular momentum to round-off (see motion/kick.hpp).
/// Nothing is ever cleared: a deposit that is newer than the body's last kick is one that still waits.

#include <array>

#include "sazare/core/links.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::terms {

using state::Impulse;
using state::MeanMotion;
using state::Wrench;

/// `Causes` counts the parts of the force whose work is booked apart (dashpot, friction, a load).
template <int D, int Causes>
struct Slot {
  struct Side {
    Wrench<D> total;                          ///< waiting impulse
    std::array<Wrench<D>, Causes> booked_part;  ///< the parts of it whose work is booked
    std::array<Real, Causes> work{};          ///< work booked so far [J]
    Real acting = 0;                          ///< time that the waiting impulse covers [s]
  };

  std::array<Side, 2> side;
  Wrench<D> moment;      ///< first moment in time of what waits on the lagging side, from its last kick on
  Tick evaluated = -1;   ///< tick of the last deposit
  Real ahead = 0;        ///< time of the last deposit that lies after its evaluation [s]
  int lagging = -1;      ///< the side that was not due at the last deposit, or -1
};

/// Force on one side times the time it acts, split into all of it and the parts that are booked.
template <int D, int Causes>
struct Deposit {
  Wrench<D> total;
  std::array<Wrench<D>, Causes> booked_part;
};

/// Puts an evaluation's impulses into one side of a slot. Call for every side, then `mark`. Says whether so much waits
/// now for a body that is not due that it must be woken.
template <int D, int Causes>
bool deposit(Slot<D, Causes>& slot, int side, const state::Motion<D>& body, const Moment& now, const Due& due,
             const Deposit<D, Causes>& given) {
  auto& at = slot.side[static_cast<std::size_t>(side)];
  const bool is_due = body.due == now.tick;
  if (slot.evaluated <= body.last_kick) {  // nothing waits
    at.total = given.total;
    at.booked_part = given.booked_part;
    at.acting = due.acting;
    if (slot.lagging == side) slot.lagging = -1;
    if (is_due) return false;
    const Real since = now.seconds_since(body.last_kick);
    slot.moment = since * given.total;
    slot.lagging = side;
    return given.total.linear.squaredNorm() > body.wake_impulse * body.wake_impulse;
  }
  at.total += given.total;
  for (std::size_t cause = 0; cause < Causes; ++cause) at.booked_part[cause] += given.booked_part[cause];
  at.acting += due.acting;
  slot.moment += now.seconds_since(body.last_kick) * given.total;
  return !is_due && at.total.linear.squaredNorm() > body.wake_impulse * body.wake_impulse;
}

/// Closes an evaluation, after its sides.
template <int D, int Causes>
void mark(Slot<D, Causes>& slot, const Moment& now, const Due& due) {
  slot.evaluated = now.tick;
  slot.ahead = due.ahead;
}

/// Adds what waits for a body to its impulse.
template <int D, int Causes>
void gather(const Slot<D, Causes>& slot, int side, const state::Motion<D>& body, const Moment& now, Impulse<D>& sum) {
  if (slot.evaluated <= body.last_kick) return;
  const auto& at = slot.side[static_cast<std::size_t>(side)];
  sum.linear += at.total.linear;
  sum.angular += at.total.angular;
  if (slot.lagging != side) return;
  const Real elapsed = now.seconds_since(body.last_kick);
  sum.shift += elapsed * at.total.linear - slot.moment.linear;
  sum.twist += elapsed * at.total.angular - slot.moment.angular;
}

/// Books the work of the parts just gathered.
template <int D, int Causes>
void book(Slot<D, Causes>& slot, int side, Tick previous_kick, const MeanMotion<D>& mean) {
  if (slot.evaluated <= previous_kick) return;
  auto& at = slot.side[static_cast<std::size_t>(side)];
  for (std::size_t cause = 0; cause < Causes; ++cause) at.work[cause] += at.booked_part[cause].power(mean);
}

/// Share of a side's last impulse that acts after now, when the last kick was at now.
template <int D, int Causes>
Real share_ahead(const Slot<D, Causes>& slot, int side, Tick now) {
  const auto& at = slot.side[static_cast<std::size_t>(side)];
  return slot.evaluated == now && at.acting > 0 ? slot.ahead / at.acting : 0;
}

/// Adds that share to `sum`.
template <int D, int Causes>
void gather_ahead(const Slot<D, Causes>& slot, int side, Tick now, Impulse<D>& sum) {
  const Real share = share_ahead(slot, side, now);
  if (share == 0) return;
  const auto& at = slot.side[static_cast<std::size_t>(side)];
  sum.linear += share * at.total.linear;
  sum.angular += share * at.total.angular;
}

/// Work booked on a side until now, less what acts after now with the given mean motion [J].
template <int D, int Causes>
Real work_until(const Slot<D, Causes>& slot, int side, int cause, Tick now, const MeanMotion<D>& ahead) {
  const auto& at = slot.side[static_cast<std::size_t>(side)];
  const auto c = static_cast<std::size_t>(cause);
  return at.work[c] - share_ahead(slot, side, now) * at.booked_part[c].power(ahead);
}

}  // namespace sazare::terms
