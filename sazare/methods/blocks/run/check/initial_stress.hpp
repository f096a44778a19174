#pragma once

/// What of an initial stress joints and boundaries cannot carry.

#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/run/joints/strength_scatter.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

/// Faces of an entry of [[joints]] that begin beyond their strength.
struct OverstressedFaces {
  Index faces = 0;
  Real worst = 0;  ///< stress over strength
};

std::vector<OverstressedFaces> find_overstressed(const cases::BlocksCase& blocks, const CaseKinds& kinds,
                                                 const std::vector<methods::blocks::JointFace>& faces);

/// Forces at the beginning that nothing balances.
struct StartBalance {
  Vector3 unbalanced =
      Vector3::Zero();             ///< of the stress on all outer faces and of the weight: 0 where they are in equilibrium [N]
  Vector3 lost = Vector3::Zero();  ///< of the stress that no boundary carries, which an opening in equilibrium has not [N]
  Real largest = 0;                ///< sum of the forces of the stress on all outer faces [N]
  Real weight = 0;                 ///< [N]
  Index unloaded = 0;              ///< faces on which a stress that is not 0 is not carried
  Real unloaded_stress = 0;        ///< largest traction that is not carried [Pa]
  Real above_datum = 0;            ///< how far the body reaches above the datum of k0, where it begins in tension [m]

  bool is_in_equilibrium() const;
};

/// `free_faces` are those that no joint holds.
StartBalance find_balance(const cases::BlocksCase& blocks, const MeshFaces& faces, const state::Bodies<3>& bodies,
                          const std::vector<methods::blocks::FreeFace>& free_faces);

/// Warnings at their lines of the case.
std::string warn_of_initial_stress(const cases::CaseFile& file, const std::vector<OverstressedFaces>& overstressed,
                                   const StartBalance& balance);

/// What `check` says of the initial stress; empty where there is none.
std::string explain_initial_stress(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh, const StartBalance& balance);

}  // namespace sazare::runs
