#pragma once

/// Term of the contact between blocks whose faces are open: free from the beginning, or released by a broken joint.
///
/// Which spheres may touch is searched anew for a body when it may have moved by a third of the skin, and for both
/// bodies when their joint breaks. Bodies that share a joint that holds do not touch.

#include <limits>
#include <span>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/contact_batch.hpp"
#include "sazare/methods/blocks/contact_surface.hpp"
#include "sazare/methods/blocks/joints.hpp"

namespace sazare::methods::blocks {

class Contacts final : public terms::Term<3> {
public:
  /// `corners` of every body as it stands at the beginning, which must outlive the term; `free_faces` are open from then on.
  Contacts(const laws::SphereContact& law, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
           std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "contacts"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>& bodies, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override;
  void post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  void post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  terms::Rates rates(Index body) const override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index pair, Parcel& parcel) override;
  void carried() override;
  void columns(Archive& archive) override;

  /// Spheres of all open faces.
  const ContactSurface& surface() const { return surface_; }

  /// Pairs of bodies that are near each other.
  Index pair_count() const { return static_cast<Index>(links_.size() - idle_.size()); }

private:
  void evaluate_batch(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies);
  void conclude(const Instant& now, const ContactBatch& batch, const ContactBatch::Pair& pair);
  Real update_clearance(Index pair, const ContactBody& first, const ContactBody& second, const state::Bodies<3>& bodies);
  void fit_to_motion(Clearance& clearance) const;
  bool are_distant(const ContactBody& first, const ContactBody& second, const Link& link, Real room,
                   const state::Bodies<3>& bodies) const;
  void deactivate_the_distant(const Instant& now, terms::Peers& peers, terms::Changes& changes);
  void measure(std::vector<SpherePair>& spheres, const state::Pose<3>& first, const state::Pose<3>& second,
               Clearance& clearance) const;
  void count_touching(const Link& link, int change);
  void open_face(const FreeFace& face, const state::Bodies<3>& bodies);
  void search(std::span<const Index> which, bool may_end, const Instant& now, const state::Bodies<3>& bodies,
              terms::Changes& changes);
  void merge(Index body, std::vector<NearPair> found, bool may_end, terms::Changes& changes);
  Index pair_of(Index first, Index second) const;
  void begin_pair(NearPair near, terms::Changes& changes);
  void end_pair(Index pair, terms::Changes& changes);
  void list_side(Index body, terms::SlotSide side);
  bool is_idle(const Link& link) const { return link.first == Link::outside; }

  laws::SphereContact law_;
  Joints* joints_;
  geometry::ElementCorners corners_;
  std::vector<float> softness_;  ///< by body: the largest 1/mass that it can show at a point of it [1/kg]
  ContactSurface surface_;
  std::vector<Link> links_;
  std::vector<std::vector<SpherePair>> spheres_;  ///< by pair
  std::vector<Clearance> clearance_;              ///< by pair
  std::vector<int> touching_;                     ///< by body: how many others it touches
  std::vector<Index> idle_;                       ///< numbers of pairs that have ended
  std::vector<Index> ending_;                     ///< of those that ended in this step: free from the next one on
  terms::SlotTable<3, 2, terms::ChangingIncidence> table_;
  std::int64_t base_steps_ = 0;
  Tick last_base_ = 0;
  Real base_step_ = std::numeric_limits<Real>::infinity();  ///< unknown at first: no pair is distant then [s]
};

}  // namespace sazare::methods::blocks
