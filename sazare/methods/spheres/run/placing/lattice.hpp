#pragma once

/// Groups of many spheres or bodies: how many they are, and where those of a lattice stand.

#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/ball_union.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

/// Balls of the group's radius on its lattice, in the middle of its box.
std::vector<geometry::Ball> lattice(const cases::SphereGroup& group);

/// Throws UserError where a lattice or random places of a group are more spheres than this machine can hold, before they are
/// made. `of_each`: spheres at each place.
void check_count(const cases::CaseFile& file, std::size_t number, const cases::SphereGroup& group, std::size_t of_each);

}  // namespace sazare::runs
