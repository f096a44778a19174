#include "sazare/methods/fem/run/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"

namespace sazare::runs {
namespace {

namespace fem = methods::fem;
using geometry::MeshElement;

/// A face with the outside on the right, and in a joint the same places of the other side.
struct WetFace {
  MeshElement outside;
  std::optional<MeshElement> across;
};

std::set<Index> node_set(const MeshElement& face) { return {face.node_list().begin(), face.node_list().end()}; }

/// The face as the element beside it has it.
MeshElement seen_from_outside(const MeshElement& element, const MeshElement& face) {
  for (const geometry::ElementFace& one : geometry::faces_of(element.shape)) {
    MeshElement found{one.shape, {}, face.tag};
    for (std::size_t i = 0; i < one.nodes.size(); ++i) found.nodes[i] = element.nodes[at(one.nodes[i])];
    if (node_set(found) == node_set(face)) return found;
  }
  return face;
}

/// One entry of the case, on its faces.
template <int D>
class WaterMaker {
public:
  WaterMaker(const cases::CaseFile& file, const fem::BodyDescription& body, const MeshNames& names, std::size_t number)
      : file_(file),
        given_(file.as<cases::FemCase>().waters[number]),
        body_(body),
        key_(fmt::format("water_pressures.{}", number)),
        faces_(given_.in_joint() ? faces_of_joint() : faces_of_group(names)) {
    const Real gravity = -file.as<cases::FemCase>().gravity.acceleration[D - 1];
    water_ = {given_.density * gravity, D - 1, given_.level};
    if (given_.far_level) find_slope();
  }

  fem::StillWater<D> make() {
    fem::StillWater<D> made;
    made.pressure = {given_.name, fem::NodalColumn(body_.mesh.nodes.size() * D, 0), given_.ramp};
    for (const WetFace& face : faces_) {
      check_wall(face.outside);
      add_pressure(face, made);
      if (given_.added_mass == cases::AddedMass::westergaard) add_mass(face.outside, made);
    }
    return made;
  }

private:
  std::vector<WetFace> faces_of_joint() const {
    std::vector<WetFace> faces;
    for (const fem::JointSet& set : body_.joints)
      if (set.name == given_.joint)
        for (const auto& face : set.faces) faces.push_back({face.first, face.second});
    return faces;
  }

  std::vector<WetFace> faces_of_group(const MeshNames& names) const {
    const auto& group = names.outer_group(key_ + ".group", given_.group, "there is no water");
    refuse_faces_of_joints(group);
    const auto beside = geometry::elements_beside(body_.mesh, group);
    std::vector<WetFace> faces;
    for (std::size_t i = 0; i < group.elements.size(); ++i)
      faces.push_back({seen_from_outside(body_.mesh.elements[at(beside[i])], group.elements[i]), {}});
    return faces;
  }

  /// On one side of a joint alone water would push the body without pushing back.
  void refuse_faces_of_joints(const geometry::ElementGroup& group) const {
    std::set<std::set<Index>> wanted;
    for (const MeshElement& face : group.elements) wanted.insert(node_set(face));
    for (const fem::JointSet& set : body_.joints)
      for (const auto& face : set.faces)
        if (wanted.contains(node_set(face.first)) || wanted.contains(node_set(face.second)))
          refuse(file_, key_ + ".group", fmt::format("faces of the group \"{}\" lie in the joint \"{}\"", given_.group, set.name),
                 fmt::format("write joint = \"{}\" instead of the group: water in a joint pushes both of its sides", set.name));
  }

  /// The level falls evenly between the two ends of the base along the direction.
  void find_slope() {
    const Vector3 along = given_.direction.normalized();
    Vector3 first = Vector3::Zero();
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const WetFace& face : faces_) check_base(face.outside);
    for (const WetFace& face : faces_)
      for (const Index node : face.outside.node_list()) {
        const Real place = along.dot(body_.mesh.nodes[at(node)]);
        if (place < low) first = body_.mesh.nodes[at(node)];
        low = std::min(low, place);
        high = std::max(high, place);
      }
    if (!(high > low))
      refuse(file_, key_ + ".far_level", "the base has no length along the direction", "give the direction in which it extends");
    water_.from = first;
    water_.slope = (*given_.far_level - given_.level) / (high - low) * along;
  }

  /// How much the outside of a face looks up, from -1 to 1.
  Real look_up(const MeshElement& face) const {
    Vector<D> sum = Vector<D>::Zero();
    for (const fem::QuadraturePoint& place : fem::mass_points(face.shape)) {
      const auto point = fem::face_point<D>(body_.mesh, face, place);
      sum += point.weight * point.normal;
    }
    return sum.normalized()[D - 1];
  }

