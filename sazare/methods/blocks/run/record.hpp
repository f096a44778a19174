#pragma once

/// What a run writes down as it goes: histories, gauges, snapshots, and at its end fragments and headline figures.
/// It reads the simulation and never changes it.

#include <optional>

#include "sazare/methods/blocks/run/blasting/half_casts.hpp"
#include "sazare/methods/blocks/run/gauges.hpp"
#include "sazare/methods/blocks/run/snapshots.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/record_files.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

class RunRecord {
public:
  /// Writes nothing yet. Throws UserError when a gauge lies in no element.
  RunRecord(const RunFolder& folder, const cases::CaseFile& file, BlocksModel& model, const RunClocks& clocks);

  /// Makes the tables of a new run.
  void begin();

  /// Goes on with the tables and snapshots of an earlier run, of which `columns` has read how far they count.
  void resume();

  /// Looks at the gauges at a base step.
  void watch(std::int64_t step) { gauges_.watch(clocks_.time(step), *model_->simulation); }

  /// With several processes, what each has seen of the gauges becomes known to all. All call it.
  void unite(const parallel::Ranks& ranks) { gauges_.unite(ranks); }

  /// Looks at what is to be written at a base step: for several processes of a run, which all call it before the first one
  /// writes.
  void survey(std::int64_t step, const parallel::Ranks* ranks);

  /// Writes what is due at a base step.
  void observe(std::int64_t step, Real wall_seconds);

  /// Hands the tables to the system; all that was written to the disk where `to_disk`.
  void flush(bool to_disk);

  /// Throws PhysicsError when the motion of an element has diverged.
  void check_motion(Real time) const;

  /// Writes fragments.csv.
  void write_fragments();

  /// Writes half_casts.csv.
  void write_half_casts();

  /// Writes gauge_peaks.csv.
  void write_gauge_peaks() const { gauges_.write_peaks(folder_->gauge_peaks()); }

  /// Headline figures by name: an interface, see the reference of the run folder.
  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds);
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const { return gauges_.peaks(); }

  std::uint64_t state_hash() const;
  /// At the last row [J].
  Real energy_residual() const { return energy_residual_; }

  /// Smallest step of the last history interval [s].
  Real latest_smallest_step() const { return latest_smallest_step_; }

  void columns(Archive& archive);

private:
  std::vector<RecordFiles::Table> tables() const;
  const FragmentMap& fragments();
  std::vector<Fragment> measured_fragments(const levels::Snapshot<3>& now);
  std::vector<HalfCast> half_casts(std::span<const Fragment> pieces);
  void add_history_row(Real time, Real wall_seconds);
  std::vector<Vector3> boundary_forces(Real time) const;
  std::vector<methods::blocks::ChargeState> charge_states(Real time) const;
  void sum_absorbed(Real time, const parallel::Ranks* ranks);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  BlocksModel* model_;
  RunClocks clocks_;
  Gauges gauges_;
  Snapshots snapshots_;
  RecordFiles files_;
  std::optional<levels::Survey<3>> survey_;  ///< of the row that comes
  levels::Survey<3> former_survey_;          ///< its memory is used again
  std::vector<ExactSum> absorbed_;           ///< by boundary, at the row that comes [J]
  FragmentMap fragments_;
  Index fragments_at_broken_ = -1;  ///< number of broken joints for which `fragments_` holds
  Real smallest_step_ = 0;          ///< of the run so far; 0 before the first row [s]
  Real latest_smallest_step_ = 0;
  Real peak_speed_ = 0;
  Real peak_strain_ = 0;      ///< of deformable elements
  Real energy_residual_ = 0;  ///< at the last row [J]
  std::int64_t snapshot_count_ = 0;
};

}  // namespace sazare::runs
