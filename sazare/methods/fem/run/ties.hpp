#pragma once

/// Tied sides of a case on its mesh.

#include "sazare/methods/fem/run/mesh_names.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::runs {

/// Each node of the tied groups with the one opposite, whose displacement it has. Throws UserError where a node has none opposite, or
/// where the two are not held alike.
template <int D>
std::vector<std::pair<Index, Index>> tied_nodes(const cases::CaseFile& file, const geometry::ElementMesh& mesh, const MeshNames& names,
                                                const methods::fem::Supports<D>& supports);

}  // namespace sazare::runs
