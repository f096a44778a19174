#include "sazare/methods/fem/run/pore_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;
using cases::short_number;

/// How much of an element's height a table may lie above or below its end: meshes are no more accurate.
constexpr Real slack = 0.05;

std::string tell(const cases::CaseFile& file, const std::string& key, const std::string& what, const std::string& help) {
  if (file.as<cases::FemCase>().time.strict) refuse(file, key, what, help);
  return warning(file, key, what, help);
}

struct Heights {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;

  void add(Real elevation) {
    low = std::min(low, elevation);
    high = std::max(high, elevation);
  }
  Real size() const { return high - low; }
};

Heights heights_of(const geometry::ElementMesh& mesh, std::span<const Index> nodes) {
  Heights found;
  for (const Index node : nodes) found.add(mesh.nodes[at(node)][mesh.dimension - 1]);
  return found;
}

/// A material's water table against its elements.
std::string warn_of_table(const cases::CaseFile& file, const fem::BodyDescription& body, std::size_t number) {
  const cases::FemMaterial& material = file.as<cases::FemCase>().materials[number];
  const Real table = *material.water_table;
  const std::string key = fmt::format("materials.{}.water_table", number);
  Heights ground;
  int cut = 0;
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
    if (at(body.material[e]) != number) continue;
    const Heights element = heights_of(body.mesh, body.mesh.elements[e].node_list());
    ground.add(element.low);
    ground.add(element.high);
    cut += table > element.low + slack * element.size() && table < element.high - slack * element.size() ? 1 : 0;
  }
  if (table <= ground.low)
    return tell(
        file, key,
        fmt::format("the water table at {} m lies below all ground of \"{}\", which begins at {} m: none of it is saturated",
                    short_number(table), material.name, short_number(ground.low)),
        fmt::format("the table is an elevation, {} in the coordinates of the mesh; remove it where the ground is dry",
                    "xyz"[body.mesh.dimension - 1]));
  if (cut == 0 || material.drainage == cases::Drainage::drained) return "";
  return tell(file, key,
              fmt::format("the water table cuts {} of \"{}\", each of which is saturated or dry as a whole",
                          cases::counted(cut, "elements"), material.name),
              "let the table run along sides of elements");
}

/// How far water flows within the run, against the elements through which it leaves [m].
std::string warn_of_slow_flow(const cases::CaseFile& file, const fem::BodyDescription& body, std::size_t number) {
  const auto& given = file.as<cases::FemCase>();
  const cases::FemMaterial& material = given.materials[number];
  const Real weight = -material.pore_water_density * given.gravity.acceleration[body.mesh.dimension - 1];
  if (material.drainage != cases::Drainage::flow || !(weight > 0)) return "";
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
    if (at(body.material[e]) == number) least = std::min(least, heights_of(body.mesh, body.mesh.elements[e].node_list()).size());
  const Real softness = 1 / material.constrained_modulus() + material.porosity / material.water_bulk_modulus;
  const Real way = std::sqrt(material.hydraulic_conductivity / (weight * softness) * given.time.end);
  if (!(way < least)) return "";
  return tell(
      file, fmt::format("materials.{}.hydraulic_conductivity", number),
      fmt::format("within the run water flows over {} m of \"{}\", less than the height of its elements, {} m and more: what "
                  "settles at once beside drains is that of the mesh",
                  short_number(way, 2), material.name, short_number(least, 2)),
      "set drainage = \"undrained\", or give elements near drains a small part of that height");
}

/// An open water against the ground under it: the first face with another table.
std::string warn_of_level(const cases::CaseFile& file, const fem::BodyDescription& body, const MeshNames& names,
                          std::size_t number) {
  const auto& given = file.as<cases::FemCase>();
  const cases::FemWater& water = given.waters[number];
  if (water.in_joint() || water.far_level) return "";
  const std::string key = fmt::format("water_pressures.{}", number);
  const auto& group = names.group(key + ".group", water.group, true);
  const auto beside = geometry::elements_beside(body.mesh, group);
  bool is_on_saturated = false;
  for (std::size_t i = 0; i < beside.size(); ++i) {
    if (beside[i] < 0) continue;
    const cases::FemMaterial& material = given.materials[at(body.material[at(beside[i])])];
    const Heights face = heights_of(body.mesh, group.elements[i].node_list());
    if (!material.water_table || face.low >= std::max(*material.water_table, water.level)) continue;
    is_on_saturated = true;
    if (std::abs(*material.water_table - water.level) > 1e-6)
      return tell(
          file, key + ".level",
          fmt::format("the water \"{}\" stands at {} m, and the water table of \"{}\" under it at {} m: the difference loads "
                      "the skeleton of the ground as if it were no water",
                      water.name, short_number(water.level), material.name, short_number(*material.water_table)),
          "give both the same elevation; the water in the ground stays as it is at the beginning");
  }
  if (!is_on_saturated || water.ramp == 0) return "";
  return tell(
      file, key + ".ramp",
      fmt::format("the water \"{}\" comes with a ramp, but the water in the ground under it is there from the beginning, and "
                  "pushes the surface out meanwhile",
                  water.name),
      "remove the ramp; settle begins in equilibrium with the water");
}

