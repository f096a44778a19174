#pragma once

#include "sazare/particles/uniform_stepper.hpp"
#include "sazare/runs/motion_table.hpp"

namespace sazare::runs {

/// The first `count` particles; elements of rectangles stand before their supports.
template <int D>
void read_particles(const particles::UniformStepper<D>& stepper, Index count, MotionTable& table);

extern template void read_particles(const particles::UniformStepper<2>&, Index, MotionTable&);
extern template void read_particles(const particles::UniformStepper<3>&, Index, MotionTable&);

}  // namespace sazare::runs
