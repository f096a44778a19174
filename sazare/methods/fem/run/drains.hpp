#pragma once

/// Where pore water of a case is free to flow out and in.

#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"

namespace sazare::runs {

/// Nodes of the faces of drains and of those under open water.
std::vector<Index> drained_nodes(const cases::CaseFile& file, const methods::fem::BodyDescription& body, const MeshNames& names);

}  // namespace sazare::runs
