#pragma once

/// Fills the regions of a case with particles on one lattice.

#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/mps/link_table.hpp"

namespace sazare::runs {

/// Particles of a lattice, in the order of memory: along the longest side of the body first, so that neighbours stand in rows.
template <int D>
struct Filling {
  std::vector<methods::mps::Site<D>> sites;
  std::vector<Index> region;             ///< by particle: the last region of the case that holds it
  Vector<D> origin = Vector<D>::Zero();  ///< lower corner of the site (0, 0) [m]
  Real spacing = 0;                      ///< [m]

  Vector<D> place(std::size_t particle) const {
    Vector<D> center;
    for (int axis = 0; axis < D; ++axis)
      center[axis] = origin[axis] + (sites[particle][static_cast<std::size_t>(axis)] + 0.5) * spacing;
    return center;
  }
};

/// Throws UserError when a region holds no particle, or rectangles do not stand on one lattice.
template <int D>
Filling<D> fill_regions(const cases::CaseFile& file);

extern template Filling<2> fill_regions<2>(const cases::CaseFile&);
extern template Filling<3> fill_regions<3>(const cases::CaseFile&);

}  // namespace sazare::runs
