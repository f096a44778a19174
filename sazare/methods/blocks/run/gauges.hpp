#pragma once

/// Gauges: the velocity of a point of the ground, which moves with the element that holds it at the beginning.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/archive.hpp"
#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::runs {

/// The strongest motion of a gauge so far.
struct GaugePeak {
  Real speed = 0;                    ///< largest magnitude of the velocity [m/s]
  Real time = 0;                     ///< when that was [s]
  std::array<Real, 3> components{};  ///< largest magnitude of each component of the velocity [m/s]

  void raise(Real time, const Vector3& velocity);
  /// Those of another process, which has seen other moments of the same gauge.
  void raise(const GaugePeak& other);
};

class Gauges {
public:
  /// Throws UserError at the gauges of the case that lie in no element.
  Gauges(const cases::CaseFile& file, const geometry::TetraMesh& mesh);

  /// Names of the columns of a row, with their units.
  std::vector<std::string> titles() const;

  /// Looks at the gauges at a base step, which cost no more than their own elements; with several processes, at those whose
  /// elements this process works for. All peaks are those of the base steps, however seldom a row is written.
  void watch(Real time, const levels::Simulation<3>& simulation);

  /// With several processes: the peaks of all of them. All call it.
  void unite(const parallel::Ranks& ranks);

  /// A row of the table, which raises the peaks too: a coupled run has no base steps of its own to be watched.
  std::vector<Real> sample(Real time, const state::Bodies<3>& bodies, const levels::Snapshot<3>& now);

  /// Peak particle velocity by gauge: the largest speed so far [m/s].
  std::vector<std::pair<std::string, Real>> peaks() const;

  /// Writes gauge_peaks.csv.
  void write_peaks(const std::filesystem::path& file) const;

  void columns(Archive& archive) { archive("strongest", peaks_); }

private:
  std::vector<std::string> names_;
  std::vector<Vector3> points_;
  std::vector<Index> elements_;
  std::vector<GaugePeak> peaks_;
};

/// The first element that holds a point, or -1.
Index element_at(const geometry::TetraMesh& mesh, const Vector3& point);

}  // namespace sazare::runs
