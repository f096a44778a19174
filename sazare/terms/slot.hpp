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

/// Force on one side times the time it acts: all of it, and the parts of it whose work is booked.
template <int D, int Causes>
struct Deposit {
  Wrench<D> total;
  std::array<Wrench<D>, Causes> booked_part;

  Deposit& operator+=(const Deposit& other) {
    total += other.total;
    for (std::size_t cause = 0; cause < Causes; ++cause) booked_part[cause] += other.booked_part[cause];
    return *this;
  }
};

/// `Causes` counts the parts of the force whose work is booked apart (dashpot, friction, a load).
template <int D, int Causes>
struct alignas(64) Slot {
  std::array<Deposit<D, Causes>, 2> waiting;      ///< by side
  Tick evaluated = -1;                            ///< tick of the last deposit
  Real ahead = 0;                                 ///< time of the last deposit that lies after its evaluation [s]
  std::array<Real, 2> acting{};                   ///< by side: time that the waiting impulse covers [s]
  std::array<std::array<Real, Causes>, 2> work{};  ///< by side: work booked so far [J]
  Wrench<D> moment;  ///< first moment in time of what waits on the lagging side, from its last kick on
  int lagging = -1;  ///< the side that was not due at the last deposit, or -1
};

/// Puts an evaluation's impulses into one side of a slot. Call for every side, then `mark`. Says whether so much waits
/// now for a body that is not due that it must be woken.
template <int D, int Causes>
bool deposit(Slot<D, Causes>& slot, int side, const state::Motion<D>& body, const Moment& now, const Due& due,
             const Deposit<D, Causes>& given) {
  const auto s = static_cast<std::size_t>(side);
  const bool is_due = body.due == now.tick, nothing_waits = slot.evaluated <= body.last_kick;
  if (nothing_waits) {
    slot.waiting[s] = given;
    slot.acting[s] = due.acting;
    if (slot.lagging == side) slot.lagging = -1;
    if (is_due) return false;
    slot.moment = {};
    slot.lagging = side;
  } else {
    slot.waiting[s] += given;
    slot.acting[s] += due.acting;
  }
  slot.moment += now.seconds_since(body.last_kick) * given.total;
  return !is_due && slot.waiting[s].total.linear.squaredNorm() > body.wake_impulse * body.wake_impulse;
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
  const Wrench<D>& total = slot.waiting[static_cast<std::size_t>(side)].total;
  sum.linear += total.linear;
  sum.angular += total.angular;
  if (slot.lagging != side) return;
  const Real elapsed = now.seconds_since(body.last_kick);
  sum.shift += elapsed * total.linear - slot.moment.linear;
  sum.twist += elapsed * total.angular - slot.moment.angular;
}

/// Books the work of the parts just gathered.
template <int D, int Causes>
void book(Slot<D, Causes>& slot, int side, Tick previous_kick, const MeanMotion<D>& mean) {
  if (slot.evaluated <= previous_kick) return;
  const auto s = static_cast<std::size_t>(side);
  for (std::size_t cause = 0; cause < Causes; ++cause)
    slot.work[s][cause] += slot.waiting[s].booked_part[cause].power(mean);
}

/// Share of a side's last impulse that acts after now, when the last kick was at now.
template <int D, int Causes>
Real share_ahead(const Slot<D, Causes>& slot, int side, Tick now) {
  const Real acting = slot.acting[static_cast<std::size_t>(side)];
  return slot.evaluated == now && acting > 0 ? slot.ahead / acting : 0;
}

/// Adds that share to `sum`.
template <int D, int Causes>
void gather_ahead(const Slot<D, Causes>& slot, int side, Tick now, Impulse<D>& sum) {
  const Real share = share_ahead(slot, side, now);
  if (share == 0) return;
  const Wrench<D>& total = slot.waiting[static_cast<std::size_t>(side)].total;
  sum.linear += share * total.linear;
  sum.angular += share * total.angular;
}

/// Work booked on a side until now, less what acts after now with the given mean motion [J].
template <int D, int Causes>
Real work_until(const Slot<D, Causes>& slot, int side, int cause, Tick now, const MeanMotion<D>& ahead) {
  const auto s = static_cast<std::size_t>(side), c = static_cast<std::size_t>(cause);
  return slot.work[s][c] - share_ahead(slot, side, now) * slot.waiting[s].booked_part[c].power(ahead);
}

}  // namespace sazare::terms
