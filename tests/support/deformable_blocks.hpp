#pragma once

/// Scenes of deformable blocks, and bodies that are strained and turned as no symmetry would.

#include "sazare/methods/blocks/run/joints/deformable_elements.hpp"
#include "tests/support/blocks_scene.hpp"

namespace sazare::test {

/// All materials of a case deformable, its joints without dashpots, with springs that follow from the elements.
inline cases::BlocksCase deformable(cases::BlocksCase blocks, Real youngs_modulus = 40e9) {
  for (cases::Material& material : blocks.materials) {
    material.youngs_modulus = youngs_modulus;
    material.poisson_ratio = 0.25;
    material.deformable = true;
  }
  for (cases::Joint& joint : blocks.joints) {
    joint.normal_stiffness = joint.shear_stiffness = std::nullopt;
    joint.normal_damping = joint.shear_damping = 0;
  }
  return blocks;
}

/// The elements of a mesh at rest.
inline state::Bodies<3> deformable_bodies(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh) {
  const auto material = runs::materials_by_element(blocks, mesh);
  state::Bodies<3> bodies = runs::make_bodies(blocks, mesh, material);
  runs::add_strains(blocks, material, bodies);
  return bodies;
}

/// Strains two bodies.
inline void strain_both(state::Bodies<3>& bodies) {
  bodies.strain[0].strain << 1e-4, -2e-4, 3e-5, 5e-5, -1e-4, 2e-4;
  bodies.strain[1].strain << -1e-4, 1e-4, 6e-5, -8e-5, 1e-4, 3e-5;
}

inline void turn(state::Bodies<3>& bodies, std::size_t body, const Vector3& by) {
  bodies.motion[body].rotation = state::turn(by, 1) * bodies.motion[body].rotation;
}

/// All bodies about the origin, with their velocities.
inline void turn_all(state::Bodies<3>& bodies, const Vector3& by) {
  const Matrix3 turned = state::turn(by, 1);
  for (auto& motion : bodies.motion) {
    motion.position = turned * motion.position;
    motion.rotation = turned * motion.rotation;
    motion.velocity = turned * motion.velocity;
    motion.spin = turned * motion.spin;
  }
}

}  // namespace sazare::test
