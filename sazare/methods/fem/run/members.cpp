#include "sazare/methods/fem/run/members.hpp"

#include <fmt/format.h>

#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;

/// From node to node along the lines of a group; a quadratic line has its middle between its ends.
std::vector<std::array<Index, 2>> lines_of(const cases::CaseFile& file, const std::string& key,
                                           const geometry::ElementGroup& group) {
  std::vector<std::array<Index, 2>> lines;
  for (const geometry::MeshElement& line : group.elements) {
    if (geometry::facts(line.shape).dimension != 1)
      refuse(file, key, fmt::format("the group \"{}\" has no lines, along which a member could run", group.name),
             "name a physical curve of the mesh");
    const bool quadratic = line.shape == geometry::ElementShape::line3;
    lines.push_back({line.nodes[0], line.nodes[quadratic ? 2 : 1]});
    if (quadratic) lines.push_back({line.nodes[2], line.nodes[1]});
  }
  return lines;
}

Index node_at(const cases::CaseFile& file, const std::string& key, const Vector3& place, const geometry::ElementMesh& mesh) {
  std::size_t nearest = 0;
  Vector3 low = mesh.nodes.front(), high = low;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    low = low.cwiseMin(mesh.nodes[i]);
    high = high.cwiseMax(mesh.nodes[i]);
    if ((mesh.nodes[i] - place).norm() < (mesh.nodes[nearest] - place).norm()) nearest = i;
  }
  const Real distance = (mesh.nodes[nearest] - place).norm();
  if (distance > 0.01 * (high - low).norm())
    refuse(file, key, fmt::format("the nearest node is {} m away", cases::short_number(distance, 3)),
           "members end at nodes of the mesh: give it a point there");
  return static_cast<Index>(nearest);
}

}  // namespace

std::vector<fem::MemberSet> make_members(const cases::CaseFile& file, const geometry::ElementMesh& mesh, const MeshNames& names) {
  std::vector<fem::MemberSet> sets;
  const auto& members = file.as<cases::FemCase>().members;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const cases::FemMember& given = members[i];
    const std::string key = fmt::format("members.{}", i);
    fem::MemberSet set;
    set.name = given.name;
    set.kind = static_cast<fem::MemberKind>(given.kind);
    set.youngs_modulus = given.youngs_modulus;
    set.damping_ratio = given.damping_ratio;
    set.density = given.density;
    const Real share = 1 / given.spacing;
    set.area = share * given.area;
    set.second_moment = share * given.second_moment;
    set.prestress = share * given.prestress;
    if (given.yield_force) set.yield_force = share * *given.yield_force;
    if (given.compression_force) set.compression_force = share * *given.compression_force;
    if (given.yield_moment) set.yield_moment = share * *given.yield_moment;
    set.stiffness = share * given.stiffness;
    set.damping = share * given.damping;
    if (given.on_group())
      set.lines = lines_of(file, key + ".group", names.group(key + ".group", given.group, false));
    else
      set.lines = {{node_at(file, key + ".from", given.from, mesh), node_at(file, key + ".to", given.to, mesh)}};
    if (!given.on_group() && set.lines[0][0] == set.lines[0][1])
      refuse(file, key + ".to", fmt::format("both ends of the member \"{}\" are at one node", given.name),
             "give it ends at different nodes of the mesh");
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace sazare::runs
