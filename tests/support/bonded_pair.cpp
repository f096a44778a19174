#include "tests/support/bonded_pair.hpp"

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::test {

namespace {

state::Bodies<3> make_bodies(const geometry::TetraMesh& mesh) {
  const auto blocks = two_block_case(true);
  return runs::make_bodies(blocks, mesh, runs::materials_by_element(blocks, mesh));
}

methods::blocks::Joints make_joints(const cases::Joint& joint, Real strain_per_opening, const geometry::TetraMesh& mesh,
                                    const state::Bodies<3>& bodies) {
  const auto map = geometry::build_face_map(mesh);
  const auto& shared = map.interior.at(0);
  methods::blocks::JointFace face{shared.element_i, shared.element_j, 0, shared.face_i, shared.face_j, {}};
  for (std::size_t corner = 0; corner < 3; ++corner)
    face.corners[corner] = mesh.nodes[static_cast<std::size_t>(shared.nodes[corner])];
  if (joint.follows_rate()) face.rate = {0, strain_per_opening};
  const std::vector kinds{runs::make_joint_kind(joint)};
  auto rates = methods::blocks::joint_rates(methods::blocks::elastic_joints(kinds), std::vector{face}, bodies);
  return {kinds, std::vector{face}, std::move(rates), bodies, {joint.by_rate}};
}

}  // namespace

BondedPair::BondedPair(const cases::Joint& joint, Real strain_per_opening)
    : bodies_(make_bodies(two_blocks())),
      joints_(make_joints(joint, strain_per_opening, two_blocks(), bodies_)),
      probe_(joints_, bodies_) {}

void BondedPair::place(Real n, Real s, Real t) { bodies_.motion[1].position = start() + Vector3(n, s, t); }

Vector3 BondedPair::stress() { return -forces()[1].linear / area(); }

}  // namespace sazare::test
