#pragma once

#include "sazare/methods/fem/stepper.hpp"
#include "sazare/runs/motion_table.hpp"

namespace sazare::runs {

/// Nodes of finite elements.
template <int D>
void read_nodes(const methods::fem::FemStepper<D>& stepper, MotionTable& table);

extern template void read_nodes(const methods::fem::FemStepper<2>&, MotionTable&);
extern template void read_nodes(const methods::fem::FemStepper<3>&, MotionTable&);

}  // namespace sazare::runs