  void check_base(const MeshElement& face) const {
    if (!given_.in_joint() && look_up(face) > -0.5)
      refuse(file_, key_ + ".far_level", fmt::format("the group \"{}\" is no base: faces of it do not look down", given_.group),
             "far_level is for uplift; give the faces of the base a group of their own, and water on walls a level only");
  }

  void check_wall(const MeshElement& face) const {
    const bool wet = !fem::wet_points(body_.mesh, face, water_).empty();
    if (given_.added_mass == cases::AddedMass::westergaard && wet && std::abs(look_up(face)) > std::sqrt(0.75))
      refuse(
          file_, key_ + ".added_mass",
          fmt::format(
              "faces of the group \"{}\" are less than 30 degrees from horizontal; Westergaard's added mass is for steep walls",
              given_.group),
          "give the walls a group of their own");
  }

  void add_pressure(const WetFace& face, fem::StillWater<D>& made) const {
    const Eigen::VectorXd force = fem::pressure_force<D>(body_.mesh, face.outside, water_);
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      const auto node = static_cast<std::size_t>(i / D);
      const int axis = static_cast<int>(i % D);
      made.pressure.force[fem::number<D>(face.outside.nodes[node], axis)] += force[i];
      if (face.across) made.pressure.force[fem::number<D>(face.across->nodes[node], axis)] -= force[i];
      made.force[axis] += force[i];
    }
    for (const auto& place : fem::wet_points(body_.mesh, face.outside, water_))
      made.wet_area += fem::face_point<D>(body_.mesh, face.outside, place).weight;
  }

  void add_mass(const MeshElement& face, fem::StillWater<D>& made) const {
    const Eigen::MatrixXd mass = fem::added_mass<D>(body_.mesh, face, water_, given_.density, given_.level - bed(), body_.mass);
    if (!mass.isZero(0)) made.moving.push_back({{face.node_list().begin(), face.node_list().end()}, mass});
  }

  Real bed() const {
    Real lowest = std::numeric_limits<Real>::infinity();
    for (const WetFace& face : faces_)
      for (const Index node : face.outside.node_list()) lowest = std::min(lowest, body_.mesh.nodes[at(node)][D - 1]);
    if (!given_.bed) return lowest;
    if (*given_.bed > lowest + 1e-9 * std::abs(given_.level - lowest))
      refuse(file_, key_ + ".bed",
             fmt::format("the group \"{}\" reaches down to {} m, below the bed", given_.group, cases::short_number(lowest)),
             "lower the bed, or give the part in the water a group of its own");
    return *given_.bed;
  }

  const cases::CaseFile& file_;
  const cases::FemWater& given_;
  const fem::BodyDescription& body_;
  std::string key_;
  std::vector<WetFace> faces_;
  laws::WaterPressure water_;
};

using FaceName = std::set<Index>;

/// Faces on which water presses.
std::set<FaceName> wet_faces(const cases::FemCase& given, const fem::BodyDescription& body, const MeshNames& names) {
  std::set<FaceName> wet;
  for (std::size_t i = 0; i < given.waters.size(); ++i) {
    const cases::FemWater& water = given.waters[i];
    if (!water.in_joint())
      for (const MeshElement& face : names.group(fmt::format("water_pressures.{}.group", i), water.group, true).elements)
        wet.insert(node_set(face));
    for (const fem::JointSet& set : body.joints)
      for (const auto& face : set.faces)
        if (set.name == water.joint) wet.insert({node_set(face.first), node_set(face.second)});
  }
  return wet;
}

/// Nodes that a support holds along any axis, those of viscous boundaries and free-field sides, and tied ones, on which the pores
/// push from both sides.
template <int D>
std::set<Index> held_nodes(const fem::Supports<D>& supports) {
  std::set<Index> held;
  for (const fem::Support& support : supports.held) held.insert(support.node);
  for (const auto& [node, leader] : supports.tied) held.insert({node, leader});
  for (const auto& boundary : supports.viscous)
    for (const auto& face : boundary.faces) held.insert(face.nodes.begin(), face.nodes.end());
  for (const auto& side : supports.sides)
    for (const auto& face : side.faces) held.insert(face.nodes.begin(), face.nodes.end());
  return held;
}

