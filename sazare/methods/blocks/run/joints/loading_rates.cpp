#include "sazare/methods/blocks/run/joints/loading_rates.hpp"

namespace sazare::runs {

std::vector<laws::DynamicIncrease> add_loading_rates(const cases::BlocksCase& blocks, const std::vector<Index>& material,
                                                     std::vector<methods::blocks::JointFace>& faces) {
  const auto young = [&](Index element) { return blocks.materials[at(material[at(element)])].youngs_modulus.value(); };
  for (methods::blocks::JointFace& face : faces) {
    const cases::Joint& joint = blocks.joints[at(face.kind)];
    if (!joint.follows_rate()) continue;
    const Real stiffness = face.own ? face.own->normal_stiffness : joint.normal_stiffness.value();
    face.rate = {face.kind, stiffness * 0.5 * (1 / young(face.master) + 1 / young(face.slave))};
  }
  std::vector<laws::DynamicIncrease> rate_laws;
  for (const cases::Joint& joint : blocks.joints) rate_laws.push_back(joint.by_rate);
  return rate_laws;
}

}  // namespace sazare::runs
