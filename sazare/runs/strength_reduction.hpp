#pragma once

/// The strength of the ground of a case divided by a factor, as studies that look for its factor of safety ask for it.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sazare/core/stop_request.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::runs {

struct StrengthTrialRules {
  std::optional<Real> factor;  ///< by which strengths are divided; none: the ground is elastic and bears whatever it must
  Real most_displacement = std::numeric_limits<Real>::infinity();  ///< with more the ground runs away [m]
  StopRequest stop = {};                                           ///< a trial ends when it is set, and then says nothing
};

/// How the ground fares under gravity.
struct StrengthTrial {
  bool stands = false;
  Real displacement = 0;  ///< the largest, when the trial ended [m]
  std::string end;        ///< how it ended, in words
};

/// Ground at a place at the end of a trial.
struct MovedGround {
  Vector3 place = Vector3::Zero();         ///< at the beginning [m]
  Vector3 displacement = Vector3::Zero();  ///< [m]
  Real slip = 0;                           ///< plastic shear strain [-]
};

/// A case whose ground is tried with one strength after another, each time from the beginning.
class StrengthReduction {
public:
  StrengthReduction() = default;
  StrengthReduction(const StrengthReduction&) = delete;
  StrengthReduction& operator=(const StrengthReduction&) = delete;
  virtual ~StrengthReduction() = default;

  /// Throws UserError where the case does not fit its geometry, MachineError.
  virtual StrengthTrial try_out(const StrengthTrialRules& rules) = 0;
  /// At the end of the last trial; empty before the first one.
  virtual std::vector<MovedGround> ground() const = 0;
  /// Particles or elements; 0 before the first trial.
  virtual std::int64_t size() const = 0;
  /// How many times the displacement without a limit of strength the ground may move where a study does not say.
  virtual Real usual_displacement_ratio() const = 0;
  /// About the last trial, ready to print; empty where there is nothing to warn of.
  virtual std::string warning() const { return {}; }
};

/// Dividing cohesion and tan(angle) by the factor; the dilation angle stays, but is at most the friction angle. Angles in
/// degrees.
struct ReducedStrength {
  Real cohesion = 0;                     ///< [Pa]
  Real friction_angle = 0;               ///< [degrees]
  Real dilation_angle = 0;               ///< [degrees]
  std::optional<Real> tensile_strength;  ///< [Pa]

  ReducedStrength over(Real factor) const;
};

}  // namespace sazare::runs