/// Faces of one element only, by their nodes: the element.
std::map<FaceName, std::size_t> outer_faces(const geometry::ElementMesh& mesh) {
  std::map<FaceName, std::size_t> outer;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const geometry::ElementFace& face : geometry::faces_of(mesh.elements[e].shape)) {
      FaceName nodes;
      for (const int place : face.nodes) nodes.insert(mesh.elements[e].nodes[at(place)]);
      if (const auto [found, added] = outer.try_emplace(nodes, e); !added) outer.erase(found);
    }
  return outer;
}

/// Whether a face lies below the water table; one that is on it, but for round-off, does not.
bool is_below(const geometry::ElementMesh& mesh, const FaceName& face, const laws::WaterPressure& pore_water) {
  Vector3 sum = Vector3::Zero();
  Real size = 0;
  for (const Index node : face) {
    sum += mesh.nodes[at(node)];
    size = std::max(size, (mesh.nodes[at(node)] - mesh.nodes[at(*face.begin())]).norm());
  }
  return pore_water.depth(sum / static_cast<Real>(face.size())) > 0.01 * size;
}

}  // namespace

template <int D>
std::string warn_of_free_pores(const cases::CaseFile& file, const fem::BodyDescription& body, const fem::Supports<D>& supports,
                               const MeshNames& names) {
  const auto& given = file.as<cases::FemCase>();
  if (std::ranges::none_of(body.materials, [](const auto& material) { return material.saturation.has_value(); })) return "";
  const std::set<FaceName> wet = wet_faces(given, body, names);
  const std::set<Index> held = held_nodes(supports);
  std::vector<int> open(body.materials.size(), 0);
  for (const auto& [face, element] : outer_faces(body.mesh)) {
    const auto material = at(body.material[element]);
    const auto& saturation = body.materials[material].saturation;
    if (!saturation || !is_below(body.mesh, face, saturation->pore_water) || wet.contains(face)) continue;
    if (!std::ranges::all_of(face, [&](Index node) { return held.contains(node); })) ++open[material];
  }
  std::string all;
  for (std::size_t m = 0; m < open.size(); ++m) {
    if (open[m] == 0) continue;
    const std::string key = fmt::format("materials.{}.water_table", m);
    const std::string what = fmt::format("nothing holds {} of the ground below its water table against the water in the pores",
                                         cases::counted(open[m], "faces"));
    const std::string help = "add [[water_pressures]] with the same level on outer faces, or with joint = ... in a joint";
    if (given.time.strict) refuse(file, key, what, help);
    all += warning(file, key, what, help);
  }
  return all;
}

template <int D>
std::vector<fem::StillWater<D>> make_waters(const cases::CaseFile& file, const fem::BodyDescription& body,
                                            const MeshNames& names) {
  std::vector<fem::StillWater<D>> waters;
  for (std::size_t i = 0; i < file.as<cases::FemCase>().waters.size(); ++i)
    waters.push_back(WaterMaker<D>(file, body, names, i).make());
  return waters;
}

template <int D>
std::string warn_of_dry_water(const cases::CaseFile& file, const std::vector<fem::StillWater<D>>& waters) {
  std::string all;
  for (std::size_t i = 0; i < waters.size(); ++i) {
    if (waters[i].wet_area > 0) continue;
    const auto& given = file.as<cases::FemCase>().waters[i];
    const std::string key = fmt::format("water_pressures.{}.level", i);
    const std::string what =
        fmt::format("the water does nothing: all faces of {} \"{}\" lie above its level",
                    given.in_joint() ? "the joint" : "the group", given.in_joint() ? given.joint : given.group);
    const std::string help = fmt::format("the level is an elevation, {} in the coordinates of the mesh, in m", "xyz"[D - 1]);
    if (file.as<cases::FemCase>().time.strict) refuse(file, key, what, help);
    all += warning(file, key, what, help);
  }
  return all;
}

template std::vector<fem::StillWater<2>> make_waters<2>(const cases::CaseFile&, const fem::BodyDescription&, const MeshNames&);
template std::vector<fem::StillWater<3>> make_waters<3>(const cases::CaseFile&, const fem::BodyDescription&, const MeshNames&);
template std::string warn_of_free_pores<2>(const cases::CaseFile&, const fem::BodyDescription&, const fem::Supports<2>&,
                                           const MeshNames&);
template std::string warn_of_free_pores<3>(const cases::CaseFile&, const fem::BodyDescription&, const fem::Supports<3>&,
                                           const MeshNames&);
template std::string warn_of_dry_water<2>(const cases::CaseFile&, const std::vector<fem::StillWater<2>>&);
template std::string warn_of_dry_water<3>(const cases::CaseFile&, const std::vector<fem::StillWater<3>>&);

}  // namespace sazare::runs
