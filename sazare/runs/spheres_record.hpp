#pragma once

/// What a run of method spheres writes down: histories, groups, walls, snapshots, headline figures. It never changes the run.

#include <optional>

#include "sazare/observe/csv_writer.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/observe/vtkhdf.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"
#include "sazare/runs/spheres_model.hpp"

namespace sazare::runs {

class SpheresRecord {
public:
  /// Writes nothing yet.
  SpheresRecord(const RunFolder& folder, const cases::CaseFile& file, SpheresModel& model, const RunClocks& clocks);

  void begin();
  void resume();
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk);
  /// Writes the pieces of bonded bodies; nothing where there are none.
  void write_fragments() const;

  /// Throws PhysicsError when a velocity is no number or makes no sense any more.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;

  void columns(Archive& archive);

private:
  std::vector<std::string> gauge_columns() const;
  std::vector<std::string> wall_columns() const;
  void add_gauge_row(Real time);
  void add_wall_row(Real time);
  std::vector<Real> broken_share() const;
  void write_snapshot(Real time);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  SpheresModel* model_;
  RunClocks clocks_;
  std::vector<Index> gauge_group_;
  observe::SnapshotSeries snapshots_;
  std::optional<observe::CsvWriter> history_, gauges_, walls_;
  std::vector<Real> peaks_;          ///< largest speed by gauge [m/s]
  engine::SphereEnergies energies_;  ///< at the last row
  Real first_sum_ = 0, largest_speed_ = 0, peak_kinetic_ = 0;
  std::int64_t rows_ = 0, snapshot_count_ = 0;
};

}  // namespace sazare::runs
