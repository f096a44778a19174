#include "sazare/runs/studies/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/parallel/tasks.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/studies/safety_factors.hpp"
#include "sazare/runs/studies/step_limits.hpp"

namespace sazare::runs {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr auto line_interval = std::chrono::seconds(2);

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// What the rows of a study belong to: the texts of its files and the program.
std::string identity_of(const cases::Study& study) {
  observe::Hash hash;
  const auto add = [&](const std::string& text) { hash.add(std::as_bytes(std::span(text.data(), text.size()))); };
  add(text_of(study.path));
  for (const cases::StudyFamily& family : study.families) add(text_of(family.file));
  add(std::string(version) + std::string(commit));
  return observe::to_hex(hash.value()) + "\n";
}

std::unique_ptr<StudySearch> search_of(const cases::Study& study, const StudyOptions& options) {
  if (study.find == cases::Sought::factor_of_safety) return safety_factors(study, options);
  return step_limits(study, options.folder);
}

std::vector<std::string> columns_of(const cases::Study& study, const StudySearch& search) {
  std::vector<std::string> columns = {"case [-]", "family [-]"};
  for (const auto& parameter : study.parameters) columns.push_back(fmt::format("{} [{}]", parameter.name, parameter.unit));
  for (const std::string& found : search.columns()) columns.push_back(found);
  columns.emplace_back("seconds [s]");
  return columns;
}

/// Columns are found by their names.
void check_columns(const cases::Study& study, const std::vector<std::string>& columns) {
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const std::string start = study.parameters[i].name + " [";
    if (std::ranges::count_if(columns, [&](const std::string& column) { return column.starts_with(start); }) > 1)
      cases::refuse(study, fmt::format("parameters.{}.name", i),
                    fmt::format("study.csv has a column \"{}\" of its own", study.parameters[i].name),
                    "give the parameter another name");
  }
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

class StudyRun {
public:
  StudyRun(const cases::Study& study, const StudyOptions& options, const StudyMethods& methods)
      : study_(study),
        options_(options),
        methods_(methods),
        search_(search_of(study, options)),
        columns_(columns_of(study, *search_)),
        folder_(options.folder, options.begin),
        table_(folder_.path() / "study.csv"),
        identity_file_(folder_.path() / "study.id") {}

  StudyOutcome run() {
    check_columns(study_, columns_);
    if (options_.begin == Begin::resume) take_rows();
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < study_.size(); ++i)
      if (!rows_.contains(i)) open.push_back(i);
    check_cases(open);
    folder_.clear();
    observe::write_file(identity_file_, identity_of(study_));
    write_manifest("running");
    already_ = rows_.size();
    try {
      parallel::run_tasks(open.size(), options_.threads, [&](std::size_t i) { solve(open[i]); });
    } catch (...) {  // what is found stays, and the manifest counts it
      write_manifest("stopped");
      throw;
    }
    const bool done = rows_.size() == study_.size();
    write_table();
    if (done) search_->write_tables(rows());
    write_manifest(done ? "done" : "stopped");
    return {rows_.size(), study_.size(), seconds_since_start(), done ? search_->summary(rows()) : ""};
  }

private:
  Real seconds_since_start() const { return std::chrono::duration<Real>(Clock::now() - start_).count(); }

  [[noreturn]] void refuse_table() const {
    throw UserError(fmt::format("{}: a row is damaged. Start again with --overwrite", table_.string()));
  }

  template <class Number>
  Number number_in(const std::string& text) const {
    Number number{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size()) refuse_table();
    return number;
  }

