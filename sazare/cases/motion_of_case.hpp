#pragma once

#include <optional>
#include <span>
#include <string>

#include "sazare/cases/tables.hpp"

namespace sazare::cases {

/// The motion that a case describes.
laws::GroundMotion motion_of_case(const Motion& motion);

/// The motion of this name among those of a case; nothing for an empty name.
std::optional<laws::GroundMotion> motion_named(std::span<const Motion> motions, const std::string& name);

/// A constant velocity from 0 to the end of a run.
laws::GroundMotion constant_velocity(Real velocity, Real end);

}  // namespace sazare::cases
