#pragma once

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// What checkpoints of a case on a mesh belong to.
RunIdentity identify(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh);

}  // namespace sazare::runs
