#pragma once

/// Stress in deformable elements:
///
///     s = s_0 + C (E + t dE/dt)      s_0, C  stress at the beginning and stiffness [Pa];  E  strain (state/strain.hpp)
///                                    t       relaxation time of the damping [s]
///
/// which pulls its strain back with the force -V s, the derivative of the energy V (s_0 : E + E : C E/2) and the dashpot
/// V t C. Strain and stress are in the body frame, so both are the same in any turned or moving frame.

#include <numeric>
#include <vector>

#include "sazare/levels/terms/term.hpp"

namespace sazare::methods::blocks {

struct DeformableElement {
  Index body = 0;
  Real volume = 0;                            ///< [m3]
  Matrix6 stiffness = Matrix6::Zero();        ///< C [Pa]
  Vector6 stress_at_start = Vector6::Zero();  ///< s_0 [Pa]
  Real relaxation_time = 0;                   ///< t [s]
  Real bulk_modulus = 0;                      ///< of the material: of the element with its halves of its joints [Pa]

  /// Stress without damping [Pa].
  Vector6 stress(const Vector6& strain) const { return stress_at_start + stiffness * strain; }
  /// Growth of the volume of the material by what the stress has changed, without damping [-].
  Real volumetric_strain(const Vector6& strain) const { return (stiffness * strain).head<3>().sum() / (3 * bulk_modulus); }
  /// Beyond what it was at the beginning [J].
  Real energy(const Vector6& strain) const {
    return volume * (stress_at_start.dot(strain) + 0.5 * strain.dot(stiffness * strain));
  }
};

class Elements final : public terms::Term<3> {
public:
  Elements(std::vector<DeformableElement> elements, const state::Bodies<3>& bodies);

  std::string_view name() const override { return "elements"; }
  std::span<const Link> links() const override { return links_; }
  bool joins_bodies() const override { return false; }
  std::vector<Index> first_links() const override;
  void evaluate(const Instant& now, std::span<const Due> due, const state::Bodies<3>& bodies) override;
  void gather(const Instant&, std::span<const Index>, const state::Bodies<3>&, std::span<state::Impulse<3>>,
              terms::CauseImpulses<3>&) const override {}
  bool acts_on_strains() const override { return true; }
  void gather_strain(const Instant& now, Index body, terms::StrainGathered& sum) const override;
  terms::Rates rates(Index body) const override;
  void add_energies(const terms::Synchronized<3>& at, terms::EnergySums& energies) const override;
  void carry(Index link, Parcel& parcel) override { parcel(slots_[at(link)]); }
  void columns(Archive& archive) override { archive("slots", slots_); }

  /// Of a body, or none where it is rigid.
  const DeformableElement* element_of(Index body) const {
    const Index link = link_of_[at(body)];
    return link < 0 ? nullptr : &elements_[at(link)];
  }

private:
  /// The force on the strain and for how long it is given, see terms/slot.hpp.
  struct Slot {
    terms::StrainForces<1, 1> force;
    Real acting = 0;
    Real ahead = 0;
    Real evaluated = -1;
  };

  std::vector<DeformableElement> elements_;
  std::vector<Link> links_;
  std::vector<Index> link_of_;  ///< by body, or -1
  std::vector<terms::Rates> rates_;
  std::vector<Slot> slots_;
};

}  // namespace sazare::methods::blocks
