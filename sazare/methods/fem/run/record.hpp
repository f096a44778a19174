#pragma once

/// What a run of method fem writes down: histories, gauges, snapshots, headline figures. It never changes the run.

#include <limits>

#include "sazare/methods/fem/run/columns.hpp"
#include "sazare/methods/fem/run/member_record.hpp"
#include "sazare/methods/fem/run/model.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_files.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

template <int D>
class FemRecord {
public:
  FemRecord(const RunFolder& folder, const cases::CaseFile& file, FemModel<D>& model, const RunClocks& clocks);

  void begin() { files_.begin(tables()); }
  void resume() { files_.resume(tables()); }
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk) { files_.flush(to_disk); }

  /// Throws PhysicsError when a displacement is no number.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;

  void columns(Archive& archive);

private:
  const methods::fem::FemStepper<D>& stepper() const { return *model_->stepper; }
  std::vector<RecordFiles::Table> tables() const;  ///< history, gauges
  std::vector<Real> history_row(Real time, Real wall_seconds);
  std::vector<Real> gauge_row(Real time);
  std::vector<Vector<D>> boundary_forces() const;
  std::array<Real, columns::fem::energies.size()> energies() const;
  std::vector<Real> densities() const;
  void write_snapshot(Real time);
  bool has_excess() const { return stepper().body().pores().size() > 0; }
  /// Of all pressure nodes [Pa].
  struct PoreExtremes {
    Real largest_excess = 0, least_excess = 0, least = 0;
  };
  PoreExtremes pore_extremes() const;
  void add_pressures(std::vector<Real>& total, std::vector<Real>& excess, std::vector<Real>& ratio);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  FemModel<D>* model_;
  RunClocks clocks_;
  RecordFiles files_;
  MemberRecord<D> members_;
  std::vector<Real> peaks_;           ///< largest speed by gauge [m/s]
  std::vector<Real> largest_forces_;  ///< by boundary and axis [N]
  std::vector<std::vector<std::pair<Index, Real>>> gauge_pressure_;  ///< by gauge: shares of pressure nodes
  std::vector<Real> initial_stress_;  ///< vertical effective stress by element at the beginning [Pa]
  Real peak_excess_ = 0;              ///< pore pressure [Pa]
  Real least_pressure_ = std::numeric_limits<Real>::infinity();  ///< of pore water [Pa]
  Real peak_ratio_ = 0;               ///< of pore pressure
  Real displacement_ = 0;             ///< largest of the last row [m]
  Real largest_displacement_ = 0, largest_speed_ = 0, largest_acceleration_ = 0;
};

extern template class FemRecord<2>;
extern template class FemRecord<3>;

}  // namespace sazare::runs
