#pragma once

/// How the strength of joints follows the rate at which they are loaded.
///
///     e = c (d - d_0)/(t - t_0)
///     strength f(e), energy f^n times the static one
///
/// d     opening of the vertex that opens most [m]
/// d_0   and t_0: that opening and its time, when the joint bore less than half of its static strength for the last time
/// c     strain per opening: stiffness of the face over Young's modulus [1/m]
///
/// f is limited so that softening begins before it ends: f d_e <= d_u f^(n-1).
///
/// So e is the mean rate of stress over Young's modulus from half of the strength on, as tests have it, and what shakes within an
/// element on the way does not count. The factor f follows an intact joint, whose force does not depend on its strength; from the
/// evaluation on in which the joint softens it stays. Then the joint is one of its law with another strength and fracture energy,
/// which gains nothing on any path.

#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/parcel.hpp"
#include "sazare/core/time.hpp"
#include "sazare/laws/dynamic_increase.hpp"

namespace sazare::methods::blocks {

/// The rate law of a joint.
struct JointRate {
  Index law = -1;               ///< among those of the run; -1: none
  Real strain_per_opening = 0;  ///< c [1/m]
};

class StrengthByRate {
public:
  StrengthByRate() = default;
  /// `joints` by joint; none where no joint has a rate law.
  StrengthByRate(std::vector<laws::DynamicIncrease> laws, std::vector<JointRate> joints);

  bool is_used() const { return !memory_.empty(); }
  bool has(Index joint) const { return is_used() && joints_[at(joint)].law >= 0; }
  /// On the strength.
  Real factor(Index joint) const { return is_used() ? memory_[at(joint)].factor : 1; }
  /// On the openings and slips that use up the strength.
  Real length_factor(Index joint) const {
    return has(joint) ? laws_[at(joints_[at(joint)].law)].length_factor(factor(joint)) : 1;
  }

  /// Lets an intact joint have the factor of its rate; openings of the static law at which it softens and fails.
  void follow(Index joint, Real seconds, Real opening, Real elastic_opening, Real failure_opening);

  void carry(Index joint, Parcel& parcel);
  void columns(Archive& archive);

private:
  struct Memory {
    Real time = 0;     ///< t_0 [s]
    Real opening = 0;  ///< d_0 [m]
    Real factor = 1;
  };

  std::vector<laws::DynamicIncrease> laws_;
  std::vector<JointRate> joints_;
  std::vector<Memory> memory_;  ///< by joint
};

}  // namespace sazare::methods::blocks
