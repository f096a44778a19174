#include "sazare/methods/blocks/run/blasting/blast_walls.hpp"

#include <fmt/format.h>

#include "sazare/cases/format/number_text.hpp"

namespace sazare::runs {

namespace {

constexpr Real widest_hole = 2;    // [m]
constexpr Real nearly_flat = 0.9;  // resultant of the faces over their area

std::string warn_of_wall(const cases::CaseFile& file, const std::string& key, const HoleWall& wall) {
  const auto number = [](Real value) { return cases::short_number(value, 3); };
  const Real open = wall.open.norm() / wall.area;
  if (!wall.closes()) {
    if (open > nearly_flat) return "";
    return warning(
        file, key,
        fmt::format("the faces of this surface turn around, but do not close: {} % of the pressure pushes the body as a "
                    "whole",
                    number(100 * open)),
        "does the group have the whole wall of the hole? Half a hole at a plane of symmetry needs a boundary there");
  }
  std::string text;
  if (wall.diameter > widest_hole)
    text += warning(file, key, fmt::format("the hole is {} m across", number(wall.diameter)),
                    fmt::format("if the mesh is in millimetres, set scale = 0.001 in [mesh]: it is then {} m across",
                                number(1e-3 * wall.diameter)));
  if (wall.has_axis() && wall.around() < HoleWall::few_faces)
    text += warning(file, key, fmt::format("the hole has about {:.0f} faces around", wall.around()),
                    "use eight or more, so that the pressure acts evenly: mesh the wall of the hole more finely");
  return text;
}

}  // namespace

std::vector<HoleWall> find_blast_walls(const cases::BlocksCase& blocks, const MeshFaces& faces) {
  std::vector<HoleWall> walls;
  for (const cases::Blast& blast : blocks.blasts) {
    const auto outer = faces.outer(blast.surface);
    walls.push_back(outer.empty() ? HoleWall{} : measure_wall(faces.mesh, outer));
  }
  return walls;
}

std::string warn_of_blast_walls(const cases::CaseFile& file, const std::vector<HoleWall>& walls) {
  std::string text;
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (walls[i].area > 0) text += warn_of_wall(file, fmt::format("blasts.{}.surface", i), walls[i]);
  return text;
}

}  // namespace sazare::runs
