#pragma once

/// From the blocks of a case of method rectangles to elements, their links, and supports.

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/rectangles/rectangle_forces.hpp"
#include "sazare/particles/particle_supports.hpp"

namespace sazare::runs {

struct Assembly {
  state::Particles<2> particles;  ///< elements, then walls, then rollers
  methods::rectangles::RectangleForces::Parts parts;
  particles::ParticleSupports<2> supports;  ///< what is held and moved, and gravity
  Index elements = 0;
  std::vector<Index> case_block;  ///< of the case, by block of the outlines: an image may hold several
};

/// Throws UserError when a block holds no element, an image cannot be read, blocks or supports overlap, or a support holds
/// nothing.
Assembly assemble(const cases::CaseFile& file);

}  // namespace sazare::runs
