#pragma once

/// Free-field sides of a case.

#include <set>

#include "sazare/methods/fem/run/mesh_names.hpp"
#include "sazare/methods/fem/soil_column.hpp"

namespace sazare::runs {

/// Adds the free-field sides of a case to the supports, once all else is in them. Their columns stand on the base of the body,
/// and bear the loads and the water on the surface beside the side. Throws UserError at a side beside which none can stand.
template <int D>
void add_sides(const cases::CaseFile& file, const methods::fem::BodyDescription& body, const MeshNames& names,
               methods::fem::Supports<D>& supports);

/// A line for each side.
template <int D>
std::string side_lines(const methods::fem::Supports<D>& supports, const std::vector<std::string>& boundary_names);

}  // namespace sazare::runs
