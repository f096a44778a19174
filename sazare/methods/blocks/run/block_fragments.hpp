#pragma once

/// Fragments of blocks: elements that still hang together by joints that hold.

#include <span>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/joints.hpp"
#include "sazare/methods/blocks/outer_faces.hpp"
#include "sazare/runs/fragments.hpp"

namespace sazare::runs {

/// Which fragment every element belongs to; fragments are numbered by their first element.
struct FragmentMap {
  Index count = 0;
  std::vector<Index> of_element;
};

FragmentMap find_fragments(Index elements, const methods::blocks::Joints& joints);

/// The elements by which a body hangs on what surrounds it: those with a face on a fixed, absorbing or prescribed boundary (none
/// where `faces` is null), and those whose centre is locked along all axes. Rising, each once.
std::vector<Index> anchored_elements(const cases::BlocksCase& blocks, const methods::blocks::OuterFaces* faces,
                                     const state::Bodies<3>& bodies);

/// Marks the fragments that stay: those with an anchored element, and the largest one where it has moved less than half as far as
/// the others have by mean of their mass, or where there is no other one. Of a free body, whose momenta cancel, that is one with
/// more than two thirds of the mass where the others go one way.
void mark_staying(const FragmentMap& map, std::span<const Index> anchored, std::vector<Fragment>& largest_first);

/// Those that do not stay, in their order.
std::vector<Fragment> detached(std::span<const Fragment> fragments);

/// Fragments at a moment, largest volume first; equal ones in the order of their numbers. They have moved from where the centres
/// of their elements were when time began [m].
std::vector<Fragment> measure_fragments(const FragmentMap& map, const geometry::TetraMesh& mesh, const state::Bodies<3>& bodies,
                                        const levels::Snapshot<3>& now, std::span<const Vector3> start);

}  // namespace sazare::runs
