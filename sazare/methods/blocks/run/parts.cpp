#include "sazare/methods/blocks/run/parts.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "sazare/cases/motion_of_case.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/joints/element_springs.hpp"

namespace sazare::runs {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::uint8_t axes_bits(const std::array<bool, 3>& axes) {
  return static_cast<std::uint8_t>(axes[0] | axes[1] << 1 | axes[2] << 2);
}

Real reach_of(const geometry::Tetrahedron& corners, const Vector3& centre) {
  Real reach = 0;
  for (const Vector3& corner : corners) reach = std::max(reach, (corner - centre).norm());
  return reach;
}

/// Adds a tetrahedron at rest, its body frame in the principal axes of inertia.
void add_tetrahedron(state::Bodies<3>& bodies, const geometry::Tetrahedron& corners, Real density) {
  const Vector3 centre = geometry::centroid(corners);
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(density * geometry::inertia_about_centroid(corners));
  Matrix3 rotation = axes.eigenvectors();
  if (rotation.determinant() < 0) rotation.col(2) *= -1;
  state::add_body(bodies, density * geometry::volume(corners), centre, axes.eigenvalues(), Quaternion(rotation).normalized(),
                  reach_of(corners, centre));
}

}  // namespace

std::array<Vector3, 3> face_corners(const geometry::TetraMesh& mesh, const std::array<std::int32_t, 3>& nodes) {
  return {mesh.nodes[at(nodes[0])], mesh.nodes[at(nodes[1])], mesh.nodes[at(nodes[2])]};
}

Vector3 carried(cases::BoundaryKind kind, const Vector3& normal, const Vector3& traction) {
  return kind == cases::BoundaryKind::frictionless ? Vector3(normal.dot(traction) * normal) : traction;
}

Vector3 area_vector(const std::array<Vector3, 3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]); }

std::vector<geometry::OuterFace> MeshFaces::outer(const std::string& surface) const {
  std::vector<geometry::OuterFace> found;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (mesh.surfaces[i].name == surface)
      for (const Index face : surfaces[i].outer) found.push_back(map.outer[at(face)]);
  return found;
}

std::vector<Index> materials_by_element(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh) {
  std::vector<Index> by_region(mesh.region_names.size(), 0);
  for (std::size_t region = 0; region < by_region.size(); ++region)
    for (std::size_t material = 0; material < blocks.materials.size(); ++material)
      if (contains(blocks.materials[material].regions, mesh.region_names[region]))
        by_region[region] = static_cast<Index>(material);
  std::vector<Index> by_element;
  for (const Index region : mesh.region) by_element.push_back(by_region[at(region)]);
  return by_element;
}

state::Bodies<3> make_bodies(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                             const std::vector<Index>& material) {
  state::Bodies<3> bodies;
  state::reserve(bodies, mesh.tetrahedra.size());
  for (Index element = 0; element < static_cast<Index>(mesh.tetrahedra.size()); ++element) {
    add_tetrahedron(bodies, geometry::corners_of(mesh, element), blocks.materials[at(material[at(element)])].density);
    const std::string& region = mesh.region_names[at(mesh.region[at(element)])];
    state::Locks& locks = bodies.locks.back();
    for (const cases::Constraint& constraint : blocks.constraints)
      if (contains(constraint.regions, region)) {
        locks.translation |= axes_bits(constraint.translation);
        locks.rotation |= axes_bits(constraint.rotation);
      }
    for (const cases::InitialVelocity& start : blocks.initial_velocities)
      if (contains(start.regions, region)) bodies.motion.back().velocity = start.velocity;
    for (int axis = 0; axis < 3; ++axis)
      if (locks.translation >> axis & 1) bodies.motion.back().velocity[axis] = 0;
  }
  bodies.pole = state::middle(bodies);
  return bodies;
}

std::vector<Index> joint_by_face(const cases::BlocksCase& blocks, const MeshFaces& faces, const std::vector<Index>& material) {
  std::vector<Index> joint_of(faces.map.interior.size(), -1);
  for (std::size_t entry = 0; entry < blocks.joints.size(); ++entry) {
    const cases::Joint& joint = blocks.joints[entry];
    if (joint.on_surface()) {
      for (std::size_t surface = 0; surface < faces.surfaces.size(); ++surface)
        if (faces.mesh.surfaces[surface].name == joint.surface)
          for (const Index face : faces.surfaces[surface].interior) joint_of[at(face)] = static_cast<Index>(entry);
      continue;
    }
    for (std::size_t face = 0; face < joint_of.size(); ++face) {
      const auto& shared = faces.map.interior[face];
      const std::string& first = blocks.materials[at(material[at(shared.element_i)])].name;
      const std::string& second = blocks.materials[at(material[at(shared.element_j)])].name;
      const auto& [a, b] = joint.between;
      if ((first == a && second == b) || (first == b && second == a)) joint_of[face] = static_cast<Index>(entry);
    }
  }
  return joint_of;
}

