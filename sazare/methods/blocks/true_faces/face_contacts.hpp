#pragma once

/// Term of the contact between blocks whose faces are open, free from the beginning or released by a broken joint, by the faces
/// themselves (laws/face_overlap.hpp).
///
/// Blocks that hold together where they meet do not touch, be it by a joint between them or by a chain of joints around an edge
/// or a corner that they share. Where two overlap when they meet, as those do that a broken joint releases, both count as drawn
/// in by so much that they just touch: this initial depth becomes less as they part, and is gone once they are apart.

#include "sazare/geometry/tetrahedron_overlap.hpp"
#include "sazare/laws/face_overlap.hpp"
#include "sazare/methods/blocks/true_faces/node_stars.hpp"
#include "sazare/methods/blocks/block_contacts.hpp"

namespace sazare::methods::blocks {

/// What two blocks know of their touch.
struct FacePair {
  Real initial_depth = 0;            ///< that they shared when they met the first time, as far as they have not parted since [m]
  Vector3 normal = Vector3::Zero();  ///< from the first to the second, when last evaluated; 0 where they were apart
  laws::SphereMemory memory;
};

class FaceContacts final : public BlockContacts {
public:
  /// `edge_division` is of the spheres that touch a surface of finite elements. For the others see Contacts.
  FaceContacts(const laws::FaceOverlap& law, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
               std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies);

  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  terms::Rates rates(Index body) const override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index pair, Parcel& parcel) override;
  void columns(Archive& archive) override;

private:
  /// A block with an open face, in its own frame.
  struct Block {
    geometry::SolidTetrahedron solid;
    Real surface = 0;       ///< area of all faces [m2]
    std::int64_t open = 0;  ///< faces, as bits
  };

  std::vector<NearPair> find_near(Index body, const PoseOf& pose_of) const override;
  void begin(Index pair, NearPair near, const PoseOf& pose_of) override;
  void renew(Index, NearPair) override {}
  void end(Index pair) override { faces_[at(pair)] = {}; }
  Real find_gap(Index pair, const state::StrainedPose& first, const state::StrainedPose& second, Clearance& clearance) override;
  void opened(const FreeFace& face, const state::Bodies<3>& bodies) override;
  void add_loosened(Index joint, std::vector<Index>& loosened) const override;

  const Block& block(Index body) const { return blocks_[at(surface_.place_of(body))]; }
  geometry::SolidTetrahedron placed(Index body, const state::Pose<3>& pose, Real inset = 0) const {
    return geometry::placed(block(body).solid, pose.position, pose.rotation, inset);
  }
  void evaluate_one(const Instant& now, const Due& due, const state::Bodies<3>& bodies);
  geometry::TetrahedronOverlap overlap_of(const Link& link, FacePair& pair, const state::Pose<3>& first,
                                          const state::Pose<3>& second) const;
  ContactForce force(const Due& due, const ContactBody& first, const ContactBody& second,
                     const geometry::TetrahedronOverlap& overlap, const Vector3& pole, FacePair& pair) const;
  Real sharing(const Link& link) const;

  laws::FaceOverlap law_;
  NodeStars stars_;
  std::vector<Block> blocks_;    ///< by the place of a body among the open ones
  std::vector<FacePair> faces_;  ///< by pair
};

}  // namespace sazare::methods::blocks
