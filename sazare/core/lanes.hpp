#pragma once

/// Four doubles worked on together. Laws are written once as templates and run on `Real` (tests, single evaluations)
/// or on `Lanes` (kernels: the three contact vertices of a joint's face, the fourth lane idle).

#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare {

using Lanes = Real __attribute__((vector_size(32)));
using LaneMask = decltype(Lanes{} > Lanes{});

inline Lanes select(LaneMask mask, Lanes yes, Lanes no) { return mask ? yes : no; }
inline Real select(bool condition, Real yes, Real no) { return condition ? yes : no; }

inline bool any(LaneMask mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }
inline bool any(bool condition) { return condition; }

inline Lanes broadcast(Real value) { return Lanes{value, value, value, value}; }

inline Lanes maximum(Lanes a, Lanes b) { return a > b ? a : b; }
inline Real maximum(Real a, Real b) { return a > b ? a : b; }

inline Lanes square_root(Lanes a) { return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
inline Real square_root(Real a) { return std::sqrt(a); }

/// Sum of the four lanes, in one fixed order.
inline Real sum(Lanes a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace sazare
