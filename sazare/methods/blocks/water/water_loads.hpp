#pragma once

/// Term of the water around blocks: buoyancy, the pressure of an accelerated flow, and drag on faces that the flow meets.
///
///     F = rho V (g z + du/dt) + sum 1/2 rho C_D A (-n . w) w     w = u - v, over washed faces with n . w < 0
///
/// with V the submerged part of the element, exactly, at whose centroid the first term acts; A the submerged area of a face, n
/// its outward normal over |w|, v the velocity of its middle. The first term is what a pressure that grows with depth gives on
/// all faces of an element, bonded ones as well, as pore pressure does: so joints carry effective stress, nothing changes when
/// they break, and still water has a potential. Faces are washed where water can flow: outer ones without a ground behind them,
/// and those between elements once they have come apart by as much as they are wide.
///
/// Water is not carried along: there is no added mass.
///
/// Drag on an element alone limits its step, as a dashpot rho C_D A |w| does that all of its faces together have at the speed at
/// which the water flows and the element sinks.

#include <span>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/laws/water/water_field.hpp"
#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/bonded_faces.hpp"

namespace sazare::methods::blocks {

/// A face that water may meet.
struct WettedFace {
  Index body = 0, face = 0;          ///< local face, opposite the corner of that number
  Index other_body = -1, other = 0;  ///< behind it at the beginning; none behind an outer face
};

class WaterLoads final : public terms::Term<3> {
public:
  /// `joints` comes before this term and must outlive it; `bodies` stand where their corners are given.
  WaterLoads(laws::WaterField water, Real drag_coefficient, const geometry::ElementCorners& corners, std::vector<WettedFace> faces,
             const BondedFaces& joints, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "water"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<terms::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override {
    strain_table_.gather(now, body, table_, sum);
  }
  void post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes&) override;
  terms::Rates rates(Index body) const override { return {0, drag_rate_[static_cast<std::size_t>(body)]}; }
  void add_energies(const terms::Synchronized<3>& at_time, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

  /// Whether water flows along a face, by its place in the list that was given, sorted by body.
  bool is_washed(std::size_t face) const { return is_washed_[face] != 0; }
  std::span<const WettedFace> faces() const { return faces_; }
  /// On a body, as last evaluated [N].
  Vector3 force(Index body) const { return -table_[body].total.linear; }

private:
  using Corners = std::array<Vector3, 4>;
  /// What acts on a body, about its centre.
  struct Load;

  void find_drag_rates(const state::Bodies<3>& bodies);
  Load load_on(Index body, const Instant& now, const state::Bodies<3>& bodies) const;
  void add_drag(std::size_t face, Real time, const state::Bodies<3>& bodies, const Matrix3& gradient, Load& load) const;
  Real apart(const WettedFace& face, const Instant& now, const state::Bodies<3>& bodies) const;

  laws::WaterField water_;
  Real drag_coefficient_;
  std::vector<Corners> corners_;          ///< by body, unstrained, in its frame [m]
  std::vector<Real> volume_;              ///< by body, unstrained [m3]
  std::vector<Real> drag_rate_;           ///< by body, of all its faces [1/s]
  std::vector<WettedFace> faces_;         ///< by body
  std::vector<std::size_t> first_face_;   ///< of each body, and the end
  std::vector<std::int8_t> is_washed_;    ///< by face
  std::vector<Real> width_;               ///< by face [m]
  std::int64_t looks_ = 0;                ///< base steps so far
  const BondedFaces* joints_;
  std::vector<Link> links_;
  terms::SlotTable<3, 0, terms::FixedIncidence> table_;
  terms::StrainTable<1, 0> strain_table_;
};

}  // namespace sazare::methods::blocks
