#pragma once

/// The tables and the snapshots that grow with a run: they begin together, reach the disk together, and a run that is resumed
/// goes on with what its checkpoint counts on.

#include <optional>

#include "sazare/observe/csv_writer.hpp"
#include "sazare/observe/vtkhdf.hpp"
#include "sazare/runs/checkpoint_archive.hpp"

namespace sazare::runs {

class RecordFiles {
public:
  struct Table {
    std::filesystem::path file;
    std::vector<std::string> titles;
  };

  /// Tables only.
  RecordFiles() = default;
  /// Nothing is written yet; `series` is the name of the snapshots in their folder.
  RecordFiles(std::filesystem::path snapshots, std::string series)
      : snapshots_(std::in_place, std::move(snapshots), std::move(series)) {}

  /// Makes the tables. Throws MachineError when one cannot be written.
  void begin(const std::vector<Table>& tables);

  /// Goes on with those of an earlier run, with as many rows and snapshots as its checkpoint says. Throws UserError when they are
  /// not there.
  void resume(const std::vector<Table>& tables);

  /// Adds a row to a table, numbered as they were given; all tables have as many rows. The first value is the time [s]. Throws
  /// PhysicsError where one is no finite number: then the run means nothing, though its motion may still be one.
  void add_row(std::size_t table, std::span<const Real> values);
  void add_snapshot(const observe::Grid& grid) { snapshots_->write(grid); }

  std::size_t rows() const { return tables_.empty() ? 0 : tables_.front().rows(); }
  void flush(bool to_disk);

  /// How many rows and snapshots a checkpoint counts on.
  void columns(Archive& archive);

private:
  std::vector<observe::CsvWriter> tables_;
  std::optional<observe::SnapshotSeries> snapshots_;
  std::int64_t kept_rows_ = 0, kept_snapshots_ = 0;  ///< of the checkpoint that was read
};

}  // namespace sazare::runs
