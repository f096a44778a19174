#pragma once

#include "sazare/levels/simulation.hpp"
#include "sazare/runs/motion_table.hpp"

namespace sazare::runs {

/// Elements of method blocks, at a base step.
void read_bodies(const levels::Simulation<3>& simulation, MotionTable& table);


}  // namespace sazare::runs
