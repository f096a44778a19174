#include "sazare/methods/blocks/run/natural_joints.hpp"

#include <algorithm>

namespace sazare::runs {

namespace blocks = methods::blocks;

NaturalJoints natural_joints(const blocks::Joints& joints) {
  NaturalJoints all;
  bool some = false;
  for (Index joint = 0; joint < joints.count() && !some; ++joint) some = joints.is_natural(joint);
  if (!some) return all;
  for (auto* numbers : {&all.path, &all.mobilised_jrc, &all.closure, &all.dilation}) numbers->resize(at(joints.count()));
  for (Index joint = 0; joint < joints.count(); ++joint) {
    if (!joints.is_natural(joint)) continue;
    const blocks::ElasticJoint kind = joints.elastic(joint);
    const blocks::FaceStress stress = joints.last_stress(joint);
    const bool is_closed = joints.state(joint) != blocks::JointState::broken;
    const Real path = std::ranges::max(joints.slip_paths()[at(joint)]);
    all.path[at(joint)] = path;
    all.mobilised_jrc[at(joint)] = mobilised_coefficient(kind.rough, laws::mobilised_roughness(path / kind.rough.peak_slip));
    for (std::size_t v = 0; v < blocks::vertex_count; ++v) {
      const Real pressure = is_closed ? std::max(-stress[v].x(), Real{0}) : 0;
      all.closure[at(joint)] = std::max(all.closure[at(joint)], closure_under(kind.closure, pressure));
      all.dilation[at(joint)] = std::max(all.dilation[at(joint)], joints.record(joint).vertex[v].peak);
    }
  }
  return all;
}

}  // namespace sazare::runs