namespace {

/// What a joint of any law takes.
struct JointNumbers {
  Real normal_stiffness, shear_stiffness, normal_damping, shear_damping, cohesion, friction_coefficient, tensile_strength,
      fracture_energy;
};

/// Where a joint gives no stiffness every face has its own, and that of the kind is never used.
JointNumbers numbers_of(const cases::Joint& joint) {
  return {joint.normal_stiffness.value_or(1),
          joint.shear_stiffness.value_or(1),
          joint.normal_damping,
          joint.shear_damping,
          joint.cohesion,
          joint.friction_coefficient,
          joint.tensile_strength,
          joint.fracture_energy};
}

}  // namespace

methods::blocks::JointKind make_joint_kind(const cases::Joint& joint) {
  if (!joint.bonded) return {};
  return laws::visit_joint_law(joint.law, [&]<class Law>(Law) -> methods::blocks::JointKind {
    return methods::blocks::joint_parameters<Law>(numbers_of(joint),
                                                  laws::own_parameters<laws::JointLaws, Law>(joint.law_parameters));
  });
}

std::vector<methods::blocks::JointFace> make_joint_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                         const std::vector<Index>& joint_of_face) {
  std::vector<methods::blocks::JointFace> made;
  const laws::LinearStress stress = blocks.stress_at_start();
  for (std::size_t face = 0; face < joint_of_face.size(); ++face) {
    const Index entry = joint_of_face[face];
    if (entry < 0 || !blocks.joints[at(entry)].bonded) continue;
    const auto& shared = faces.map.interior[face];
    methods::blocks::JointFace bonded{shared.element_i, shared.element_j, entry,
                                      shared.face_i,    shared.face_j,    face_corners(faces.mesh, shared.nodes)};
    // The master is the one that comes first in the file, however elements are sorted in memory.
    if (element_tag(faces.mesh, bonded.slave) < element_tag(faces.mesh, bonded.master)) {
      std::swap(bonded.master, bonded.slave);
      std::swap(bonded.master_face, bonded.slave_face);
      std::swap(bonded.corners[1], bonded.corners[2]);  // counter-clockwise from the other side
    }
    if (!stress.is_zero())
      bonded.traction = laws::corner_tractions(stress, bonded.corners, area_vector(bonded.corners).normalized());
    made.push_back(bonded);
  }
  return made;
}

const cases::Joint& own_joint(const cases::BlocksCase& blocks, Index material) {
  const std::string& name = blocks.materials[at(material)].name;
  const cases::Joint* own = nullptr;
  for (const cases::Joint& joint : blocks.joints)
    if (joint.bonded && !joint.on_surface() && joint.between[0] == name && joint.between[1] == name) own = &joint;
  if (own == nullptr) throw std::logic_error("material " + name + " has no joint with itself");
  return *own;
}

namespace {

/// What the ground behind an outer face carries at the beginning.
std::array<Vector3, 3> ground_tractions(const laws::LinearStress& stress, cases::BoundaryKind kind,
                                        const methods::blocks::OuterFace& face) {
  std::array<Vector3, 3> tractions = laws::corner_tractions(stress, face.place, face.normal);
  for (Vector3& traction : tractions) traction = carried(kind, face.normal, traction);
  return tractions;
}

/// Stands a face on the springs of fixed ground first.
void hold_until_time_begins(const OnGround& behind, methods::blocks::OuterFace& face) {
  const methods::blocks::FaceSprings later = face.later.emplace(face.springs);
  face.springs = ground_springs(cases::BoundaryKind::fixed, behind);
  face.springs.corners = later.corners;
  face.springs.corner_area = later.corner_area;
}

}  // namespace

