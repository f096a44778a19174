#pragma once

/// Deformable elements of a case: the inertia of their strains, and what holds them against strain.
///
/// A deformable element has the inertia of four equal masses at its corners, as elements of explicit finite elements have: J =
/// m/4 sum X X^T. That of its rotation is its tensor of inertia; that of its strain is j = tr(J)/3, alike in all directions.

#include <vector>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/deformation/elements.hpp"
#include "sazare/methods/blocks/rates/joint_rates.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

/// Gives deformable elements their inertia; does nothing where all are rigid.
void add_strains(const cases::BlocksCase& blocks, const std::vector<Index>& material, state::Bodies<3>& bodies);

/// Deformable elements, joined as the faces say.
std::vector<methods::blocks::DeformableElement> make_elements(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                              const std::vector<Index>& material, const state::Bodies<3>& bodies,
                                                              const std::vector<methods::blocks::JointFace>& joints);

}  // namespace sazare::runs
