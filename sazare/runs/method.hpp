#pragma once

/// What the rest of the program knows of a method: one row of the table of methods (registry/methods.cpp).

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/cases/case_format.hpp"
#include "sazare/observe/column.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/live_run.hpp"
#include "sazare/runs/stability_limit.hpp"

namespace sazare::runs {

class StrengthReduction;

/// Part of a table of the reference: what it belongs to, and its rows.
struct ColumnGroup {
  std::string_view of;
  std::vector<std::span<const observe::Column>> columns;
};

/// What the runs of a method write, for the reference of a run's folder.
struct FolderTables {
  std::vector<ColumnGroup> figures;    ///< of the manifest
  std::vector<ColumnGroup> history;    ///< of history.csv
  std::vector<ColumnGroup> gauges;     ///< of gauges.csv and files beside it
  std::vector<ColumnGroup> files;      ///< of other tables
  std::vector<ColumnGroup> snapshots;  ///< fields
};

struct Method {
  cases::CaseFormat format;
  /// A case in its folder, ready to begin or to be resumed.
  std::unique_ptr<LiveRun> (*open)(const cases::CaseFile& file, const RunOptions& options);
  /// What a case will do, in words.
  std::string (*check)(const cases::CaseFile& file);
  /// The headline figures of a finished run, as lines of text.
  std::string (*summary)(const observe::Manifest& manifest);
  FolderTables (*tables)();
  /// How so many processes would share a case, in words; none where a run is one process.
  std::string (*explain_ranks)(const cases::CaseFile& file, int ranks) = nullptr;
  /// The limit step of a case by trial; none where a study does not seek it.
  FoundLimit (*find_limit)(const cases::CaseFile& file, const LimitRules& rules) = nullptr;
  /// The ground of a case with a strength that can be divided by a factor; none where the method knows no such ground. Refuses a
  /// case without gravity or strength, at the place of what is missing. The case must outlive it.
  std::unique_ptr<StrengthReduction> (*reduce_strength)(const cases::CaseFile& file) = nullptr;
};

}  // namespace sazare::runs
