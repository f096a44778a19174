#pragma once

/// Strengths of joints that scatter from face to face.
///
/// An entry of [[joints]] with a Weibull modulus has one kind of joint for each class of strength; strengths and fracture
/// energies of a kind are those of the entry times the factor of its class, so that joints of all kinds soften over the same
/// openings. Which class a face has follows from the seed and the numbers of its two elements alone.

#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/joints.hpp"

namespace sazare::runs {

/// Kinds of joints, and what they are in the case.
struct CaseKinds {
  std::vector<methods::blocks::JointKind> kinds;
  std::vector<Index> entry;  ///< of [[joints]], by kind
  std::vector<Real> factor;  ///< of the strength, by kind
};

/// Kinds of all entries; `faces`, whose kind is the number of their entry, get the number of their kind.
CaseKinds scatter_strengths(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                            std::vector<methods::blocks::JointFace>& faces);

}  // namespace sazare::runs
