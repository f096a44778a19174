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

/// How the tractions of boundaries and the weight of the body fit together at the beginning.
struct StartBalance {
  Vector3 resultant = Vector3::Zero();  ///< of both; 0 where they are in equilibrium [N]
  Real largest = 0;                     ///< sum of their sizes [N]
  Index unloaded = 0;                   ///< outer faces without a boundary on which the stress is not 0
  Real unloaded_stress = 0;             ///< largest traction on one of them [Pa]
};

StartBalance find_balance(const cases::BlocksCase& blocks, const MeshFaces& faces, const state::Bodies<3>& bodies,
                          const std::vector<methods::blocks::OuterFace>& boundaries);

/// Warnings at their lines of the case.
std::string warn_of_initial_stress(const cases::CaseFile& file, const std::vector<OverstressedFaces>& overstressed,
                                   const StartBalance& balance);

/// What `check` says of the initial stress; empty where there is none.
std::string explain_initial_stress(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh, const StartBalance& balance);

}  // namespace sazare::runs
