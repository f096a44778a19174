#include <fmt/format.h>

#include <array>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/case/checks.hpp"

namespace sazare::cases {
namespace {

using laws::BartonBandis;

constexpr std::array<std::string_view, 9> keys_of_strength{
    "cohesion",        "friction_coefficient", "friction_angle", "tensile_strength",    "fracture_energy",
    "weibull_modulus", "scatter_seed",         "rate_law",       "rate_energy_exponent"};
constexpr Real most_jrc = 20, most_residual_angle = 70, least_jcs = 1e5, most_aperture = 5e-3, most_damage = 2;

/// Keys that no joint without strength takes.
std::vector<std::string_view> strength_keys() {
  std::vector<std::string_view> keys(keys_of_strength.begin(), keys_of_strength.end());
  for (const laws::LawParameter& parameter : laws::parameters_of_laws<laws::RateLaws>) keys.push_back(parameter.name);
  return keys;
}

constexpr std::string_view by_test = "initial_normal_stiffness and maximum_closure";

/// Reports what is wrong with a natural joint, key by key.
class NaturalJointCheck {
public:
  NaturalJointCheck(const CheckContext& context, const Entry& entry, const Joint& joint)
      : context_(context), entry_(entry), own_(laws::own_parameters<laws::JointLaws, BartonBandis>(joint.law_parameters)) {}

  void check(const Joint& joint) const {
    check_keys(context_, entry_, "law barton_bandis", {}, strength_keys(),
               "remove it: a natural joint has no strength without pressure, and its friction follows from jrc, jcs and "
               "residual_friction_angle");
    if (entry_.gives("joint_shear_stiffness") && joint.shear_stiffness == Real{0})
      error("joint_shear_stiffness",
            "law barton_bandis needs a joint_shear_stiffness above 0: without it no slip loads the joint",
            "give a joint_shear_stiffness above 0");
    check_ranges();
    check_lengths();
    check_closure();
  }

private:
  void error(std::string_view key, const std::string& what, const std::string& help) const {
    context_.problems.error(entry_.place(key), what, help);
  }

  void check_ranges() const {
    if (entry_.gives("jrc") && *own_[BartonBandis::jrc] > most_jrc)
      error("jrc", fmt::format("jrc {} is above {}", short_number(*own_[BartonBandis::jrc]), short_number(most_jrc)),
            "the joint roughness coefficient is 0 for a plane joint and 20 for the roughest profile of Barton and Choubey");
    if (entry_.gives("jcs") && *own_[BartonBandis::jcs] < least_jcs)
      error("jcs", fmt::format("jcs {} Pa is less than any rock has", short_number(*own_[BartonBandis::jcs])),
            "jcs is in Pa: 100 MPa are 100e6");
    if (const auto& angle = own_[BartonBandis::residual_friction_angle];
        entry_.gives("residual_friction_angle") && *angle >= most_residual_angle)
      error("residual_friction_angle",
            fmt::format("residual_friction_angle {} deg is not below {} deg", short_number(*angle),
                        short_number(most_residual_angle)),
            "the friction angle with all roughness is at most 70 deg; residual ones are some 20 to 35 deg");
    else if (entry_.gives("residual_friction_angle") && *angle == 0)
      context_.problems.warning(entry_.place("residual_friction_angle"),
                                "residual_friction_angle 0 deg: before it is rough by slip, the joint has no friction at all",
                                "residual ones are some 20 to 35 deg");
    if (const auto& damage = own_[BartonBandis::damage];
        entry_.gives("damage_coefficient") && (*damage < 1 || *damage > most_damage))
      error("damage_coefficient", fmt::format("damage_coefficient {} is not from 1 to 2", short_number(*damage)),
            "it is 1 where asperities are overridden, under low stress, and 2 where they are damaged");
  }

  void check_lengths() const {
    if (!entry_.gives("laboratory_length") || !entry_.gives("joint_length")) return;
    const Real specimen = *own_[BartonBandis::laboratory_length], joint = *own_[BartonBandis::joint_length];
    if (specimen <= joint) return;
    error("laboratory_length",
          fmt::format("laboratory_length {} m is above the joint_length {} m", short_number(specimen), short_number(joint)),
          "the scale correction is from short specimens to a longer joint; give jrc and jcs of the joint itself, without "
          "laboratory_length");
  }

  void check_closure() const {
    const bool aperture = entry_.has("joint_aperture");
    for (const auto& [key, other] : {std::pair<std::string_view, std::string_view>{"initial_normal_stiffness", "maximum_closure"},
                                     {"maximum_closure", "initial_normal_stiffness"}}) {
      if (!entry_.has(key)) continue;
      if (aperture)
        error(key, fmt::format("closure is given twice, by joint_aperture and by {}", key),
              fmt::format("keep joint_aperture, from which closure is estimated, or {} from tests", by_test));
      else if (!entry_.has(other))
        error(key, fmt::format("{} without {}", key, other), fmt::format("add {} = ..., or give joint_aperture instead", other));
    }
    const bool is_sound = entry_.gives("joint_aperture") && entry_.gives("jrc") && entry_.gives("jcs");
    if (is_sound && *own_[BartonBandis::jrc] <= most_jrc && *own_[BartonBandis::jcs] >= least_jcs) check_estimate();
  }

  /// The regressions hold for joints like those from which they come.
  void check_estimate() const {
    const Real aperture = *own_[BartonBandis::joint_aperture];
    if (aperture > most_aperture)
      return error("joint_aperture",
                   fmt::format("joint_aperture {} m is too large for a joint whose sides touch", short_number(aperture)),
                   "it is in m: 0.2 mm are 0.2e-3; tests were with 0.1 to 0.6 mm");
    const Real stiffness = BartonBandis::initial_stiffness_of(own_), closure = BartonBandis::closure_of(own_);
    std::string failed;
    if (stiffness <= 0) failed = fmt::format("K_ni would be {} Pa/m, not above 0", short_number(stiffness, 3));
    if (closure <= 0 || closure > aperture)
      failed +=
          fmt::format("{}V_m would be {} m, {} {} m", failed.empty() ? "" : ", and ", short_number(closure, 3),
                      closure > 0 ? "more than the aperture of" : "not above", closure > 0 ? short_number(aperture, 3) : "0");
    if (failed.empty()) return;
    error(
        "joint_aperture", fmt::format("no closure follows from this joint_aperture, jrc and jcs: {}", failed),
        fmt::format("the formulas come from joints with a jrc of 5 to 15, a jcs of 22 to 182 MPa and apertures of 0.1 to 0.6 mm, "
                    "and fail for many that are tighter, smoother or softer; give {} from tests instead, or a larger aperture",
                    by_test));
  }

  const CheckContext& context_;
  const Entry& entry_;
  BartonBandis::Own own_;
};

}  // namespace

void check_natural_joint(const CheckContext& context, const Entry& entry, const Joint& joint) {
  NaturalJointCheck(context, entry, joint).check(joint);
}

}  // namespace sazare::cases
