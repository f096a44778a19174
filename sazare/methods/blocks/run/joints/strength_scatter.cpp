#include "sazare/methods/blocks/run/joints/strength_scatter.hpp"

#include <algorithm>
#include <cstdint>

#include "sazare/core/mixed_hash.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {
namespace {

/// A class for a face, each as likely as the others.
Index class_of(const methods::blocks::JointFace& face, const geometry::TetraMesh& mesh, int seed, std::size_t classes) {
  const auto [lower, higher] = std::minmax({geometry::element_tag(mesh, face.master), geometry::element_tag(mesh, face.slave)});
  std::uint64_t hash = mixed_hash(0, static_cast<std::uint64_t>(seed));
  hash = mixed_hash(mixed_hash(hash, static_cast<std::uint64_t>(lower)), static_cast<std::uint64_t>(higher));
  return static_cast<Index>((hash >> 11) % classes);
}

}  // namespace

CaseKinds scatter_strengths(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                            std::vector<methods::blocks::JointFace>& faces) {
  CaseKinds made;
  std::vector<Index> first;          // kind, by entry
  std::vector<std::size_t> classes;  // by entry
  for (std::size_t entry = 0; entry < blocks.joints.size(); ++entry) {
    first.push_back(static_cast<Index>(made.kinds.size()));
    const std::vector<Real> factors = blocks.joints[entry].strength_factors();
    classes.push_back(factors.size());
    for (const Real factor : factors) {
      made.kinds.push_back(make_joint_kind(blocks.joints[entry].scaled(factor)));
      made.entry.push_back(static_cast<Index>(entry));
      made.factor.push_back(factor);
    }
  }
  for (methods::blocks::JointFace& face : faces) {
    const std::size_t entry = at(face.kind);
    face.kind = first[entry] + class_of(face, mesh, blocks.joints[entry].scatter_seed, classes[entry]);
  }
  return made;
}

}  // namespace sazare::runs
