#pragma once

/// The parts of a blocks simulation, each made from the case and the mesh.

#include <vector>

#include "sazare/geometry/face_map.hpp"
#include "sazare/levels/terms/face_pressure.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/contact_surface.hpp"
#include "sazare/methods/blocks/joints.hpp"
#include "sazare/methods/blocks/outer_faces.hpp"

namespace sazare::runs {

/// A mesh with its faces.
struct MeshFaces {
  const geometry::TetraMesh& mesh;
  geometry::FaceMap map;
  std::vector<geometry::SurfaceFaces> surfaces;  ///< in the order of the mesh's surfaces

  /// Outer faces of a named surface group.
  std::vector<geometry::OuterFace> outer(const std::string& surface) const;
};

std::array<Vector3, 3> face_corners(const geometry::TetraMesh& mesh, const std::array<std::int32_t, 3>& nodes);

/// Area of a triangle times its normal [m2].
Vector3 area_vector(const std::array<Vector3, 3>& corners);

/// What a boundary carries of an initial traction; one without friction carries no shear.
Vector3 carried(cases::BoundaryKind kind, const Vector3& normal, const Vector3& traction);

/// Material of every element by its region.
std::vector<Index> materials_by_element(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh);

state::Bodies<3> make_bodies(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                             const std::vector<Index>& material);

/// Which joint of the case a face has: the last entry that matches, or -1 for none.
std::vector<Index> joint_by_face(const cases::BlocksCase& blocks, const MeshFaces& faces, const std::vector<Index>& material);

methods::blocks::JointKind make_joint_kind(const cases::Joint& joint);

std::vector<methods::blocks::JointFace> make_joint_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                         const std::vector<Index>& joint_of_face);

/// The joint that an element's material has with itself: the ground behind an outer face is like it. A case that was checked
/// against its mesh has one.
const cases::Joint& own_joint(const cases::BlocksCase& blocks, Index material);

std::vector<methods::blocks::OuterFace> make_boundaries(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                        const std::vector<Index>& material, const state::Bodies<3>& bodies);

/// The ground of every boundary of the case.
std::vector<methods::blocks::MovingGround> make_ground(const cases::BlocksCase& blocks);

/// Faces that no joint holds from the beginning: the outer ones, and both sides of those that were never bonded.
std::vector<methods::blocks::FreeFace> make_free_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                       const std::vector<Index>& joint_of_face);

/// An outer face as its body carries it.
struct CarriedFace {
  Vector3 area;    ///< outward vector with the length of the area, in the body frame [m2]
  Vector3 centre;  ///< in the body frame [m]
  Vector3 start;   ///< place of the centre at the beginning [m]
};
CarriedFace carried_face(const state::Bodies<3>& bodies, Index body, const std::array<Vector3, 3>& corners);

std::vector<terms::PressureLoad> make_loads(const cases::BlocksCase& blocks);
std::vector<terms::PressedFace> make_pressed_faces(const cases::BlocksCase& blocks, const MeshFaces& faces,
                                                   const state::Bodies<3>& bodies);

}  // namespace sazare::runs
