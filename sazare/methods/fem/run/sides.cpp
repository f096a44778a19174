#include "sazare/methods/fem/run/sides.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;

/// Whether a group of outer faces goes on beyond the upper edge of a side.
template <int D>
bool covers_surface(const geometry::ElementGroup& group, const fem::FreeFieldSide<D>& side) {
  const auto is_on = [](const geometry::MeshElement& face, Index node) { return std::ranges::count(face.node_list(), node) > 0; };
  const auto is_of_side = [&](const geometry::MeshElement& face) {
    return std::ranges::any_of(side.surface,
                               [&](const auto& own) { return std::ranges::is_permutation(own.node_list(), face.node_list()); });
  };
  return std::ranges::all_of(side.levels.back(), [&](Index node) {
    return std::ranges::any_of(group.elements, [&](const auto& face) { return is_on(face, node) && !is_of_side(face); });
  });
}

/// A traction on the top of a column.
template <int D>
fem::Load on_top(const fem::SoilColumn<D>& column, const std::string& name, const Vector3& traction, Real ramp) {
  const std::size_t nodes = column.body.mesh.nodes.size();
  fem::Load load{name, fem::NodalColumn(nodes * D, 0), ramp};
  for (int axis = 0; axis < D; ++axis) load.force[fem::number<D>(static_cast<Index>(nodes - 1), axis)] = traction[axis];
  return load;
}

/// Loads, open water and drains go on over the ground beside the side.
template <int D>
void load_surface(const cases::FemCase& given, const MeshNames& names, fem::FreeFieldSide<D>& side) {
  fem::SoilColumn<D>& column = *side.column;
  const auto top = static_cast<Index>(column.body.mesh.nodes.size() - 1);
  for (std::size_t i = 0; i < given.drains.size(); ++i)
    if (covers_surface(names.group(fmt::format("drains.{}.group", i), given.drains[i].group, true), side))
      column.supports.drained.push_back(top);
  for (std::size_t i = 0; i < given.loads.size(); ++i) {
    const cases::FemLoad& load = given.loads[i];
    if (covers_surface(names.group(fmt::format("loads.{}.group", i), load.group, true), side))
      column.supports.loads.push_back(on_top(column, load.name, load.traction, load.ramp));
  }
  for (std::size_t i = 0; i < given.waters.size(); ++i) {
    const cases::FemWater& water = given.waters[i];
    if (water.in_joint() || !covers_surface(names.group(fmt::format("water_pressures.{}.group", i), water.group, true), side))
      continue;
    const Real depth = water.level - column.body.mesh.nodes.back()[D - 1];
    Vector3 traction = Vector3::Zero();
    traction[D - 1] = std::max(depth, Real{0}) * water.density * given.gravity.acceleration[D - 1];
    fem::StillWater<D> still;
    still.pressure = on_top(column, water.name, traction, water.ramp);
    still.force = traction.template head<D>();
    column.supports.waters.push_back(std::move(still));
    if (depth > 0) column.supports.drained.push_back(top);
  }
}

}  // namespace

template <int D>
void add_sides(const cases::CaseFile& file, const fem::BodyDescription& body, const MeshNames& names,
               fem::Supports<D>& supports) {
  const auto& given = file.as<cases::FemCase>();
  std::set<Index> of_viscous;
  for (const auto& boundary : supports.viscous) of_viscous.insert(boundary.nodes.begin(), boundary.nodes.end());
  for (std::size_t i = 0; i < given.boundaries.size(); ++i) {
    if (given.boundaries[i].kind != cases::GroupKind::free_field) continue;
    const std::string key = fmt::format("boundaries.{}.group", i);
    const auto& group = names.outer_group(key, given.boundaries[i].group, "no column can stand beside it");
    try {
      for (auto& side : fem::free_field_sides<D>(body, group, static_cast<Index>(i))) {
        stand_on_base(side, supports);
        load_surface(given, names, side);
        std::erase_if(side.nodes, [&](Index node) { return of_viscous.contains(node); });
        supports.sides.push_back(std::move(side));
      }
    } catch (const fem::UnfitSide& unfit) {
      refuse(file, key, unfit.what(), unfit.help());
    }
  }
}

template <int D>
std::string side_lines(const fem::Supports<D>& supports, const std::vector<std::string>& boundary_names) {
  std::string text;
  for (const auto& side : supports.sides) {
    const auto& mesh = side.column->body.mesh;
    const auto layers = supports.wave ? std::string("the wave in its layers")
                                      : "a column of " + cases::counted(std::ssize(mesh.elements), "elements");
    text += cases::line(
        "free field", fmt::format("{} at {} = {} m: {} from {} to {} m", boundary_names[at(side.boundary)], "xy"[side.across],
                                  cases::short_number(mesh.nodes.front()[side.across]), layers,
                                  cases::short_number(mesh.nodes.front()[D - 1]), cases::short_number(mesh.nodes.back()[D - 1])));
  }
  return text;
}

#define SAZARE_INSTANTIATE(D)                                                                                           \
  template void add_sides<D>(const cases::CaseFile&, const fem::BodyDescription&, const MeshNames&, fem::Supports<D>&); \
  template std::string side_lines<D>(const fem::Supports<D>&, const std::vector<std::string>&);
SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::runs
