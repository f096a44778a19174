#pragma once

/// What can be wrong with the water in the ground of a case, once its mesh is there. With time.strict it is refused.

#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"

namespace sazare::runs {

/// Warns of water tables that lie below all ground or cut elements, of open water with another level than the table of the ground
/// under it, and of ground so dense or elements so large that no water flows from one to the next within the run.
std::string warn_of_ground_water(const cases::CaseFile& file, const methods::fem::BodyDescription& body, const MeshNames& names);

/// Warns of loads and water on sides that are tied.
std::string warn_of_loaded_ties(const cases::CaseFile& file, const MeshNames& names);

/// Warns of boundaries with a motion that hold ground up while it settles under its weight.
std::string warn_of_hanging_ground(const cases::CaseFile& file, const geometry::ElementMesh& mesh, const MeshNames& names);

}  // namespace sazare::runs
