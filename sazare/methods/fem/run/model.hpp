#pragma once

/// From a checked case of method fem to a body that can be stepped.

#include <memory>

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/linear_surface.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::runs {

template <int D>
struct FemModel {
  std::unique_ptr<methods::fem::FemStepper<D>> stepper;
  std::vector<Index> gauges;             ///< node nearest to each gauge
  std::vector<std::string> group_names;  ///< of boundaries, as columns of the history name them
  std::string warnings;                  ///< ready to print
  Real step = 0;                         ///< [s]

  const geometry::ElementMesh& mesh() const { return stepper->body().mesh(); }
};

/// The mesh of a case. A .geo is meshed by gmsh into `made`, unless `keep` and it is there already.
geometry::ElementMesh load_fem_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep);

/// Throws UserError when the case does not fit its mesh, or nothing holds the body.
template <int D>
FemModel<D> build_fem(const cases::CaseFile& file, geometry::ElementMesh mesh);

/// Hash of the nodes, elements and groups of a mesh.
std::string mesh_hash(const geometry::ElementMesh& mesh);

/// The surface of the body that a group of faces makes. Throws UserError at `key` of `source` where it is none.
geometry::LinearSurface outer_surface(const cases::CaseSource& source, const std::string& key, const std::string& group,
                                      const geometry::ElementMesh& mesh);

extern template FemModel<2> build_fem<2>(const cases::CaseFile&, geometry::ElementMesh);
extern template FemModel<3> build_fem<3>(const cases::CaseFile&, geometry::ElementMesh);

}  // namespace sazare::runs
