#include "sazare/methods/blocks/run/mesh_fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

namespace {

std::vector<UnjoinedFaces> unjoined_faces(const MeshFaces& faces, const std::vector<Index>& material,
                                          const std::vector<Index>& joint_of_face) {
  std::vector<UnjoinedFaces> unjoined;
  for (std::size_t face = 0; face < joint_of_face.size(); ++face) {
    if (joint_of_face[face] >= 0) continue;
    const auto& shared = faces.map.interior[face];
    const auto [first, second] = std::minmax({material[at(shared.element_i)], material[at(shared.element_j)]});
    auto same = std::ranges::find_if(unjoined, [&](const UnjoinedFaces& of) { return of.first == first && of.second == second; });
    if (same == unjoined.end()) same = unjoined.insert(same, {first, second, 0});
    ++same->count;
  }
  return unjoined;
}

template <class Item>
std::vector<Index> inner_faces(const std::vector<Item>& items, const MeshFaces& faces) {
  std::vector<Index> inner(items.size(), 0);
  for (std::size_t item = 0; item < items.size(); ++item)
    for (std::size_t surface = 0; surface < faces.surfaces.size(); ++surface)
      if (faces.mesh.surfaces[surface].name == items[item].surface)
        inner[item] += static_cast<Index>(faces.surfaces[surface].interior.size());
  return inner;
}

std::string warn_of_inner_faces(const cases::CaseFile& file, const std::string& table, const std::vector<Index>& inner,
                                const std::string& what) {
  std::string all;
  for (std::size_t item = 0; item < inner.size(); ++item)
    if (inner[item] > 0)
      all += warning(file, fmt::format("{}.{}.surface", table, item),
                     fmt::format("{} faces of this surface lie between two elements: {}", inner[item], what),
                     "give the outer faces their own physical group");
  return all;
}

}  // namespace

MeshFit find_mesh_fit(const cases::BlocksCase& blocks, const MeshFaces& faces, const std::vector<Index>& material,
                      const std::vector<Index>& joint_of_face) {
  MeshFit fit;
  fit.unjoined = unjoined_faces(faces, material, joint_of_face);
  fit.faces_of_joint.resize(blocks.joints.size(), 0);
  for (const Index joint : joint_of_face)
    if (joint >= 0) ++fit.faces_of_joint[at(joint)];
  fit.inner_of_blast = inner_faces(blocks.blasts, faces);
  fit.inner_of_boundary = inner_faces(blocks.boundaries, faces);
  return fit;
}

std::string warn_of_mesh_fit(const cases::CaseFile& file, const MeshFit& fit) {
  const cases::BlocksCase& blocks = file.as<cases::BlocksCase>();
  std::string all;
  for (const UnjoinedFaces& of : fit.unjoined) {
    const std::string &first = blocks.materials[at(of.first)].name, &second = blocks.materials[at(of.second)].name;
    all += warning(
        file, fmt::format("materials.{}", of.first),
        fmt::format("{} faces between \"{}\" and \"{}\" have no joint: these elements are only in contact", of.count, first,
                    second),
        fmt::format("add [[joints]] with between = [\"{}\", \"{}\"], and bonded = false if this is intended", first, second));
  }
  for (std::size_t joint = 0; joint < fit.faces_of_joint.size(); ++joint)
    if (fit.faces_of_joint[joint] == 0)
      all += warning(file, fmt::format("joints.{}", joint),
                     fmt::format("the joint \"{}\" applies to no face of the mesh", blocks.joints[joint].name),
                     "remove it, or check whether its materials share faces and whether a later entry applies to the same faces");
  return all + warn_of_inner_faces(file, "blasts", fit.inner_of_blast, "no pressure acts on them") +
         warn_of_inner_faces(file, "boundaries", fit.inner_of_boundary, "the boundary does not apply to them");
}

}  // namespace sazare::runs
