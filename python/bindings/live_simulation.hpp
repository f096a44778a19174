#pragma once

/// A case under way as Python holds it: the run of the engine, the case it belongs to, and the rows that numpy looks at.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::python {

/// A case as text, with the path by which messages call it and from which its files are found.
struct CaseSource {
  std::optional<std::string> text;  ///< none: the file at `path` is read
  std::filesystem::path path;
  std::vector<std::string> overrides;

  cases::CaseFile read() const;
};

/// What there is to say of a run, at any time and from any thread.
struct Status {
  std::string title, words;
  Real time = 0, end = 0;  ///< [s]
  std::int64_t step = 0, steps = 0;
};

class LiveSimulation {
public:
  /// Reads, checks and builds; makes the folder; `warns` of what is unusual, as a run does; `takes_forces` where `apply` will be
  /// called. Throws like `runs::open_case`.
  LiveSimulation(const CaseSource& source, const std::filesystem::path& folder, const std::string& begin, int threads,
                 bool warns = true, bool takes_forces = false);

  void begin();
  /// Steps until so many are done, or for some seconds of wall-clock time; the rows that Python looks at are brought up to date.
  void walk(std::int64_t until, double seconds);
  /// Ends the run where it is and lets go of its folder; the rows and the status stay.
  void finish();

  /// Hands over samples of a history that the case leaves to its caller, at equal steps [s] from its beginning; after those that
  /// were handed over before.
  void add_samples(const std::string& name, double step, const std::vector<double>& values);
  /// Forces on the bodies from now on [N], and moments about their centres [N m] or none.
  void apply(std::span<const Vector3> forces, std::span<const Vector3> moments);
  /// Throws UserError where the method takes none.
  void require_forces() const {
    if (run_ != nullptr) run_->require_forces();
  }

  const cases::CaseFile& file() const { return file_; }
  const Status& status() const { return status_; }
  /// Brings the rows up to date the first time they are asked for; from then on, `walk` does.
  const runs::MotionTable& motion();
  /// "41 %  t = ...", since the simulation began.
  std::string progress_text() const;

private:
  class Turn;

  void look();

  cases::CaseFile file_;
  std::unique_ptr<runs::LiveRun> run_;  ///< none after the end
  Status status_;
  runs::MotionTable motion_;
  bool is_watched_ = false;
  std::atomic<bool> at_work_{false};
  runs::ProgressState first_, now_;
  std::int64_t began_ = 0;  ///< [ns] of the steady clock
};

}  // namespace sazare::python
