#pragma once

/// A method's part of a run: what the course of a run (case_run.hpp) asks of it.

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/core/archive.hpp"
#include "sazare/coupling/file_exchange.hpp"
#include "sazare/runs/live_run.hpp"
#include "sazare/runs/run_identity.hpp"
#include "sazare/runs/run_times.hpp"

namespace sazare::runs {

/// What most methods do without. A method overrides what it has, so that a misspelt name does not compile.
struct WorkDefaults {
  virtual ~WorkDefaults() = default;

  /// What is to be warned of at the beginning; empty where all is well.
  virtual std::string warning() const { return ""; }
  /// Whether the motion is to be looked at after this step.
  virtual bool must_check() const { return true; }
  /// Makes all true in the first of several processes.
  virtual void collect() {}
  /// What several processes do together before the first one writes a row.
  virtual void survey() {}
  /// Forces from outside [N], a row per body; only where takes_forces(). A method takes moments too, or forces alone.
  virtual bool takes_forces() const { return false; }
  virtual bool takes_moments() const { return false; }
  /// Whether a run that began without forces cannot be resumed with them.
  virtual bool takes_forces_from_the_start() const { return false; }
  virtual void apply(std::span<const Vector3>) {}
  virtual void apply_with_moments(std::span<const Vector3>, std::span<const Vector3>) {}
  /// Parts of a step and what they took, for timing.csv.
  virtual std::vector<levels::PartTime> part_times() const { return {}; }
  /// Files that only the method knows, when the run is done.
  virtual void write_end() {}
  virtual void write_rank_times() {}

  /// The following four concern a run that has a partner in another program, whose coupling::Stopped ends a walk: a checkpoint
  /// is on the disk; why the run ends, or that it is done; figures for the manifest beside those of its record.
  virtual bool has_partner() const { return false; }
  virtual void checkpoint_made() {}
  virtual void part(coupling::Farewell, const std::string&) {}
  virtual std::vector<std::pair<std::string, observe::Figure>> more_figures() const { return {}; }
};

/// Where a step may take long, it asks this on the way whether to end early.
using Pause = std::function<bool()>;

/// What every method has, made from a case and its options.
template <class Work>
concept CaseWork = std::derived_from<Work, WorkDefaults> &&
                   std::constructible_from<Work, const cases::CaseFile&, const RunOptions&> &&
                   requires(Work& work, const Work& same, const Pause& pause, Archive& archive, MotionTable& table) {
                     { work.times } -> std::convertible_to<const RunTimes&>;
                     { work.folder } -> std::convertible_to<const RunFolder&>;
                     { work.identity } -> std::convertible_to<const RunIdentity&>;
                     { work.clocks } -> std::convertible_to<const RunClocks&>;
                     work.record;  // RecordOfRun, in the words of the methods
                     { same.title() } -> std::convertible_to<std::string>;
                     { same.method() } -> std::convertible_to<std::string>;
                     { same.words() } -> std::convertible_to<std::string>;          // at the beginning
                     { same.checkpoint_interval() } -> std::convertible_to<Real>;   // [s] of wall clock
                     { work.start() } -> std::same_as<bool>;  // false when asked to stop before it was there
                     { work.advance(pause) } -> std::same_as<bool>;                 // a step; false where `pause` ended it early
                     { same.step() } -> std::convertible_to<std::int64_t>;          // how many there have been
                     { same.progress(Real{}, Real{}) } -> std::same_as<ProgressState>;  // share done, time
                     work.columns(archive);                                         // its state in a checkpoint
                     work.read_motion(table);                                       // where its bodies are
                     { same.state_hash() } -> std::same_as<std::uint64_t>;
                     work.write_case();
                   };

}  // namespace sazare::runs
