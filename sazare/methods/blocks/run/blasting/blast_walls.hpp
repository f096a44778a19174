#pragma once

/// Whether the surfaces on which blasts press are the whole walls of holes as they are in the field.

#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

/// By entry of [[blasts]]; without area where a blast has no outer faces.
std::vector<HoleWall> find_blast_walls(const cases::BlocksCase& blocks, const MeshFaces& faces);

/// Warnings ready to print, each at its line of the case.
std::string warn_of_blast_walls(const cases::CaseFile& file, const std::vector<HoleWall>& walls);

}  // namespace sazare::runs
