#include "sazare/methods/fem/run/mesh_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/format/suggest.hpp"

namespace sazare::runs {

Index MeshNames::region(const std::string& key, const std::string& name) const {
  const auto found = std::ranges::find(mesh_.region_names, name);
  if (found == mesh_.region_names.end())
    refuse(source_, key, fmt::format("the mesh has no region \"{}\"", name),
           cases::full_suggestion(name, mesh_.region_names, "regions"));
  return static_cast<Index>(found - mesh_.region_names.begin());
}

const geometry::ElementGroup& MeshNames::group(const std::string& key, const std::string& name, bool of_faces) const {
  const geometry::ElementGroup* found = mesh_.find_group(name);
  std::vector<std::string> names;
  for (const auto& one : mesh_.groups) names.push_back(one.name);
  if (found == nullptr)
    refuse(source_, key, fmt::format("the mesh has no group \"{}\" of nodes, lines or faces", name),
           cases::full_suggestion(name, names, "groups"));
  if (found->elements.empty())
    refuse(source_, key, fmt::format("the group \"{}\" of the mesh has no elements", name),
           "is the physical group in the .geo file empty, or were its elements not saved?");
  if (of_faces && found->dimension != mesh_.dimension - 1)
    refuse(source_, key,
           fmt::format("the group \"{}\" is of {} dimensions; here one of {} is needed", name, found->dimension,
                       mesh_.dimension - 1),
           mesh_.dimension == 2 ? "name a physical curve" : "name a physical surface");
  if (of_faces && std::ranges::count(geometry::elements_beside(mesh_, *found), -1) > 0)
    refuse(source_, key, fmt::format("the group \"{}\" has elements that are not faces of the body", name),
           "make it part of the body's outline, with elements of the same order");
  return *found;
}

const geometry::ElementGroup& MeshNames::outer_group(const std::string& key, const std::string& name,
                                                     const std::string& nothing) const {
  const geometry::ElementGroup& found = group(key, name, true);
  if (!geometry::faces_of_group(mesh_, found).empty())
    refuse(source_, key, fmt::format("the group \"{}\" lies inside the body, where {}", name, nothing),
           "name a group of outer faces");
  return found;
}

}  // namespace sazare::runs
