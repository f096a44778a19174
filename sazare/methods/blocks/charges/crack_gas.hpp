#pragma once

/// Term of the gas of charges in the cracks around their holes.
///
/// A face between two elements that has come apart takes gas once it shares an edge with the wall of a hole that the front has
/// reached, or with a crack that has gas. The gas pushes both faces apart, with one force and its reaction in the middle between
/// them. Between base steps the gas of a crack expands by itself, and its work is taken from its energy. At base steps it flows,
/// and cracks that have come apart since then join (crack_network.hpp). A crack whose faces are apart as far as they are
/// wide, or farther than the cut distance of its charge, or have turned away from each other, gapes: where it is open to the air
/// its gas is gone, elsewhere it becomes a part of the hole, with the room that it has.

#include <cmath>

#include "sazare/levels/terms/slot_table.hpp"
#include "sazare/methods/blocks/bonded_faces.hpp"
#include "sazare/methods/blocks/charges/crack_network.hpp"

namespace sazare::methods::blocks {

/// The width that a crack has for gas, and how much it grows per opening.
struct CrackRoom {
  Real width = 0;  ///< [m]
  Real rate = 0;   ///< [-]
};

/// Faces that are apart have their distance and the aperture [m] between them. Where they are pressed into each other by more and
/// more, half of the aperture is left and the gas pushes no more: its room then is the same wherever they go.
inline CrackRoom crack_room(Real aperture, Real opening) {
  if (opening >= 0) return {aperture + opening, 1};
  const Real left = std::exp(2 * opening / aperture);
  return {0.5 * aperture * (1 + left), left};
}

class CrackGas final : public terms::Term<3> {
public:
  /// `charges` and `joints` come before this term and must outlive it. Faces without a joint are open from the beginning.
  CrackGas(ChargeGas& charges, const BondedFaces& joints, GasFaces faces, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "cracks"; }
  std::span<const Link> links() const override { return links_; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant& now, std::span<const Index> which, const state::Bodies<3>&, std::span<terms::Impulse<3>> sum,
              terms::CauseImpulses<3>& parts) const override;
  bool acts_on_strains() const override { return strain_table_.exists; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override;
  void post_base_step(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes) override;
  terms::Rates rates(Index body) const override { return {rates_[at(body)], 0}; }
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override;
  void columns(Archive& archive) override;

  const CrackNetwork& network() const { return network_; }

private:
  /// Both faces of a crack as their bodies carry them.
  struct Faces {
    Vector3 first_area, second_area;      ///< from the first body to the second [m2]
    Vector3 first_centre, second_centre;  ///< [m]
  };
  /// What a crack remembers of its last evaluation.
  struct Pushed {
    Vector3 first, second;            ///< where the force is, in the frames of both bodies as if these were not strained [m]
    Vector3 force = Vector3::Zero();  ///< on the second body [N]
    Real work = 0;                    ///< since the last base step [J]
    Real width = 0;                   ///< [m]
    Real apart = 0;                   ///< [m]
  };
  /// On its way to other processes.
  struct Told {
    Index crack = 0, unused = 0;
    Real work = 0, width = 0, apart = 0;
  };
  /// Where a crack is.
  struct Place {
    Vector3 first, second;  ///< centres of its faces [m]
    Vector3 push;           ///< what a pressure of 1 gives, to the second body [m2]
    Real width = 0;         ///< for gas [m]
    Real volume = 0;        ///< [m3]
    Real apart = 0;         ///< distance of the centres; infinite once the faces have turned away from each other [m]

    Vector3 middle() const { return 0.5 * (first + second); }
  };

  state::StrainedPose pose_of(Index body, const state::Bodies<3>& bodies) const;
  Faces faces_of(const GasCrack& crack, const state::Bodies<3>& bodies) const;
  Place place_of(const GasCrack& crack, const Faces& faces, const state::Bodies<3>& bodies) const;
  void push_at(const Vector3& place, const state::StrainedPose& first, const state::StrainedPose& second, Pushed& pushed) const;
  void write_strain_force(const Due& due, const Pushed& pushed, const state::Bodies<3>& bodies);
  void move(const Due& due, const Instant& now, const state::Bodies<3>& bodies);

  bool is_apart(Index face) const;
  void exchange_news(terms::Peers& peers);
  void end_gaping_ones(terms::Changes& changes);
  void open_new(const Instant& now, const state::Bodies<3>& bodies, terms::Peers& peers, terms::Changes& changes);
  void add_link(const GasCrack& crack);
  void find_rates(terms::Changes& changes);

  ChargeGas* charges_;
  const BondedFaces* joints_;
  CrackNetwork network_;
  std::vector<Index> joint_of_;          ///< by face between elements; below 0 where none
  std::vector<Real> softness_;           ///< of bodies, at most [1/kg]
  std::vector<Real> rates_;              ///< stiffness by body [1/s2]
  std::vector<std::uint8_t> has_crack_;  ///< by body: whether it has or had one
  Tick last_base_ = 0;

  // By crack:
  std::vector<Faces> faces_;
  std::vector<Pushed> pushed_;
  std::vector<Link> links_;
  terms::SlotTable<3, 0, terms::ChangingIncidence> table_;
  terms::StrainTable<2, 0> strain_table_;
};

}  // namespace sazare::methods::blocks
