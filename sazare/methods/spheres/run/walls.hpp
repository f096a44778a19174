#pragma once

/// The walls of a case of method spheres.

#include <string>

#include "sazare/methods/spheres/run/placing/placement.hpp"
#include "sazare/methods/spheres/wall.hpp"

namespace sazare::runs {

struct CaseWalls {
  std::vector<methods::spheres::Wall> walls;
  std::vector<Index> entry;        ///< by wall: of [[walls]]; a box has six
  std::vector<std::string> notes;  ///< what is to be told of those of triangles
};

/// Throws UserError when a surface cannot be read, or turns where it would have to repeat itself, or spheres begin within a wall.
CaseWalls make_walls(const cases::CaseFile& file, const Placement& placement);

}  // namespace sazare::runs
