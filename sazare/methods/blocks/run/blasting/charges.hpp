#pragma once

/// The charges of a case, and the faces that their gas may press on.

#include <vector>

#include "sazare/methods/blocks/charges/crack_gas.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

std::vector<methods::blocks::Charge> make_charges(const cases::BlocksCase& blocks);

/// Whether a face of the wall of its hole, given by its corners, has explosive of the charge beside it.
bool stands_along(const cases::Charge& charge, const std::array<Vector3, 3>& corners);

/// The share of the length of such a face along the hole that has explosive beside it.
Real covered_share(const cases::Charge& charge, const std::array<Vector3, 3>& corners);

/// Faces of the walls of holes that stand beside the explosive of a charge; one between two decks is a face of both.
std::vector<methods::blocks::ChargedFace> make_charged_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                             const state::Bodies<3>& bodies);

/// Whether the gas of any charge goes into cracks.
bool has_gas_in_cracks(const cases::BlocksCase& blocks);

/// The faces that gas may come to. It leaves through outer faces without a boundary; a plane of symmetry and ground that goes on
/// are closed.
methods::blocks::GasFaces make_gas_faces(const cases::BlocksCase& blocks, const MeshFaces& faces);

}  // namespace sazare::runs
