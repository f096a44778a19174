#pragma once

/// What the contact of blocks needs to know whatever touches, the spheres behind their faces or the faces themselves: which open
/// blocks are near each other, how far apart they are, and when they are to be looked at.
///
/// What may touch is searched anew for a body when it may have moved by a third of the skin, and around a joint when it breaks.
/// What two blocks know of their touch is kept by the derived term, for the numbers of pairs that it is given here.

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/contact_kernel.hpp"
#include "sazare/methods/blocks/contact_surface.hpp"
#include "sazare/methods/blocks/joints.hpp"

namespace sazare::methods::blocks {

class BlockContacts : public terms::Term<3> {
public:
  std::string_view name() const override { return "contacts"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>& bodies, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override;
  bool acts_on_strains() const override { return strain_table_.exists; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override;
  bool looks_at_steps() const override { return true; }
  void post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  void post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  void carry(Index pair, Parcel& parcel) override;
  void carried() override;
  void columns(Archive& archive) override;

  /// All open faces, with their spheres.
  const ContactSurface& surface() const { return surface_; }

  /// Pairs of bodies that are near each other.
  Index pair_count() const { return static_cast<Index>(links_.size() - idle_.size()); }

protected:
  /// `corners` of every body as it stands at the beginning, which must outlive the term.
  BlockContacts(ContactShape shape, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
                const state::Bodies<3>& bodies);

  /// Opens the faces that are free from the beginning. A derived term calls it when it has been made.
  void open_first(std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies);

  /// Pairs of a body with all that are near it and may touch it, rising by partner.
  virtual std::vector<NearPair> find_near(Index body, const PoseOf& pose_of) const = 0;
  /// A number that is new, or that of a pair that has ended, is given to two bodies that have come near.
  virtual void begin(Index pair, NearPair near, const PoseOf& pose_of) = 0;
  /// A pair has been found again: what it knew stays.
  virtual void renew(Index pair, NearPair near) = 0;
  virtual void end(Index pair) = 0;
  /// Gap of a pair where it stands, the skin at most [m]; `clearance` says for how much motion it is to be good.
  virtual Real find_gap(Index pair, const state::StrainedPose& first, const state::StrainedPose& second,
                        Clearance& clearance) = 0;
  /// A face of a body is open from now on.
  virtual void opened(const FreeFace&, const state::Bodies<3>&) {}
  /// Bodies that may touch others now that a joint has broken.
  virtual void add_loosened(Index joint, std::vector<Index>& loosened) const;

  ContactBody body(Index number, const state::Bodies<3>& bodies) const {
    return {bodies.motion[at(number)], bodies.inertia[at(number)], follows_strains() ? &bodies.strain[at(number)] : nullptr};
  }
  /// Whether what touches moves with the strains of its blocks: faces do not.
  bool follows_strains() const { return strain_table_.exists; }
  state::StrainedPose pose_at(Index body, const state::Bodies<3>& bodies, const Instant& now) const {
    if (follows_strains()) return state::strained_pose_at(bodies, body, now);
    return state::pose_at(bodies.motion[at(body)], now);
  }
  /// At a base step.
  state::StrainedPose pose_at(Index body, const terms::Synchronized<3>& now) const {
    if (follows_strains()) return {now.pose_of(body), now.strain_of(body)};
    return now.pose_of(body);
  }
  /// Measures the clearance of a pair anew where what has moved since then has used it up; returns how far the two have moved
  /// since it was measured, at most [m].
  Real update_clearance(Index pair, const ContactBody& first, const ContactBody& second, const state::Bodies<3>& bodies);
  /// Whether a pair was apart when last evaluated, and has not come as near as to touch since its clearance was measured.
  bool stays_apart(Index pair, Real moved) const { return table_[pair].evaluated < 0 && moved < clearance_[at(pair)].gap; }
  /// Writes what an evaluation has found of a pair; the force counts where the two touch.
  void conclude(const Instant& now, const Due& due, bool overlap, bool touches, const ContactForce& force);
  /// Writes what it has found on the strains of a pair that touches; to be called before.
  void write_strain_force(const Due& due, const ContactStrainForce& force) {
    strain_table_[due.link].write(table_[due.link].evaluated < 0, force.total, {force.dashpot, force.friction});
  }
  void take_back(Index pair, const terms::Synchronized<3>& now, terms::EnergySums& energies) const {
    table_.take_back(pair, links_[at(pair)], now, energies);
    strain_table_.take_back(pair, links_[at(pair)], table_, now, energies);
  }
  bool is_idle(const Link& link) const { return link.first == Link::outside; }
  /// Energies of pairs are counted where they touched when last evaluated: others are far from meeting where that was earlier.
  bool has_energy(std::size_t pair, const terms::Synchronized<3>& at_time) const {
    return !is_idle(links_[pair]) && at_time.counts(links_[pair]) && table_.slots[pair].evaluated >= 0;
  }

  Joints* joints_;
  geometry::ElementCorners corners_;
  std::vector<float> softness_;  ///< by body: the largest 1/mass that it can show at a point of it [1/kg]
  terms::StrainTable<2, 2> strain_table_;  ///< of spheres between deformable blocks
  Real reach_of_spheres_;                  ///< how far from the centre of its block strain moves a sphere, over the block's reach
  ContactSurface surface_;
  std::vector<Link> links_;
  std::vector<Clearance> clearance_;  ///< by pair
  terms::SlotTable<3, 2, terms::ChangingIncidence> table_;

private:
  void fit_to_motion(Clearance& clearance) const;
  bool are_distant(const ContactBody& first, const ContactBody& second, const Link& link, Real room,
                   const state::Bodies<3>& bodies) const;
  void deactivate_the_distant(const Instant& now, terms::Peers& peers, terms::Changes& changes);
  void clear(Index pair);
  void measure(Index pair, const state::StrainedPose& first, const state::StrainedPose& second);
  void count_touching(const Link& link, int change);
  void open_face(const FreeFace& face, const state::Bodies<3>& bodies);
  void search(std::span<const Index> which, bool may_end, const Instant& now, const state::Bodies<3>& bodies,
              terms::Changes& changes);
  void merge(Index body, std::vector<NearPair> found, bool may_end, const PoseOf& pose_of, terms::Changes& changes);
  Index pair_of(Index first, Index second) const;
  void begin_pair(NearPair near, const PoseOf& pose_of, terms::Changes& changes);
  void end_pair(Index pair, terms::Changes& changes);
  void list_side(Index body, terms::SlotSide side);

  std::vector<int> touching_;  ///< by body: how many others it touches
  std::vector<Index> idle_;    ///< numbers of pairs that have ended
  std::vector<Index> ending_;  ///< of those that ended in this step: free from the next one on
  std::int64_t base_steps_ = 0;
  Tick last_base_ = 0;
  Real base_step_ = std::numeric_limits<Real>::infinity();  ///< unknown at first: no pair is distant then [s]
};

}  // namespace sazare::methods::blocks
