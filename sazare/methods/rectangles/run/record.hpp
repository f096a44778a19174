#pragma once

/// What a run of method rectangles writes down: histories, gauges, snapshots, headline figures. It never changes the run.

#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/record_files.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

/// The element that holds each gauge of a case. Throws UserError when none does.
std::vector<std::size_t> gauge_elements(const cases::CaseFile& file, const RectanglesModel& model);

/// Energies at a time [J].
struct EnergyBalance {
  Real kinetic = 0;
  Real work = 0;      ///< of gravity, supports and the plate, and what was there at the beginning
  Real residual = 0;  ///< of the energy balance
  methods::rectangles::EnergyParts energies;
};

class RectanglesRecord {
public:
  /// Writes nothing yet. Throws UserError when a gauge lies in no element.
  RectanglesRecord(const RunFolder& folder, const cases::CaseFile& file, RectanglesModel& model, const RunClocks& clocks);

  void begin() { files_.begin(tables()); }
  void resume() { files_.resume(tables()); }
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk) { files_.flush(to_disk); }

  /// Throws PhysicsError when an acceleration is no number.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;
  /// At the last row [J].
  Real energy_residual() const { return balance_.residual; }

  void columns(Archive& archive);

private:
  std::vector<RecordFiles::Table> tables() const;  ///< history, gauges
  EnergyBalance balance() const;
  void add_history(Real time, Real wall_seconds);
  void add_gauges(Real time, const state::FreedomColumns<2>& velocity, const state::FreedomColumns<2>& acceleration);
  void write_snapshot(Real time, const state::FreedomColumns<2>& velocity);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  RectanglesModel* model_;
  RunClocks clocks_;
  std::vector<std::string> supports_;  ///< names
  std::vector<std::size_t> gauge_elements_;
  RecordFiles files_;
  std::vector<Real> peaks_;          ///< largest speed by gauge [m/s]
  std::vector<Real> largest_force_;  ///< by support [N]
  Real largest_displacement_ = 0, largest_speed_ = 0;
  Real energy_at_beginning_ = 0;
  EnergyBalance balance_;
};

}  // namespace sazare::runs
