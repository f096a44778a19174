#pragma once

/// All contact spheres that are out in the open, and which of them are near one another.

#include <functional>
#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/laws/sphere_contact.hpp"
#include "sazare/methods/blocks/contact_spheres.hpp"
#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::methods::blocks {

/// What of a block touches others: the spheres behind its faces, or the faces themselves.
enum class ContactShape { spheres, faces };

/// A free face of a block.
struct FreeFace {
  Index body = 0;
  int face = 0;  ///< local face 0..3
};

/// Two spheres of two blocks that are nearer than the skin.
struct SpherePair {
  Index first = 0;  ///< sphere of the body with the smaller number
  Index second = 0;
  Real initial_overlap = 0;  ///< overlap that they had when they met the first time; it gives no force until they part [m]
  Real gap = 0;              ///< between them at the pair's clearance [m], negative when they overlap
  laws::SphereMemory memory;
};

/// The near spheres of two bodies.
struct NearPair {
  Index first = 0;  ///< bodies, first < second
  Index second = 0;
  std::vector<SpherePair> spheres;  ///< rising
};

/// Where bodies are.
using PoseOf = std::function<state::StrainedPose(Index)>;

/// Where the spheres of deformable blocks touch their faces moves with the strain, and the spheres with these points.
class ContactSurface {
public:
  ContactSurface(Index bodies, int edge_division, Real skin, ContactShape shape = ContactShape::spheres, bool strained = false);

  /// Opens a face of a block whose corners are given as it stood at the beginning [m].
  void open(const FreeFace& face, const geometry::Tetrahedron& corners, const state::Pose<3>& start);

  const ContactSphere& sphere(Index number) const { return spheres_[static_cast<std::size_t>(number)]; }
  /// Where a sphere touches its face, in the body frame; of deformable blocks [m].
  const Vector3& tangent_point(Index number) const { return tangent_points_[static_cast<std::size_t>(number)]; }
  /// A sphere in the world.
  ContactSphere placed(Index number, const state::StrainedPose& pose) const {
    ContactSphere placed = sphere(number);
    placed.centre = pose.position + pose.rotation * placed.centre;
    if (!tangent_points_.empty()) placed.centre += pose.straining * tangent_point(number);
    return placed;
  }
  /// Place of a body among those with open faces, or -1.
  Index place_of(Index body) const { return open_of_[at(body)]; }
  std::int64_t sphere_count() const { return static_cast<std::int64_t>(spheres_.size()); }
  Real skin() const { return skin_; }

  /// Calls visit(number) for every sphere of a body with open faces.
  template <class Visit>
  void visit_spheres(Index body, Visit&& visit) const {
    for (const Index number : patches_of(body)) {
      if (number < 0) continue;
      const Patch& patch = patches_[static_cast<std::size_t>(number)];
      for (Index sphere = patch.first_sphere; sphere < patch.first_sphere + patch.count; ++sphere) visit(sphere);
    }
  }

  /// Bodies with open faces, in the order in which they got their first.
  std::span<const Index> bodies() const { return open_bodies_; }

  /// How far any point of a body has moved since it was last searched, at most [m].
  Real moved(Index body, const state::StrainedPose& pose, Real reach) const;

  /// Places of bodies that are to be searched.
  void place(Index body, const state::StrainedPose& pose);

  /// Bodies, rising, that a search of these may look at, which must be known where they are.
  std::vector<Index> candidates(std::span<const Index> searched, const PoseOf& pose_of) const;

  /// Whether the spheres around two open faces of two bodies come within the skin; the same seen from either body.
  bool are_near(Index body, const state::Pose<3>& pose, Index partner, const state::Pose<3>& other) const;

  /// Near pairs of a body with all others, rising by partner; pairs for which `skip(partner)` are left out. `pose_of` says
  /// where bodies are: partners may have moved by a third of the skin since they were placed.
  std::vector<NearPair> search(Index body, const std::function<bool(Index)>& skip, const PoseOf& pose_of) const;

  void columns(Archive& archive);

private:
  struct Patch {
    Index body = 0;
    Index first_sphere = 0;
    Index count = 0;
    ContactSphere bound;  ///< around what touches, in the body frame
  };

  const std::array<Index, 4>& patches_of(Index body) const { return patches_of_[at(open_of_[at(body)])]; }
  void place_patch(Index patch);
  template <class Visit>
  void visit_near(Index body, const state::StrainedPose& pose, Visit&& visit) const;
  void match(const Patch& mine, const state::StrainedPose& pose, const Patch& theirs, const state::StrainedPose& other,
             NearPair& near) const;

  int edge_division_;
  Real skin_;
  ContactShape shape_;
  bool strained_;
  std::vector<ContactSphere> spheres_;   ///< in the body frames
  std::vector<Vector3> tangent_points_;  ///< of deformable blocks; else none
  std::vector<Patch> patches_;
  std::vector<std::array<Index, 4>> patches_of_;  ///< by open body; -1 for none
  std::vector<Index> open_of_;                    ///< by body: its place among the open ones, or -1
  std::vector<Index> open_bodies_;
  std::vector<state::Pose<3>> searched_;  ///< by open body: where it was last searched, the gradient for the rotation
  neighbors::SphereGrid grid_;
};

}  // namespace sazare::methods::blocks
