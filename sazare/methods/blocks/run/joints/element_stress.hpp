#pragma once

/// Mean stress of elements: of deformable ones from their strain, of rigid ones from the forces of their joints.
///
/// The mean stress of a body that is in equilibrium is (Love, Weber)
///
///     s = 1/V sum (x - o) f^T          x  centre of a face;  f  force of its joint on the element;  o  any point
///
/// exact where the stress is uniform. What acts on an open face, a boundary, a pressure or a contact, is not among the joints:
/// there o is the centre of that face, or the middle of those of several, and what acts in it drops out. So an element with one
/// open face is as exact as one without; with several it is so where all of them are free.

#include <vector>

#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// By element; tension is positive [Pa].
struct ElementStresses {
  std::vector<Vector3> normal;  ///< xx, yy, zz
  std::vector<Vector3> shear;   ///< xy, yz, zx
  std::vector<Real> von_mises;
  std::vector<Real> largest, smallest;  ///< principal stresses
  std::vector<Real> volumetric_strain;  ///< of deformable elements, else 0
};

/// As joints were last evaluated, at a base step; bodies stand as the snapshot says.
ElementStresses element_stresses(const BlocksModel& model, const levels::Snapshot<3>& now);

}  // namespace sazare::runs