std::set<Index> nodes_of(const geometry::ElementGroup& group) {
  std::set<Index> nodes;
  for (const auto& face : group.elements) nodes.insert(face.node_list().begin(), face.node_list().end());
  return nodes;
}

}  // namespace

std::string warn_of_ground_water(const cases::CaseFile& file, const fem::BodyDescription& body, const MeshNames& names) {
  const auto& given = file.as<cases::FemCase>();
  std::string all;
  for (std::size_t m = 0; m < given.materials.size(); ++m)
    if (given.materials[m].water_table) all += warn_of_table(file, body, m) + warn_of_slow_flow(file, body, m);
  for (std::size_t i = 0; i < given.waters.size(); ++i) all += warn_of_level(file, body, names, i);
  return all;
}

std::string warn_of_loaded_ties(const cases::CaseFile& file, const MeshNames& names) {
  const auto& given = file.as<cases::FemCase>();
  std::set<std::set<Index>> tied;
  const auto add = [&](const std::string& key, const std::string& group) {
    for (const auto& face : names.group(key, group, false).elements)
      tied.insert({face.node_list().begin(), face.node_list().end()});
  };
  for (std::size_t i = 0; i < given.ties.size(); ++i) {
    add(fmt::format("ties.{}.group", i), given.ties[i].group);
    add(fmt::format("ties.{}.opposite", i), given.ties[i].opposite);
  }
  const auto look = [&](const std::string& key, const std::string& group, const std::string& what) -> std::string {
    const auto is_tied = [&](const geometry::MeshElement& face) {
      return tied.contains({face.node_list().begin(), face.node_list().end()});
    };
    if (std::ranges::none_of(names.group(key, group, true).elements, is_tied)) return "";
    return tell(file, key, fmt::format("{} acts on a side that is tied, which is not there in nature: it moves both sides", what),
                "put it on outer faces, or untie the side");
  };
  std::string all;
  if (tied.empty()) return all;
  for (std::size_t i = 0; i < given.loads.size(); ++i)
    all += look(fmt::format("loads.{}.group", i), given.loads[i].group, fmt::format("the load \"{}\"", given.loads[i].name));
  for (std::size_t i = 0; i < given.waters.size(); ++i)
    if (!given.waters[i].in_joint())
      all += look(fmt::format("water_pressures.{}.group", i), given.waters[i].group,
                  fmt::format("the water \"{}\"", given.waters[i].name));
  return all;
}

std::string warn_of_hanging_ground(const cases::CaseFile& file, const geometry::ElementMesh& mesh, const MeshNames& names) {
  const auto& given = file.as<cases::FemCase>();
  const auto up = static_cast<std::size_t>(mesh.dimension - 1);
  std::string all;
  if (!given.gravity.settle || !(given.gravity.acceleration[mesh.dimension - 1] < 0)) return all;
  Heights body;
  for (const Vector3& node : mesh.nodes) body.add(node[mesh.dimension - 1]);
  for (std::size_t i = 0; i < given.boundaries.size(); ++i) {
    const cases::GroupBoundary& boundary = given.boundaries[i];
    if (boundary.kind != cases::GroupKind::prescribed || boundary.motion[up].empty()) continue;
    const std::set<Index> nodes = nodes_of(names.group(fmt::format("boundaries.{}.group", i), boundary.group, false));
    const std::vector<Index> list(nodes.begin(), nodes.end());
    if (heights_of(mesh, list).low <= body.low + 1e-6 * body.size()) continue;
    all +=
        tell(file, fmt::format("boundaries.{}", i),
             fmt::format("while the body settles under gravity the group \"{}\" stands still, and the ground below hangs on it",
                         boundary.group),
             "leave settle out, or press the group with one of [[loads]] instead of moving it");
  }
  return all;
}

}  // namespace sazare::runs
