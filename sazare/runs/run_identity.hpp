#pragma once

/// What a checkpoint belongs to: only the same case, on the same mesh, in the same program gives the same bits.

#include <string>

#include "sazare/cases/fem_case.hpp"
#include "sazare/cases/hybrid_case.hpp"
#include "sazare/cases/rectangles_case.hpp"
#include "sazare/cases/spheres_case.hpp"
#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/observe/checkpoint.hpp"

namespace sazare::runs {

struct RunIdentity {
  std::string case_text;  ///< resolved, without what does not change the results
  std::string mesh;       ///< hash of nodes, elements and groups
  std::string tables;     ///< hash of the pressure tables
  std::string program;    ///< version, commit, compiler and the sizes of the records
};

RunIdentity identify(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh);

/// `filling` is a hash of where the particles stand.
RunIdentity identify(const cases::MpsCase& mps, const std::string& filling);

/// `assembly` is a hash of where the elements stand.
RunIdentity identify(const cases::RectanglesCase& rectangles, const std::string& assembly);

/// `start` is a hash of where spheres and walls stand at the start.
RunIdentity identify(const cases::SpheresCase& spheres, const std::string& start);

/// `mesh` is a hash of nodes, elements and groups.
RunIdentity identify(const cases::FemCase& fem, const std::string& mesh);

/// Of a hybrid case, from those of its two sides.
RunIdentity identify(const cases::HybridCase& hybrid, const RunIdentity& continuum, const RunIdentity& bodies);

void write_identity(observe::CheckpointWriter& out, const RunIdentity& identity);

/// Throws UserError saying what has changed when the checkpoint belongs to another run.
void check_identity(const observe::CheckpointReader& in, const std::filesystem::path& folder, const RunIdentity& identity);

}  // namespace sazare::runs
