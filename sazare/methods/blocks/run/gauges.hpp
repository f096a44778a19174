#pragma once

/// Gauges: the velocity of a point of the ground, which moves with the element that holds it at the beginning.

#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/archive.hpp"
#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

class Gauges {
public:
  /// Throws UserError at the gauges of the case that lie in no element.
  Gauges(const cases::CaseFile& file, const geometry::TetraMesh& mesh);

  /// Names of the columns of a row, with their units.
  std::vector<std::string> titles() const;

  /// A row of the table, and the peaks raised by it.
  std::vector<Real> sample(Real time, const state::Bodies<3>& bodies, const levels::Snapshot<3>& now);

  /// Peak particle velocity by gauge: the largest speed of the rows so far [m/s].
  std::vector<std::pair<std::string, Real>> peaks() const;

  void columns(Archive& archive) { archive("peaks", peaks_); }

private:
  std::vector<std::string> names_;
  std::vector<Vector3> points_;
  std::vector<Index> elements_;
  std::vector<Real> peaks_;
};

/// The first element that holds a point, or -1.
Index element_at(const geometry::TetraMesh& mesh, const Vector3& point);

}  // namespace sazare::runs
