#pragma once

/// What a run of method spheres writes down: histories, groups, walls, snapshots, headline figures. It never changes the run.

#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/record_files.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

class SpheresRecord {
public:
  /// Writes nothing yet. Of several processes one warns.
  SpheresRecord(const RunFolder& folder, const cases::CaseFile& file, SpheresModel& model, const RunClocks& clocks,
                bool warns = true);

  void begin() { files_.begin(tables()); }
  void resume();
  /// Whether the row of a step, or its snapshot, looks at single spheres.
  bool needs_motion(std::int64_t step) const { return !gauge_group_.empty() || clocks_.is_snapshot(step); }
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk);
  /// Writes the pieces of bonded bodies; nothing where there are none.
  void write_fragments() const;

  /// Throws PhysicsError when a velocity is not a number or the motion has diverged, or a sphere went through a wall.
  void check_motion(Real time) const;
  /// Warns where the step is too long for the contacts that spheres have; throws where the case asks for it.
  void check_step(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;
  /// At the last row [J].
  Real energy_residual() const { return files_.rows() > 0 ? energies_.sum() - first_sum_ : 0; }

  void columns(Archive& archive);

private:
  std::vector<RecordFiles::Table> tables() const;  ///< history, gauges, walls
  void check_surfaces() const;
  void add_gauge_row(Real time);
  void add_wall_row(Real time);
  std::vector<Real> broken_fraction() const;
  void write_snapshot(Real time);
  void write_surfaces(Real time);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  SpheresModel* model_;
  RunClocks clocks_;
  std::vector<Index> gauge_group_;
  RecordFiles files_;
  observe::SnapshotSeries surface_files_;  ///< of walls of triangles
  std::size_t kept_surfaces_ = 0;          ///< snapshots of them, of the checkpoint that was read
  std::vector<Real> peaks_;          ///< largest speed by gauge [m/s]
  methods::spheres::SphereEnergies energies_;  ///< at the last row
  Real first_sum_ = 0, largest_speed_ = 0, peak_kinetic_ = 0;
  bool warns_;
  mutable Real warned_load_ = 1;  ///< of the step: a larger one is told of
};

}  // namespace sazare::runs
