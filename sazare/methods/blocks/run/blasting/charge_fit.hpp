#pragma once

/// How the charges of a case fit the holes of its mesh.

#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"
#include "sazare/methods/blocks/run/parts.hpp"

namespace sazare::runs {

struct ChargeFit {
  Index faces = 0;    ///< of the wall, beside the explosive
  Real distance = 0;  ///< of their corners from the axis of the hole, the mean [m]
  Real around = 0;    ///< faces on a circumference
  Real area = 0;      ///< of the wall around the explosive, ends left out [m2]

  bool is_coarse() const { return around > 0 && around < HoleWall::few_faces; }
};

/// By entry of [[charges]].
std::vector<ChargeFit> find_charge_fits(const cases::BlocksCase& blocks, const MeshFaces& faces);

/// Warnings ready to print, each at its line of the case. Throws a UserError where a charge stands at no face.
std::string warn_of_charges(const cases::CaseFile& file, const std::vector<ChargeFit>& fits);

}  // namespace sazare::runs