std::vector<methods::blocks::OuterFace> make_boundaries(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                        const std::vector<Index>& material, const state::Bodies<3>& bodies) {
  std::vector<methods::blocks::OuterFace> made;
  const laws::LinearStress stress = blocks.stress_at_start();
  for (std::size_t number = 0; number < blocks.boundaries.size(); ++number) {
    const cases::Boundary& boundary = blocks.boundaries[number];
    for (const geometry::OuterFace& outer : faces.outer(boundary.surface)) {
      const auto& motion = bodies.motion[at(outer.element)];
      const Index own = material[at(outer.element)];
      methods::blocks::OuterFace face;
      face.body = outer.element;
      face.boundary = static_cast<Index>(number);
      face.place = face_corners(faces.mesh, outer.nodes);
      const Vector3 area = area_vector(face.place);
      face.normal = area.normalized();
      const Real distance = face.normal.dot(face.place[0] - motion.position);
      const OnGround behind{blocks.materials[at(own)], own_joint(blocks, own), distance,
                            bodies.inertia[at(outer.element)].mass / area.norm()};
      face.springs = ground_springs(boundary.kind, behind);
      for (std::size_t corner = 0; corner < 3; ++corner)
        face.springs.corners[corner] = motion.rotation.transpose() * (face.place[corner] - motion.position);
      face.springs.corner_area = area.norm() / 3;
      if (blocks.settles() && boundary.kind == cases::BoundaryKind::absorbing) hold_until_time_begins(behind, face);
      if (!stress.is_zero()) face.traction = ground_tractions(stress, boundary.kind, face);
      made.push_back(face);
    }
  }
  return made;
}

std::vector<methods::blocks::MovingGround> make_ground(const cases::BlocksCase& blocks) {
  std::vector<methods::blocks::MovingGround> made;
  for (const cases::Boundary& boundary : blocks.boundaries) {
    methods::blocks::MovingGround& ground = made.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ground[axis] = cases::motion_named(blocks.motions, boundary.motion[axis]);
      if (ground[axis] && boundary.kind == cases::BoundaryKind::absorbing) ground[axis]->amplitude *= 2;  // see outer_faces.hpp
    }
  }
  return made;
}

std::vector<methods::blocks::FreeFace> make_free_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                       const std::vector<Index>& joint_of_face) {
  std::vector<methods::blocks::FreeFace> made;
  for (const geometry::OuterFace& outer : faces.map.outer) made.push_back({outer.element, outer.face});
  for (std::size_t face = 0; face < joint_of_face.size(); ++face) {
    const Index entry = joint_of_face[face];
    if (entry >= 0 && blocks.joints[at(entry)].bonded) continue;
    const auto& shared = faces.map.interior[face];
    made.push_back({shared.element_i, shared.face_i});
    made.push_back({shared.element_j, shared.face_j});
  }
  return made;
}

CarriedFace carried_face(const state::Bodies<3>& bodies, Index body, const std::array<Vector3, 3>& corners) {
  const auto& motion = bodies.motion[at(body)];
  const Vector3 start = (corners[0] + corners[1] + corners[2]) / 3;
  return {motion.rotation.transpose() * area_vector(corners), motion.rotation.transpose() * (start - motion.position), start};
}

std::vector<terms::PressureLoad> make_loads(const cases::BlocksCase& blocks) {
  std::vector<terms::PressureLoad> loads;
  for (const cases::Blast& blast : blocks.blasts) {
    terms::PressureLoad load{blast.delay, {}, blast.cut_distance};
    if (const auto* pulse = std::get_if<cases::PressurePulse>(&blast.pressure))
      load.history = laws::BlastPressure{pulse->peak_pressure, pulse->rise_time, pulse->decay_ratio};
    else if (const auto* table = std::get_if<cases::PressureTable>(&blast.pressure))
      load.history = laws::PressureTable{table->time, table->pressure};
    else
      load.history = std::get<cases::PressureFunction>(blast.pressure).samples;
    loads.push_back(load);
  }
  return loads;
}

std::vector<terms::PressedFace> make_pressed_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                   const state::Bodies<3>& bodies) {
  std::vector<terms::PressedFace> made;
  for (std::size_t load = 0; load < blocks.blasts.size(); ++load)
    for (const geometry::OuterFace& outer : faces.outer(blocks.blasts[load].surface)) {
      const CarriedFace carried = carried_face(bodies, outer.element, face_corners(faces.mesh, outer.nodes));
      terms::PressedFace face;
      face.body = outer.element;
      face.load = static_cast<Index>(load);
      face.area = carried.area;
      face.centre = carried.centre;
      face.start = carried.start;
      made.push_back(face);
    }
  return made;
}

}  // namespace sazare::runs
