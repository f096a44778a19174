#include "sazare/runs/record_files.hpp"

#include <fmt/format.h>

#include <set>

#include "sazare/core/error.hpp"

namespace sazare::runs {

namespace {

/// Names of a case head columns; whoever reads a table by them must find one each.
void check_titles(const RecordFiles::Table& table) {
  std::set<std::string> seen;
  for (const std::string& title : table.titles)
    if (!seen.insert(title).second)
      throw UserError(fmt::format("{}: two columns would be called \"{}\": give what they are of different names in the case",
                                  table.file.string(), title));
}

}  // namespace

void RecordFiles::begin(const std::vector<Table>& tables) {
  for (const Table& table : tables) check_titles(table);
  for (const Table& table : tables) tables_.emplace_back(table.file, table.titles);
}

void RecordFiles::resume(const std::vector<Table>& tables) {
  for (const Table& table : tables)
    tables_.push_back(observe::CsvWriter::resume(table.file, table.titles, static_cast<std::size_t>(kept_rows_)));
  if (snapshots_) snapshots_->resume(static_cast<std::size_t>(kept_snapshots_));
}

void RecordFiles::add_row(std::size_t table, std::span<const Real> values) {
  tables_[table].add_row(values);
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
