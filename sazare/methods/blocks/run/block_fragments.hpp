#pragma once

/// Fragments of blocks: elements that still hang together by joints that hold.

#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/joints.hpp"
#include "sazare/runs/fragments.hpp"

namespace sazare::runs {

/// Which fragment every element belongs to; fragments are numbered by their first element.
struct FragmentMap {
  Index count = 0;
  std::vector<Index> of_element;
};

FragmentMap find_fragments(Index elements, const methods::blocks::Joints& joints);

/// Fragments at a moment, largest volume first; equal ones in the order of their numbers.
std::vector<Fragment> measure_fragments(const FragmentMap& map, const geometry::TetraMesh& mesh, const state::Bodies<3>& bodies,
                                        const levels::Snapshot<3>& now);

}  // namespace sazare::runs