  /// Rows of an earlier part of the study.
  void take_rows() {
    std::ifstream stream(table_);
    if (!stream) return;
    if (text_of(identity_file_) != identity_of(study_))
      throw UserError(
          fmt::format("{}: cannot be resumed: the study, its cases or the program have changed. Start again with --overwrite",
                      folder_.path().string()));
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) take_row(split(line));
  }

  void take_row(const std::vector<std::string>& fields) {
    if (fields.size() != columns_.size()) refuse_table();
    const auto number = number_in<std::int64_t>(fields[0]);
    if (number < 0 || static_cast<std::size_t>(number) >= study_.size()) refuse_table();
    std::vector<Real> numbers;
    for (std::size_t i = 2; i < fields.size(); ++i) numbers.push_back(number_in<Real>(fields[i]));
    const auto values = static_cast<std::ptrdiff_t>(study_.parameters.size());
    rows_[static_cast<std::size_t>(number)] = {static_cast<std::size_t>(number),
                                               fields[1],
                                               {numbers.begin(), numbers.begin() + values},
                                               {numbers.begin() + values, numbers.end() - 1},
                                               numbers.back()};
  }

  const Method& method_of(std::size_t number, const cases::CaseFile& file) const {
    const auto& all = methods_.methods;
    const auto found = std::ranges::find(all, file.method, [](const Method& one) { return one.format.method; });
    if (search_->is_for(*found)) return *found;
    std::string able;
    for (const Method& other : all)
      if (search_->is_for(other)) able += fmt::format("{}{}", able.empty() ? "" : ", ", other.format.method);
    const std::size_t family = number / (study_.size() / study_.families.size());
    cases::refuse(study_, fmt::format("families.{}.case", family),
                  fmt::format("{} cannot be sought in cases of method {}", search_->sought(), file.method),
                  fmt::format("it can in those of: {}", able));
  }

  cases::CaseFile read(std::size_t number) const {
    const std::vector<std::string> settings = study_.overrides(number);
    try {
      return methods_.read(study_.family(number).file, settings);
    } catch (const UserError& refused) {
      if (settings.empty()) throw;
      throw UserError(fmt::format("{}\n  found in case {} of {}, whose [[parameters]] are set as by --set", refused.what(),
                                  number, study_.path.string()));
    }
  }

  /// All errors of all cases before anything is run.
  void check_cases(const std::vector<std::size_t>& open) const {
    for (const std::size_t number : open) {
      const cases::CaseFile file = read(number);
      search_->check(method_of(number, file), file);
    }
  }

  void solve(std::size_t number) {
    if (options_.stop.is_made()) return;
    const auto began = Clock::now();
    const cases::CaseFile file = read(number);
    std::vector<Real> found = search_->find(method_of(number, file), file, number);
    if (found.empty()) return;
    const std::lock_guard lock(mutex_);
    rows_[number] = {number, study_.family(number).name, study_.values(number), std::move(found),
                     std::chrono::duration<Real>(Clock::now() - began).count()};
    write_table();
    show();
  }

  std::vector<StudyRow> rows() const {
    std::vector<StudyRow> rows;
    for (const auto& [number, row] : rows_) rows.push_back(row);
    return rows;
  }

  void write_table() const {
    std::vector<std::vector<observe::CsvField>> table;
    for (const auto& [number, row] : rows_) {
      auto& fields = table.emplace_back();
      fields = {static_cast<std::int64_t>(number), row.family};
      fields.insert(fields.end(), row.values.begin(), row.values.end());
      fields.insert(fields.end(), row.found.begin(), row.found.end());
      fields.emplace_back(row.seconds);
    }
    observe::write_csv(table_, columns_, table);
  }

  void show() {
    if (options_.quiet || (Clock::now() < next_line_ && rows_.size() < study_.size())) return;
    next_line_ = Clock::now() + line_interval;
    const Real done = static_cast<Real>(rows_.size() - already_), left = static_cast<Real>(study_.size() - rows_.size());
    fmt::print("{:4} of {} cases  {:.2f} cases/s  {} left\n", rows_.size(), study_.size(), done / seconds_since_start(),
               duration_text(left * seconds_since_start() / done));
    std::fflush(stdout);
  }

  void write_manifest(const std::string& status) const {
    observe::Manifest manifest = observe::new_manifest();
    manifest.case_title = study_.title;
    manifest.method = "study";
    manifest.status = status;
    manifest.started = started_;
    manifest.finished = status == "running" ? "" : observe::time_of_day();
    manifest.machine.threads = options_.threads;
    manifest.results = {{"cases", static_cast<std::int64_t>(study_.size())},
                        {"cases_done", static_cast<std::int64_t>(rows_.size())}};
    for (const auto& figure : search_->figures(rows())) manifest.results.push_back(figure);
    manifest.results.emplace_back("wall_seconds", seconds_since_start());
    observe::write_manifest(folder_.manifest(), manifest);
  }

  const cases::Study& study_;
  const StudyOptions& options_;
  const StudyMethods& methods_;
  std::unique_ptr<StudySearch> search_;
  std::vector<std::string> columns_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_line_ = start_;
  std::string started_ = observe::time_of_day();
  RunFolder folder_;
  fs::path table_, identity_file_;
  std::map<std::size_t, StudyRow> rows_;
  std::size_t already_ = 0;
  std::mutex mutex_;
};

}  // namespace

StudyOutcome run_study(const cases::Study& study, const StudyOptions& options, const StudyMethods& methods) {
  return StudyRun(study, options, methods).run();
}

}  // namespace sazare::runs
