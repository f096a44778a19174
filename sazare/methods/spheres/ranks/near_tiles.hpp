#pragma once

/// Which spheres of a rank are near those of other ranks. Each tells the others boxes around its tiles; no rank needs to know all
/// spheres.

#include <span>
#include <vector>

#include "sazare/methods/spheres/ranks/rank_tiles.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// By rank: the places of own spheres that are nearer to one of its spheres than the margin, and of others near its tiles; none
/// for this rank itself. All call it.
std::vector<std::vector<Index>> spheres_near_others(const RankTiles& ranks, const state::Spheres& spheres, Real margin);

}  // namespace sazare::methods::spheres
