#include "sazare/runs/record_files.hpp"

namespace sazare::runs {

void RecordFiles::begin(const std::vector<Table>& tables) {
  for (const Table& table : tables) tables_.emplace_back(table.file, table.titles);
}

void RecordFiles::resume(const std::vector<Table>& tables) {
  for (const Table& table : tables)
    tables_.push_back(observe::CsvWriter::resume(table.file, table.titles, static_cast<std::size_t>(kept_rows_)));
  if (snapshots_) snapshots_->resume(static_cast<std::size_t>(kept_snapshots_));
}

void RecordFiles::flush(bool to_disk) {
  for (observe::CsvWriter& table : tables_) table.flush(to_disk);
  if (to_disk && snapshots_) snapshots_->sync();
}

void RecordFiles::columns(Archive& archive) {
  auto rows = static_cast<std::int64_t>(this->rows());
  auto snapshots = static_cast<std::int64_t>(snapshots_ ? snapshots_->size() : 0);
  archive("rows", rows);
  if (snapshots_) archive("snapshots", snapshots);
  if (!archive.reading()) return;
  kept_rows_ = rows;
  kept_snapshots_ = snapshots;
}

}  // namespace sazare::runs
