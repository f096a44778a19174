#pragma once

/// What of a case holds for fewer faces of its mesh than its user may think.

#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/blasting/blast_walls.hpp"
#include "sazare/methods/blocks/run/blasting/charge_fit.hpp"
#include "sazare/methods/blocks/run/check/initial_stress.hpp"
#include "sazare/methods/blocks/run/joints/element_springs.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

/// Faces between elements of two materials that no entry of [[joints]] holds for.
struct UnjoinedFaces {
  Index first = 0, second = 0;  ///< materials
  Index count = 0;
};

struct MeshFit {
  std::vector<UnjoinedFaces> unjoined;
  std::vector<Index> faces_of_joint;                ///< by entry of [[joints]]
  std::vector<SoftestFaces> softest_of_joint = {};  ///< by entry of [[joints]]
  std::vector<OverstressedFaces> overstressed = {};  ///< by entry of [[joints]], at the beginning
  StartBalance start_balance = {};
  std::vector<ChargeFit> charges;                   ///< by entry of [[charges]]
  std::vector<HoleWall> blast_walls;                ///< by entry of [[blasts]]
  std::vector<Index> inner_of_blast;                ///< by entry of [[blasts]]: faces of its surface between two elements
  std::vector<Index> inner_of_charge;               ///< by entry of [[charges]]: faces of its surface between two elements
  std::vector<Index> inner_of_boundary;             ///< by entry of [[boundaries]]: faces of its surface between two elements
};

MeshFit find_mesh_fit(const cases::BlocksCase& blocks, const MeshFaces& faces, const std::vector<Index>& material,
                      const std::vector<Index>& joint_of_face);

/// Warnings ready to print, each at its line of the case; empty where all is as one would think. Throws a UserError where
/// elements are so large that their joints would break before they are elastic no more.
std::string warn_of_mesh_fit(const cases::CaseFile& file, const MeshFit& fit);

}  // namespace sazare::runs
