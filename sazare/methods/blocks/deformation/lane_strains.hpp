#pragma once

/// Strains of bodies (state/strain.hpp), one in each lane.

#include "sazare/core/lane_records.hpp"
#include "sazare/core/symmetric_tensor.hpp"
#include "sazare/core/vector_of.hpp"

namespace sazare::methods::blocks {

/// Six numbers of a symmetric tensor in every lane.
using LaneSix = std::array<Lanes, 6>;

inline LaneVector product(const LaneSix& tensor, const LaneVector& v) {
  constexpr Real share = 1 / root_of_two;
  const Lanes yz = share * tensor[3], zx = share * tensor[4], xy = share * tensor[5];
  return {{add_product(tensor[0], v[0], add_product(xy, v[1], zx * v[2])),
           add_product(xy, v[0], add_product(tensor[1], v[1], yz * v[2])),
           add_product(zx, v[0], add_product(yz, v[1], tensor[2] * v[2]))}};
}

/// Strains of a body in every lane, and how fast they grow.
struct LaneStrain {
  LaneSix strain, rate;
};

/// From a state::Strain, predicted rates, or a state::StrainNow, mean rates.
template <class Strain>
LaneStrain load_strain(const LanePointers<Strain>& bodies) {
  const auto n = load_records<12>(bodies);
  return {{n[0], n[1], n[2], n[3], n[4], n[5]}, {n[6], n[7], n[8], n[9], n[10], n[11]}};
}

}  // namespace sazare::methods::blocks
