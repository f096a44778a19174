#include "sazare/laws/weibull.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {
namespace {

constexpr std::size_t classes = 32;  // of strength: their spread is within 1 % of that of the distribution

}  // namespace

std::vector<Real> Joint::strength_factors() const {
  if (!bonded || !weibull_modulus) return {1};
  return laws::weibull_factors(*weibull_modulus, classes);
}

Joint Joint::scaled(Real factor) const {
  Joint joint = *this;
  joint.tensile_strength *= factor;
  joint.cohesion *= factor;
  joint.fracture_energy *= factor;
  for (std::size_t n = 0; n < joint.law_parameters.size(); ++n)
    if (joint.law_parameters[n] && laws::parameters_of_laws<laws::JointLaws>[n].unit == "N/m") *joint.law_parameters[n] *= factor;
  return joint;
}

}  // namespace sazare::cases
