#pragma once

#include "sazare/methods/rectangles/contacts.hpp"

namespace sazare::methods::rectangles {

/// The largest stable step of the leapfrog, whose dashpots see the velocity half a step before: the first motion to grow
/// changes its sign at every step, so dt^2 w^2 + 2 dt c < 4, with w^2 and c the largest eigenvalues of M^-1 K and M^-1 C at the
/// beginning.
struct StableStep {
  Real limit = 0;              ///< [s]; infinite where nothing holds anything
  Real largest_frequency = 0;  ///< w [rad/s]
  Real paper = 0;              ///< the smallest h_n sqrt(m/K_n) of an element, (26) of [Matsui1999] [s]; 0 without dashpots
};

/// All links whole; every face that is free counts as lying on a support, at most two opposite faces of an element.
/// `may_touch`: whether there is anything to meet.
StableStep stable_step(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links,
                       const ContactRules& contact, bool may_touch);

}  // namespace sazare::methods::rectangles
