#pragma once

#include "sazare/cases/tables.hpp"

namespace sazare::cases {

/// The motion that a case describes.
laws::GroundMotion motion_of_case(const Motion& motion);

/// A constant velocity from 0 to the end of a run.
laws::GroundMotion constant_velocity(Real velocity, Real end);

}  // namespace sazare::cases
