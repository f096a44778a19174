#include "sazare/methods/blocks/strength_by_rate.hpp"

#include <algorithm>
#include <utility>

namespace sazare::methods::blocks {

namespace {

constexpr Real most_increase = 100;  // more than any formula gives where something was measured: keeps absurd constants finite

}  // namespace

StrengthByRate::StrengthByRate(std::vector<laws::DynamicIncrease> laws, std::vector<JointRate> joints)
    : laws_(std::move(laws)), joints_(std::move(joints)) {
  if (std::ranges::any_of(joints_, [](const JointRate& joint) { return joint.law >= 0; })) memory_.resize(joints_.size());
}

void StrengthByRate::follow(Index joint, Real seconds, Real opening, Real elastic_opening, Real failure_opening) {
  const auto& [law, strain_per_opening] = joints_[at(joint)];
  Memory& memory = memory_[at(joint)];
  const bool is_first = seconds <= memory.time || memory.time < 0;  // below 0 bodies still come to rest
  if (opening < 0.5 * elastic_opening || is_first) {
    memory = {seconds, opening, 1};
    return;
  }
  const Real rate = strain_per_opening * (opening - memory.opening) / (seconds - memory.time);
  const laws::DynamicIncrease& increase = laws_[at(law)];
  const Real most = std::min(most_increase, increase.largest_factor(failure_opening / elastic_opening));
  memory.factor = std::max<Real>(1, std::min(increase.factor(rate), most));
}

void StrengthByRate::carry(Index joint, Parcel& parcel) {
  if (is_used()) parcel(memory_[at(joint)]);
}

void StrengthByRate::columns(Archive& archive) { archive("strength_by_rate", memory_); }

}  // namespace sazare::methods::blocks
