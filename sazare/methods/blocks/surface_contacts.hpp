#pragma once

/// Term of the contact between open faces of blocks and a surface of triangles whose nodes move (terms/nodal_surface.hpp).
///
/// The spheres of open faces touch the surface in points that count so that the force has an energy
/// (geometry/facets/complex.hpp): edges push once, and the two sides of a groove push both. The law is that of two touching
/// spheres (laws/sphere_contact.hpp), the surface showing no softness. What a sphere overlaps when it first meets the surface
/// gives no force until they part.
///
/// The strain of a deformable block moves its spheres as in its contact with other blocks.
///
/// A link is a block near the surface, and has the block's time level. Impulses on the nodes are counted as those of the block
/// are, from the middle of one interval to the middle of the next; at a base step the part that acts later is set aside.

#include "sazare/geometry/facets/points.hpp"
#include "sazare/geometry/nodal_surface.hpp"
#include "sazare/methods/blocks/contact_kernel.hpp"
#include "sazare/methods/blocks/block_contacts.hpp"
#include "sazare/neighbors/sphere_grid.hpp"

namespace sazare::methods::blocks {

class SurfaceContacts final : public terms::Term<3> {
public:
  /// `contacts` have the open faces, come before this term and must outlive it.
  SurfaceContacts(const laws::SphereContact& law, const BlockContacts& contacts, const state::Bodies<3>& bodies);

  /// The surface, before the first step or a resume [m]; until then there is none.
  void attach(std::vector<Vector3> nodes, std::vector<std::array<Index, 3>> faces);

  /// At a base step: from now on the nodes go from these places with these velocities [m; m/s].
  void lead(const Instant& now, std::vector<Vector3> from, std::vector<Vector3> with);

  /// On the nodes since the last `lead`, without what acts later [N s].
  std::vector<Vector3> impulse() const;
  /// On the nodes, as last evaluated [N].
  std::vector<Vector3> force() const;

  std::string_view name() const override { return "surface"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override { return {}; }
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>& bodies, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override;
  bool acts_on_strains() const override { return strain_table_.exists; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override;
  void post_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  void post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  terms::Rates rates(Index body) const override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override {
    parcel(table_[link]);
    strain_table_.carry(link, parcel);
  }
  void columns(Archive& archive) override;

private:
  /// A sphere near the surface.
  struct Sphere {
    Index number = 0;
    Index is_known = 0;        ///< whether its initial overlap is known
    Real initial_overlap = 0;  ///< overlap when it met the surface, as far as they have not parted since [m]
  };
  /// What a touching point remembers.
  struct Touch {
    Index sphere = 0;
    Index is_touching = 0;
    Vector3 normal = Vector3::Zero();  ///< from the block to the surface
    laws::SphereMemory memory;
  };
  /// What the surface has got in a point of it.
  struct Push {
    std::array<Index, 3> nodes{};
    Index unused = 0;  ///< no gap, for checkpoints
    std::array<Real, 3> shares{};
    Vector3 total, dashpot, friction;  ///< [N]
  };
  struct Near {
    std::vector<std::int32_t> faces;
    std::vector<Sphere> spheres;
    std::vector<Touch> touches;
    std::vector<Push> pushes;
    Real elastic = 0;  ///< when last evaluated [J]
    bool is_near() const { return !spheres.empty(); }
  };
  /// A sphere in a point where it presses.
  struct Met {
    geometry::FacetPoint point;
    Real overlap = 0;  ///< beyond its initial overlap [m]
    Index sphere = 0;
    Vector3 centre;    ///< of the sphere [m]
    Vector3 tangent = Vector3::Zero();  ///< tangent point of the sphere, of a deformable block [m]
  };
  /// On the strain of a block.
  struct StrainForce {
    Vector6 total = Vector6::Zero(), dashpot = Vector6::Zero(), friction = Vector6::Zero();

    void add(const Push& push, const Vector3& tangent, const Matrix3& rotation);
  };
  /// Work of the surface on the blocks, in all and by causes [J].
  struct Work {
    Real total = 0, dashpot = 0, friction = 0;
    void add(Real seconds, const Push& push, const Vector3& velocity);
  };

  Real time(const Instant& now) const { return now.seconds_since(led_); }
  void search(const Instant& now, const state::Bodies<3>& bodies, terms::Changes& changes);
  Near near_to(Index body, const state::StrainedPose& pose, const neighbors::SphereGrid& grid,
               std::span<const geometry::Triangle> triangles) const;
  void take_over(Index body, Near found, terms::Changes& changes);
  void clear(Index link);
  void evaluate_one(const Instant& now, const Due& due, const state::Bodies<3>& bodies);
  void find_met(const ContactBody& body, Near& near, Real seconds, std::vector<Met>& met) const;
  ContactBody body(Index number, const state::Bodies<3>& bodies) const {
    return {bodies.motion[at(number)], bodies.inertia[at(number)], strain_table_.exists ? &bodies.strain[at(number)] : nullptr};
  }
  static Touch& touch_of(const Met& met, Near& near);
  const Push& push(const ContactBody& body, const Met& met, Real seconds, laws::SphereMotion shared, Near& near) const;
  Vector3 push_by_slope(const Met& met, Near& near) const;
  Real find_near(const ContactSphere& sphere, std::span<const std::int32_t> faces, Real seconds,
                 std::vector<geometry::NearFacet>& near) const;
  Vector3 velocity(const Push& push) const;
  Work work_ahead() const;
  void add_ahead(std::vector<Vector3>& impulse, Real sign) const;

  laws::SphereContact law_;
  const BlockContacts* contacts_;
  geometry::NodalSurface surface_;
  geometry::FacetComplex complex_;
  Tick led_ = 0;                ///< when the nodes were led last
  std::vector<Real> softness_;  ///< by body, see Contacts [1/kg]
  std::vector<Real> reach_;     ///< by body [m]
  std::vector<Index> link_of_;  ///< by body, -1 for none
  std::vector<Link> links_;
  std::vector<Near> near_;        ///< by link
  std::vector<Vector3> impulse_;  ///< on the nodes since they were led last, with what acts later [N s]
  Work work_;                     ///< with what acts later
  Tick last_base_ = 0;
  Real travel_ = 0;  ///< of any block or node since the last search, at most, and what it will be at the next base step [m]
  std::int64_t known_spheres_ = -1;  ///< of open faces at the last search
  terms::SlotTable<3, 2, terms::ChangingIncidence> table_;
  terms::StrainTable<1, 2> strain_table_;
};

}  // namespace sazare::methods::blocks
