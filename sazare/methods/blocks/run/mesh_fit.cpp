#include "sazare/methods/blocks/run/mesh_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sazare/cases/format/number_text.hpp"
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

constexpr Real edge_per_distance = 2.45;  // a regular tetrahedron's edge over the distance of two centres

/// Elements beside the softest of many faces must not be so large that what they store at the strength is more than breaking
/// takes.
struct SofteningCheck {
  std::string_view strength_key, energy_key;
  Real strength, energy, stiffness, distance;
  Real strongest = 1;  ///< factor of the strength of the strongest faces
};

void check_softening(const cases::CaseFile& file, std::size_t joint, const SofteningCheck& of) {
  const Real needed = of.strength * of.strength / (2 * of.energy);
  if (of.stiffness >= needed) return;
  const auto number = [](Real value) { return cases::short_number(value, 3); };
  const Real largest = of.distance * of.stiffness / needed;
  refuse(
      file, fmt::format("joints.{}.{}", joint, of.strength_key),
      fmt::format(
          "elements are too large for this {} and {}{}: centres on both sides of a face are {} m apart", of.strength_key,
          of.energy_key,
          of.strongest > 1 ? fmt::format(" where they are {} times the mean, at the strongest faces", number(of.strongest)) : "",
          number(of.distance)),
      fmt::format(
          "a joint would be broken before it softens; the largest distance of centres that does is {} m, edges of some {} m; "
          "with this mesh {} must be at least {} N/m, or {} at most {} Pa",
          number(largest), number(edge_per_distance * largest), of.energy_key,
          number(of.strength * of.strength / (2 * of.stiffness)), of.strength_key,
          number(std::sqrt(2 * of.energy * of.stiffness))));
}

void check_softening(const cases::CaseFile& file, const MeshFit& fit) {
  const auto& joints = file.as<cases::BlocksCase>().joints;
  for (std::size_t n = 0; n < fit.softest_of_joint.size(); ++n) {
    const SoftestFaces& softest = fit.softest_of_joint[n];
    if (softest.faces == 0 || joints[n].is_natural()) continue;
    const Real strongest = joints[n].largest_factor();
    check_softening(file, n,
                    {"tensile_strength", "fracture_energy", joints[n].tensile_strength, joints[n].fracture_energy,
                     softest.normal_stiffness / strongest, softest.normal_distance, strongest});
    laws::visit_joint_law(joints[n].law, [&]<class Law>(Law) {
      if constexpr (laws::SoftensBySlip<Law>)
        check_softening(file, n,
                        {"cohesion", Law::shear_energy, joints[n].cohesion, joints[n].law_parameter(Law::shear_energy).value(),
                         softest.shear_stiffness / strongest, softest.shear_distance, strongest});
    });
  }
}

}  // namespace

MeshFit find_mesh_fit(const cases::BlocksCase& blocks, const MeshFaces& faces, const std::vector<Index>& material,
                      const std::vector<Index>& joint_of_face) {
  MeshFit fit;
  fit.unjoined = unjoined_faces(faces, material, joint_of_face);
  fit.faces_of_joint.resize(blocks.joints.size(), 0);
  for (const Index joint : joint_of_face)
    if (joint >= 0) ++fit.faces_of_joint[at(joint)];
  fit.charges = find_charge_fits(blocks, faces);
  fit.blast_walls = find_blast_walls(blocks, faces);
  fit.inner_of_blast = inner_faces(blocks.blasts, faces);
  fit.inner_of_charge = inner_faces(blocks.charges, faces);
  fit.inner_of_boundary = inner_faces(blocks.boundaries, faces);
  return fit;
}

std::string warn_of_mesh_fit(const cases::CaseFile& file, const MeshFit& fit) {
  const cases::BlocksCase& blocks = file.as<cases::BlocksCase>();
  check_softening(file, fit);
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
  return all + warn_of_initial_stress(file, fit.overstressed, fit.start_balance) + warn_of_charges(file, fit.charges) +
         warn_of_blast_walls(file, fit.blast_walls) +
         warn_of_inner_faces(file, "blasts", fit.inner_of_blast, "no pressure acts on them") +
         warn_of_inner_faces(file, "charges", fit.inner_of_charge, "no gas presses on them") +
         warn_of_inner_faces(file, "boundaries", fit.inner_of_boundary, "the boundary does not apply to them");
}

}  // namespace sazare::runs
