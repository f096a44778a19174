#pragma once

#include <filesystem>

namespace sazare::geometry {

/// A .geo is a program: Gmsh runs the commands and writes the files that it names. Refuses (UserError) a geometry that does more
/// than describe shapes: runs commands, writes files, or reads files outside of its own folder; and what it includes, and the
/// options beside it (.geo.opt).
void refuse_what_reaches_outside(const std::filesystem::path& geometry);

/// Whether the user said that geometries are to be trusted: SAZARE_TRUST_GEOMETRY is 1 in the environment, as --trust-geometry
/// sets it.
bool geometries_are_trusted();

}  // namespace sazare::geometry
