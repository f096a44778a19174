#pragma once

/// What the springs of the joints imply for the bar at rest: their stiffness matrix, assembled here and solved without the
/// engine.

#include "validation/analytic/bar-wave-speed/bar.hpp"

namespace sazare::validation {

struct BarModuli {
  Real axial = 0;    ///< force over strain, E A with free sides [N]
  Real poisson = 0;  ///< lateral contraction over strain
  Real torsion = 0;  ///< torque over twist, G J [N m2]
};

/// Per unit area [Pa/m].
struct JointStiffness {
  Real normal = 0;
  Real shear = 0;
};

/// Pulls and twists the bar by loads on its end blocks and measures its middle half.
BarModuli static_moduli(const geometry::TetraMesh& mesh, const JointStiffness& joint, Sides sides);

}  // namespace sazare::validation
