#include "sazare/runs/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
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
#include "sazare/runs/limit_regression.hpp"
#include "sazare/runs/progress.hpp"

namespace sazare::runs {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Row = std::vector<observe::CsvField>;
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

std::vector<std::string> columns_of(const cases::Study& study) {
  std::vector<std::string> columns = {"case [-]", "family [-]"};
  for (const auto& parameter : study.parameters) columns.push_back(fmt::format("{} [{}]", parameter.name, parameter.unit));
  for (const char* rest :
       {"particles [-]", "predicted [s]", "stable [s]", "unstable [s]", "limit [s]", "trials [-]", "seconds [s]"})
    columns.emplace_back(rest);
  return columns;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

class StudyRun {
public:
  StudyRun(const cases::Study& study, const StudyOptions& options, const LimitSeeker& seeker)
      : study_(study),
        options_(options),
        seeker_(seeker),
        folder_(options.folder, options.begin),
        table_(folder_.path() / "study.csv"),
        identity_file_(folder_.path() / "study.id") {}

  StudyOutcome run() {
    if (options_.begin == Begin::resume) take_rows();
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < study_.size(); ++i)
      if (!rows_.contains(i)) open.push_back(i);
    check_cases(open);
    folder_.clear();
    observe::write_file(identity_file_, identity_of(study_));
    write_manifest("running");
    already_ = rows_.size();
    parallel::run_tasks(open.size(), options_.threads, [&](std::size_t i) { solve(open[i]); });
    StudyOutcome outcome{rows_.size(), study_.size(), largest_difference(), seconds_since_start()};
    const bool done = outcome.done == outcome.cases;
    write_table();
    if (done) write_regression();
    write_manifest(done ? "done" : "stopped");
    return outcome;
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
    const std::size_t count = columns_of(study_).size();
    while (std::getline(stream, line)) {
      const std::vector<std::string> fields = split(line);
      if (fields.size() != count) refuse_table();
      const auto number = number_in<std::int64_t>(fields[0]);
      Row row = {number, fields[1]};
      for (std::size_t i = 2; i < count; ++i) row.emplace_back(number_in<Real>(fields[i]));
      if (number < 0 || static_cast<std::size_t>(number) >= study_.size()) refuse_table();
      rows_[static_cast<std::size_t>(number)] = std::move(row);
    }
  }

  /// All errors of all cases before anything is run.
  void check_cases(const std::vector<std::size_t>& open) const {
    for (const std::size_t number : open) seeker_.read(study_.family(number).file, study_.overrides(number));
  }

  void solve(std::size_t number) {
    if (options_.stop_asked != nullptr && options_.stop_asked->load(std::memory_order_relaxed)) return;
    const auto began = Clock::now();
    const cases::CaseFile file = seeker_.read(study_.family(number).file, study_.overrides(number));
    const FoundLimit found = seeker_.find(file, {study_.limit.ratio, study_.limit.steps, study_.limit.divergence});
    Row row = {static_cast<std::int64_t>(number), study_.family(number).name};
    for (const Real value : study_.values(number)) row.emplace_back(value);
    row.insert(row.end(), {static_cast<Real>(found.particles), found.predicted, found.stable, found.unstable, found.limit(),
                           static_cast<Real>(found.trials), std::chrono::duration<Real>(Clock::now() - began).count()});
    const std::lock_guard lock(mutex_);
    rows_[number] = std::move(row);
    write_table();
    show();
  }

  void write_table() const {
    std::vector<Row> rows;
    for (const auto& [number, row] : rows_) rows.push_back(row);
    observe::write_csv(table_, columns_of(study_), rows);
  }

  void show() {
    if (options_.quiet || (Clock::now() < next_line_ && rows_.size() < study_.size())) return;
    next_line_ = Clock::now() + line_interval;
    const Real done = static_cast<Real>(rows_.size() - already_), left = static_cast<Real>(study_.size() - rows_.size());
    fmt::print("{:4} of {} cases  {:.2f} cases/s  {} left\n", rows_.size(), study_.size(), done / seconds_since_start(),
               duration_text(left * seconds_since_start() / done));
    std::fflush(stdout);
  }

  Real number_in(const Row& row, std::size_t column) const { return std::get<Real>(row[column]); }
  std::size_t predicted_column() const { return study_.parameters.size() + 3; }
  std::size_t limit_column() const { return study_.parameters.size() + 6; }

  Real largest_difference() const {
    Real largest = 0;
    for (const auto& [number, row] : rows_)
      if (number_in(row, predicted_column()) > 0)
        largest = std::max(largest, std::abs(std::log(number_in(row, limit_column()) / number_in(row, predicted_column()))));
    return largest;
  }

  std::size_t parameter(std::string_view name) const {
    return static_cast<std::size_t>(std::ranges::find(study_.parameters, name, &cases::StudyParameter::name) -
                                    study_.parameters.begin());
  }

  void write_regression() const {
    const std::size_t spacing = parameter("spacing"), velocity = parameter("velocity"), damping = parameter("damping");
    if (std::max({spacing, velocity, damping}) >= study_.parameters.size()) return;
    for (const std::size_t needed : {spacing, velocity})
      if (study_.parameters[needed].values.size() < 2) return;
    if (study_.parameters[damping].values.size() < 3) return;
    std::vector<Row> coefficients, lines;
    for (const cases::StudyFamily& family : study_.families) {
      std::vector<LimitPoint> points;
      for (const auto& [number, row] : rows_)
        if (std::get<std::string>(row[1]) == family.name)
          points.push_back({0.5 * number_in(row, 2 + spacing), number_in(row, 2 + velocity), number_in(row, 2 + damping),
                            number_in(row, limit_column())});
      const LimitFit fit = fit_limits(points);
      coefficients.push_back(
          {family.name, fit.b1[0], fit.b1[1], fit.b1[2], fit.b2[0], fit.b2[1], fit.b2[2], log_error(fit, points)});
      for (const DampingFit& line : fit.by_damping) lines.push_back({family.name, line.damping, line.a1, line.a2});
    }
    observe::write_csv(folder_.path() / "regression.csv",
                       {"family [-]", "b11 [-]", "b12 [-]", "b13 [-]", "b21 [-]", "b22 [-]", "b23 [-]", "log_error [-]"},
                       coefficients);
    observe::write_csv(folder_.path() / "regression_lines.csv", {"family [-]", "damping [-]", "a1 [-]", "a2 [-]"}, lines);
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
                        {"cases_done", static_cast<std::int64_t>(rows_.size())},
                        {"largest_log_difference", largest_difference()},
                        {"wall_seconds", seconds_since_start()}};
    observe::write_manifest(folder_.manifest(), manifest);
  }

  const cases::Study& study_;
  const StudyOptions& options_;
  const LimitSeeker& seeker_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_line_ = start_;
  std::string started_ = observe::time_of_day();
  RunFolder folder_;
  fs::path table_, identity_file_;
  std::map<std::size_t, Row> rows_;
  std::size_t already_ = 0;
  std::mutex mutex_;
};

}  // namespace

StudyOutcome run_study(const cases::Study& study, const StudyOptions& options, const LimitSeeker& seeker) {
  return StudyRun(study, options, seeker).run();
}

}  // namespace sazare::runs
