#pragma once

/// What a study seeks in each of its cases.

#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/method.hpp"

namespace sazare::runs {

/// What was found in a case of a study.
struct StudyRow {
  std::size_t number = 0;  ///< of the case
  std::string family;
  std::vector<Real> values;  ///< of the parameters
  std::vector<Real> found;   ///< by the columns of the search
  Real seconds = 0;          ///< that it took [s]
};

class StudySearch {
public:
  StudySearch() = default;
  StudySearch(const StudySearch&) = delete;
  StudySearch& operator=(const StudySearch&) = delete;
  virtual ~StudySearch() = default;

  /// "a stability limit"
  virtual std::string sought() const = 0;
  /// Whether it can be sought in cases of a method.
  virtual bool is_for(const Method& method) const = 0;
  /// Titles of what is found, with their units.
  virtual std::vector<std::string> columns() const = 0;
  /// Throws UserError where a case has not what it takes.
  virtual void check(const Method&, const cases::CaseFile&) const {}
  /// By column; nothing where it was asked to stop. Called by several threads.
  virtual std::vector<Real> find(const Method& method, const cases::CaseFile& file, std::size_t number) const = 0;
  /// Writes tables that follow from all rows of a complete study.
  virtual void write_tables(std::span<const StudyRow>) const {}
  virtual std::vector<std::pair<std::string, observe::Figure>> figures(std::span<const StudyRow> rows) const = 0;
  /// Lines about a complete study.
  virtual std::string summary(std::span<const StudyRow> rows) const = 0;
};

}  // namespace sazare::runs
