#include "sazare/methods/fem/run/drains.hpp"

#include <fmt/format.h>

#include <set>

#include "sazare/methods/fem/case/case.hpp"

namespace sazare::runs {
namespace {

/// Nodes of saturated ground through which water flows.
std::set<Index> nodes_with_flow(const cases::FemCase& given, const methods::fem::BodyDescription& body) {
  std::set<Index> nodes;
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
    const cases::FemMaterial& material = given.materials[at(body.material[e])];
    const auto list = body.mesh.elements[e].node_list();
    if (!material.water_table || material.drainage != cases::Drainage::flow) continue;
    if (methods::fem::centre(body.mesh, body.mesh.elements[e])[body.mesh.dimension - 1] < *material.water_table)
      nodes.insert(list.begin(), list.end());
  }
  return nodes;
}

/// Nodes of a group, with those across a joint at the same places.
std::set<Index> nodes_on_both_sides(const geometry::ElementGroup& group, const methods::fem::BodyDescription& body) {
  std::set<Index> nodes;
  for (const geometry::MeshElement& face : group.elements) nodes.insert(face.node_list().begin(), face.node_list().end());
  std::set<Index> across;
  for (const auto& set : body.joints)
    for (const auto& face : set.faces)
      for (std::size_t i = 0; i < face.first.node_list().size(); ++i) {
        if (nodes.contains(face.first.nodes[i])) across.insert(face.second.nodes[i]);
        if (nodes.contains(face.second.nodes[i])) across.insert(face.first.nodes[i]);
      }
  nodes.merge(across);
  return nodes;
}

}  // namespace

std::vector<Index> drained_nodes(const cases::CaseFile& file, const methods::fem::BodyDescription& body, const MeshNames& names) {
  const auto& given = file.as<cases::FemCase>();
  const std::set<Index> flows = nodes_with_flow(given, body);
  std::set<Index> drained;
  for (std::size_t i = 0; i < given.drains.size(); ++i) {
    const std::string key = fmt::format("drains.{}.group", i);
    bool drains = false;
    for (const Index node : nodes_on_both_sides(names.group(key, given.drains[i].group, true), body))
      if (flows.contains(node)) {
        drained.insert(node);
        drains = true;
      }
    if (!drains)
      refuse(file, key, fmt::format("the group \"{}\" has no node of ground through which water flows", given.drains[i].group),
             "a drain needs ground with drainage = \"flow\" beside it, below its water table; remove it elsewhere");
  }
  for (std::size_t i = 0; i < given.waters.size(); ++i)
    if (!given.waters[i].in_joint())
      for (const geometry::MeshElement& face :
           names.group(fmt::format("water_pressures.{}.group", i), given.waters[i].group, true).elements)
        for (const Index node : face.node_list())
          if (flows.contains(node) && body.mesh.nodes[at(node)][body.mesh.dimension - 1] <= given.waters[i].level)
            drained.insert(node);
  return {drained.begin(), drained.end()};
}

}  // namespace sazare::runs
