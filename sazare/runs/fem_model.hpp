#pragma once

/// From a checked case of method fem to a body that can be stepped.

#include <memory>

#include "sazare/cases/case_file.hpp"
#include "sazare/engine/fem_stepper.hpp"
#include "sazare/geometry/linear_surface.hpp"

namespace sazare::runs {

template <int D>
struct FemModel {
  std::unique_ptr<engine::FemStepper<D>> stepper;
  std::vector<Index> gauges;             ///< node nearest to each gauge
  std::vector<std::string> group_names;  ///< of boundaries, as columns of the history name them
  Real step = 0;                         ///< [s]

  const geometry::ElementMesh& mesh() const { return stepper->body().mesh(); }
};

/// The mesh of a case. A .geo is meshed by gmsh into `made`, unless `keep` and it is there already.
geometry::ElementMesh load_fem_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep);

/// Throws UserError when the case does not fit its mesh, or nothing holds the body.
template <int D>
FemModel<D> build_fem(const cases::CaseFile& file, geometry::ElementMesh mesh);

/// Of nodes, elements and groups.
std::string mesh_hash(const geometry::ElementMesh& mesh);

/// The surface that a hybrid case names, in the mesh of its continuum. Throws UserError where it is no surface of the body.
geometry::LinearSurface coupled_surface(const cases::CaseFile& hybrid, const geometry::ElementMesh& mesh);

extern template FemModel<2> build_fem<2>(const cases::CaseFile&, geometry::ElementMesh);
extern template FemModel<3> build_fem<3>(const cases::CaseFile&, geometry::ElementMesh);

}  // namespace sazare::runs
