#pragma once

/// Term of the contact between blocks whose faces are open, free from the beginning or released by a broken joint, by the spheres
/// behind them. Bodies that share a joint that holds do not touch.

#include "sazare/methods/blocks/contact_batch.hpp"
#include "sazare/methods/blocks/block_contacts.hpp"

namespace sazare::methods::blocks {

class Contacts final : public BlockContacts {
public:
  /// `corners` of every body as it stands at the beginning, which must outlive the term; `free_faces` are open from then on.
  Contacts(const laws::SphereContact& law, int edge_division, Joints& joints, const geometry::ElementCorners& corners,
           std::span<const FreeFace> free_faces, const state::Bodies<3>& bodies);

  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  terms::Rates rates(Index body) const override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index pair, Parcel& parcel) override;
  void columns(Archive& archive) override;

private:
  std::vector<NearPair> find_near(Index body, const PoseOf& pose_of) const override;
  void begin(Index pair, NearPair near, const PoseOf& pose_of) override;
  void renew(Index pair, NearPair near) override;
  void end(Index pair) override { spheres_[at(pair)].clear(); }
  Real find_gap(Index pair, const state::StrainedPose& first, const state::StrainedPose& second, Clearance& clearance) override;
  void evaluate_batch(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies);

  laws::SphereContact law_;
  std::vector<std::vector<SpherePair>> spheres_;  ///< by pair
};

}  // namespace sazare::methods::blocks
