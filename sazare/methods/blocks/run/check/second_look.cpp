#include "sazare/methods/blocks/run/check/second_look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"
#include "sazare/methods/blocks/run/block_fragments.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {
namespace {

using cases::line;
using cases::number;

std::string mass_text(const BlocksModel& model) {
  Real mass = 0;
  for (const auto& inertia : model.simulation->bodies().inertia) mass += inertia.mass;
  return line("mass", cases::mass_text(mass));
}

/// The largest pressure of a blast; 0 where it is a function, which only its caller knows [Pa].
Real peak_of(const cases::Blast& blast) {
  if (const auto* pulse = std::get_if<cases::PressurePulse>(&blast.pressure)) return pulse->peak_pressure;
  const auto* table = std::get_if<cases::PressureTable>(&blast.pressure);
  return table == nullptr || table->pressure.empty() ? 0 : std::ranges::max(table->pressure);
}

std::string hole_text(const cases::Blast& blast, const HoleWall& wall) {
  const Real peak = peak_of(blast);
  if (!wall.closes())
    return line("loads",
                fmt::format("{}: {} m2 that do not close around a hole: the pressure pushes the body with the resultant of "
                            "{} % of its faces{}",
                            blast.name, number(wall.area), cases::short_number(100 * wall.open.norm() / wall.area, 2),
                            peak > 0 ? fmt::format(", {} N at its peak", number(peak * wall.open.norm())) : ""));
  std::string text = line("holes", fmt::format("{}: {}", blast.name, size_text(wall)));
  if (peak > 0)
    text += line("", fmt::format("  peak pressure times volume {} J; filled with ANFO of {} kg/m3, {} kg would give {} J",
                                 number(peak * wall.volume), number(laws::anfo.density), number(laws::anfo.density * wall.volume),
                                 number(laws::anfo.energy * wall.volume)));
  return text;
}

/// The holes of the charges, and how much explosive there is for the rock.
std::string charges_text(const cases::BlocksCase& blocks, const BlocksModel& model) {
  if (blocks.charges.empty()) return "";
  std::string text;
  std::set<std::string> seen;
  Real explosive = 0;
  for (std::size_t i = 0; i < blocks.charges.size(); ++i) {
    const cases::Charge& charge = blocks.charges[i];
    explosive += charge.filling().density * charge.volume();
    if (seen.insert(charge.surface).second)
      text += line("holes", fmt::format("{}: {} m across, {} m long, about {:.0f} faces around", charge.surface,
                                        number(charge.diameter), number(charge.hole_length()), model.fit.charges[i].around));
  }
  return text + line("explosive", fmt::format("{} kg in all, {} kg per m3 of the mesh", number(explosive),
                                              number(explosive / geometry::volume(model.mesh))));
}

/// Axes along which boundaries and constraints hold each element, a bit per axis. Absorbing faces carry nothing at rest; of faces
/// without friction the axis nearest to their normal counts.
std::vector<int> held_axes(const cases::BlocksCase& blocks, const BlocksModel& model, const MeshFaces& faces) {
  const auto& locks = model.simulation->bodies().locks;
  std::vector<int> held(locks.size(), 0);
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = locks[i].translation;
  for (const cases::Boundary& boundary : blocks.boundaries) {
    if (boundary.kind == cases::BoundaryKind::absorbing) continue;
    for (const geometry::OuterFace& face : faces.outer(boundary.surface)) {
      const auto corner = [&](std::size_t k) { return model.mesh.nodes[at(face.nodes[k])]; };
      Eigen::Index axis = 0;
      (corner(1) - corner(0)).cross(corner(2) - corner(0)).cwiseAbs().maxCoeff(&axis);
      held[at(face.element)] |= boundary.holds_all_axes() ? 7 : 1 << axis;
    }
  }
  return held;
}

/// Whether the whole body is lighter than the water around it.
std::string floating_text(const cases::BlocksCase& blocks, const BlocksModel& model) {
  Real mass = 0, volume = 0;
  for (std::size_t element = 0; element < model.material.size(); ++element) {
    mass += model.simulation->bodies().inertia[element].mass;
    volume += model.simulation->bodies().inertia[element].mass / blocks.materials[at(model.material[element])].density;
  }
  return fmt::format("its mean density is {} kg/m3, that of the water {} kg/m3: it {}", number(mass / volume),
                     number(blocks.water.density), mass < blocks.water.density * volume ? "floats" : "sinks");
}

/// How many pieces nothing holds, with the place of the largest.
std::string held_text(const cases::BlocksCase& blocks, const BlocksModel& model, const MeshFaces& faces) {
  const std::vector<int> held = held_axes(blocks, model, faces);
  const auto count = std::ranges::count_if(held, [](int axes) { return axes != 0; });
  int axes = 0;
  for (const int own : held) axes |= own;
  const FragmentMap pieces = find_fragments(static_cast<Index>(held.size()), *model.joints);
  std::set<Index> holds;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] != 0) holds.insert(pieces.of_element[i]);
  const auto free = pieces.count - static_cast<Index>(holds.size());
  std::string text = cases::counted(count, "elements") + " by boundaries and constraints";
  const auto names = [&](int of) {
    std::string axis_names;
    for (int axis = 0; axis < 3; ++axis)
      if (of >> axis & 1) axis_names += fmt::format("{}{}", axis_names.empty() ? "" : ", ", "xyz"[axis]);
    return axis_names;
  };
  if (count > 0 && axes != 7) text += fmt::format(" along {}; nothing is held along {}", names(axes), names(7 & ~axes));
  if (free == 0) return line("held", text);
  std::size_t first = 0;
  while (holds.contains(pieces.of_element[first])) ++first;
  const Real fall = 0.5 * blocks.gravity.acceleration.norm() * blocks.time.end * blocks.time.end;
  text += pieces.count == 1 ? std::string("; nothing holds the body")
                            : fmt::format("; nothing holds {} of {} pieces, such as that of the element at {} m", free,
                                          pieces.count, cases::vector_text(model.simulation->bodies().start[first]));
  const bool rests = pieces.count == 1 && !blocks.initial_stress.is_zero() && model.fit.start_balance.is_in_equilibrium();
  if (rests)
    text += "; its initial stress is in equilibrium";
  else if (blocks.water.is_there())
    text += "; " + floating_text(blocks, model);
  else if (fall > 0)
    text += fmt::format(", which falls {} m in the time of the run where it meets nothing", number(fall));
  return line("held", text);
}

}  // namespace

std::string second_look(const cases::BlocksCase& blocks, const BlocksModel& model) {
  const auto map = geometry::build_face_map(model.mesh);
  const MeshFaces faces{model.mesh, map, geometry::find_surface_faces(model.mesh, map)};
  std::string text = cases::explain_size(cases::extent_of(model.mesh.nodes)) + mass_text(model);
  for (const cases::Blast& blast : blocks.blasts)
    if (const auto wall = faces.outer(blast.surface); !wall.empty()) text += hole_text(blast, measure_wall(model.mesh, wall));
  text += charges_text(blocks, model);
  return text + explain_initial_stress(blocks, model.mesh, model.fit.start_balance) + held_text(blocks, model, faces);
}

}  // namespace sazare::runs
