#pragma once

/// Springs and dashpots between the outer faces of blocks and fixed ground: held, frictionless and absorbing boundaries.
///
///     f = -A (k_n u_n + c_n v_n) n - A (k_s u_t + c_s v_t)     at each of the three corners, A a third of the face
///
/// fixed: as if bonded to unbreakable ground; frictionless: the normal part alone; absorbing: c_n = rho c_P, c_s = rho c_S
/// (Lysmer and Kuhlemeyer 1969) with the wave speeds that the joints imply over the block's own height. Initial tractions of the
/// ground act beside them, unchanged; their work counts as energy of the ground.

#include <vector>

#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/joint_rates.hpp"

namespace sazare::methods::blocks {

struct OuterFace {
  Index body = 0;
  FaceSprings springs;           ///< corners in the body frame
  std::array<Vector3, 3> place;  ///< of the corners at the beginning [m]
  Vector3 normal;                ///< outward, at the beginning
  std::array<Vector3, 3> traction = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};  ///< initial, on the corners [Pa]
};

class OuterFaces final : public terms::Term<3> {
public:
  OuterFaces(std::vector<OuterFace> faces, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "boundaries"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<state::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override {
    table_.gather(now, which, sum, parts);
  }
  terms::Rates rates(Index body) const override { return rates_[static_cast<std::size_t>(body)]; }
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override { parcel(table_[link]); }
  void columns(Archive& archive) override { archive("slots", table_.slots); }

private:
  std::vector<OuterFace> faces_;
  std::vector<Link> links_;
  std::vector<terms::Rates> rates_;
  terms::SlotTable<3, 1, terms::FixedIncidence> table_;
};

}  // namespace sazare::methods::blocks
