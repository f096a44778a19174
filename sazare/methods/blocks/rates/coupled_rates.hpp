#pragma once

/// What binds the steps of all blocks together. With every neighbour held each body's rate c is exact, and half the step is
/// stable whatever the neighbours do, for a link's energy |a - b|^2 is at most 2 |a|^2 + 2 |b|^2. Meshes stay below that factor
/// of 2: their largest coupled rate
///
///     r = max over motions v of  sum over links of v C_l v / max(c_a, c_b)   /   v M v      1 <= r <= 2
///
/// is found by power iteration, and rates of r c / 2 make half the step stable for the mesh as it is. Links that break only
/// lower the sum.

#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::methods::blocks {

/// Dashpots of all faces, in the rates of their bodies with the neighbours held: r above, a little on the safe side.
Real coupled_damping(std::span<const ElasticJoint> kinds, std::span<const JointFace> faces, const state::Bodies<3>& bodies,
                     std::span<const terms::Rates> held);

}  // namespace sazare::methods::blocks
