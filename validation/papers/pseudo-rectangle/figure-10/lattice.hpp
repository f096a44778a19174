#pragma once

#include "sazare/core/vector.hpp"

namespace sazare::validation {

/// A beam of squares on two supports under two equal loads, all at the middles of outer elements.
struct LatticeBeam {
  int rows = 2, columns = 8;
  int springs = 1;
  bool ends = false;
  Real size = 0, thickness = 0;                    ///< of an element [m]
  Real normal_stiffness = 0, shear_stiffness = 0;  ///< k_n, k_s [Pa]
  int support = 0;                                 ///< column of the left support; the right one stands in the mirror
  int load = 0;                                    ///< column of the left load
};

/// The total load at which the tension of a spring reaches a strength [Pa] first [N]: linear statics of all springs, solved
/// directly.
Real load_at_first_break(const LatticeBeam& beam, Real strength);

}  // namespace sazare::validation
