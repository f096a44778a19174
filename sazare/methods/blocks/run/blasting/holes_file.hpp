#pragma once

#include <filesystem>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

/// Writes holes.csv: a row for every charge, and for every blast whose wall closes around a hole.
void write_holes(const std::filesystem::path& file, const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh);

}  // namespace sazare::runs
