#pragma once

/// The course of a run, whatever its method: begin or resume, step, observe, checkpoint, end.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/coupling/file_exchange.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/runs/case_work.hpp"
#include "sazare/runs/checkpoint_archive.hpp"
#include "sazare/runs/live_run.hpp"
#include "sazare/runs/run_identity.hpp"
#include "sazare/runs/run_times.hpp"

namespace sazare::runs {

/// Whether this process writes the output: with several, only the first one does.
inline bool is_writer(const RunOptions& options) { return options.sharing.ranks == nullptr || options.sharing.ranks->is_first(); }

/// `Work` is the part of a method in it, see case_work.hpp.
template <CaseWork Work>
class CaseRun final : public LiveRun {
public:
  /// The case must outlive the run.
  CaseRun(const cases::CaseFile& file, const RunOptions& options) : options_(options), work_(file, options_) {
    manifest_.case_title = work_.title();
    manifest_.method = work_.method();
    if (options.sharing.ranks != nullptr) manifest_.machine.ranks = options.sharing.ranks->size();
    if (options.warns && is_writer(options)) fmt::print(stderr, "{}", work_.warning());
    work_.times.add(RunTimes::Part::setup, work_.times.now());
  }

  RunOutcome run() override {
    return guarded([this] {
      if (!start()) return stopped_before_the_beginning();
      Progress progress(options_.quiet, this->progress());
      walk_to(work_.clocks.steps(), [&] {
        if (progress.is_due()) progress.show(this->progress());
        return must_stop();
      });
      progress.clear();
      return end();
    });
  }

  void begin() override {
    guarded([this] { start(); });
  }
  bool walk(std::int64_t until, const std::function<bool()>& pause) override {
    return guarded([&] { return walk_to(std::min(until, work_.clocks.steps()), pause); });
  }
  RunOutcome finish() override {
    return guarded([this] { return end(); });
  }

  const std::string& title() const override { return work_.title(); }
  std::string words() const override { return work_.words(); }
  const RunClocks& clocks() const override { return work_.clocks; }
  std::int64_t step() const override { return work_.step(); }
  ProgressState progress() const override {
    return work_.progress(static_cast<Real>(work_.step()) / static_cast<Real>(work_.clocks.steps()), time());
  }
  void read_motion(MotionTable& table) override { work_.read_motion(table); }
  void require_forces() const override {
    if (options_.sharing.ranks != nullptr && options_.sharing.ranks->size() > 1)
      throw UserError("external forces act in a run of one process");
    if (!work_.takes_forces()) throw UserError(fmt::format("method {} accepts no external forces", work_.method()));
  }
  void apply(std::span<const Vector3> forces, std::span<const Vector3> moments) override {
    require_forces();
    if (!moments.empty() && !work_.takes_moments())
      throw UserError(fmt::format("method {} accepts external forces without moments: give three columns", work_.method()));
    if (moments.empty())
      work_.apply(forces);
    else
      work_.apply_with_moments(forces, moments);
    is_pushed_ = true;
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto flush_interval = std::chrono::seconds(2);

  bool writes() const { return is_writer(options_); }
  bool must_stop() const { return options_.stop.is_made(); }
  bool agree(bool by_first) const {
    return options_.sharing.ranks == nullptr ? by_first : options_.sharing.ranks->from_first(by_first) != 0;
  }

  /// Carries out a part of the run; an error leaves behind what can be kept, and says from where it can go on.
  template <class Part>
  auto guarded(const Part& part) -> decltype(part()) {
    try {
      return part();
    } catch (const PhysicsError& error) {
      say_farewell(coupling::Farewell::failed, error.what());
      leave_behind("failed");
      throw PhysicsError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    } catch (const MachineError& error) {
      say_farewell(coupling::Farewell::failed, error.what());
      leave_behind("stopped");
      throw MachineError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    } catch (const UserError& error) {
      say_farewell(coupling::Farewell::failed, error.what());
      throw;
    }
  }

  void say_farewell(coupling::Farewell farewell, const std::string& words = "") { work_.part(farewell, words); }

  void say(const std::string& line) const {
    if (options_.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  /// False when asked to stop before the beginning was there.
  bool start() {
    try {
      if (work_.folder.resumes())
        resume();
      else if (!begin_anew())
        return false;
    } catch (const coupling::Stopped&) {
      return false;
    }
    next_checkpoint_ = Clock::now() + checkpoint_interval();
    next_flush_ = Clock::now() + flush_interval;
    return true;
  }

  bool begin_anew() {
    if (options_.begin == Begin::resume)
      say(fmt::format("{}: no checkpoint to resume from, so the run starts from the beginning", work_.folder.path().string()));
    if (writes()) work_.folder.clear();
    write_manifest("running");
    if (writes()) work_.write_case();
    say(fmt::format("{}: {}", work_.title(), work_.words()));
    if (writes()) work_.record.begin();
    if (!work_.start()) return false;
    save_state(sync_of_start());
    observe();
    return true;
  }

  /// Who loses power so early has lost nothing but a beginning; where a partner goes by that checkpoint, it must be on the disk.
  observe::Sync sync_of_start() const { return work_.has_partner() ? observe::Sync::disk : observe::Sync::system; }

  RunOutcome stopped_before_the_beginning() {
    say_farewell(coupling::Farewell::stopped);
    leave_behind("stopped");
    return {true, work_.folder.resumes(), time(), manifest_};
  }

  void resume() {
    const observe::CheckpointReader in(work_.folder.checkpoint());
    check_identity(in, work_.folder.path(), work_.identity);
    CheckpointLoader loader(in);
    columns(loader);
    if (writes()) work_.record.resume();
    checkpoint_step_ = work_.step();
    write_manifest("running");
    observe();
    say(fmt::format("{}: resumed at t = {} s of {} s", work_.title(), cases::short_number(time()),
                    cases::short_number(work_.clocks.end)));
  }

  bool walk_to(std::int64_t until, const std::function<bool()>& pause) {
    while (work_.step() < until) {
      if (agree(pause()) || !advance(pause)) return true;
      if (work_.must_check() || work_.clocks.is_row(work_.step())) work_.record.check_motion(time());
      observe();
      keep();
    }
    return false;
  }

  /// False when a partner has stopped, or this side while it waited for it, or where it paused on the way.
  bool advance(const std::function<bool()>& pause) {
    try {
      return work_.advance(pause);
    } catch (const coupling::Stopped&) {
      return false;
    }
  }

  /// Hands what was written to the system and makes checkpoints, now and then.
  void keep() {
    const auto now = Clock::now();
    if (writes() && now >= next_flush_) {
      work_.record.flush(false);
      next_flush_ = now + flush_interval;
    }
    if (!agree(now >= next_checkpoint_ && !is_over())) return;
    save_checkpoint();
    next_checkpoint_ = Clock::now() + checkpoint_interval();
  }

  Clock::duration checkpoint_interval() const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<Real>(std::min(work_.checkpoint_interval(), Real{1e8})));
  }

  void observe() {
    if (!work_.clocks.is_row(work_.step()) || observed_step_ == work_.step()) return;
    observed_step_ = work_.step();
    const Real before = work_.times.now();
    work_.survey();
    if (!writes()) return;
    work_.record.observe(work_.step(), before);
    work_.times.add(RunTimes::Part::output, work_.times.now() - before);
  }

  RunOutcome end() {
    const bool done = is_over();
    if (done)
      work_.collect();
    else
      save_checkpoint();  // which has collected
    if (writes()) write_the_end(done);
    say_farewell(done ? coupling::Farewell::done : coupling::Farewell::stopped);
    return {!done, true, time(), manifest_};
  }

  void write_the_end(bool done) {
    if (done) {
      const Real before = work_.times.now();
      work_.record.flush(true);
      work_.write_end();
      work_.times.add(RunTimes::Part::output, work_.times.now() - before);
    }
    work_.times.write(work_.folder.timing(), work_.part_times());
    work_.write_rank_times();
    write_manifest(done ? "done" : "stopped");
    if (done) work_.folder.remove_checkpoint();
  }

  void save_checkpoint() {
    save_state(observe::Sync::disk);
    write_manifest("running");
  }

  /// Never of a state that is no number: the last good checkpoint stays.
  void save_state(observe::Sync sync) {
    work_.record.check_motion(time());
    const Real before = work_.times.now();
    work_.collect();
    if (!writes()) return;
    work_.record.flush(sync == observe::Sync::disk);
    observe::CheckpointWriter out(work_.folder.checkpoint());
    write_identity(out, work_.identity);
    CheckpointSaver saver(out);
    columns(saver);
    out.commit(sync);
    work_.checkpoint_made();
    checkpoint_step_ = work_.step();
    work_.times.add(RunTimes::Part::checkpoints, work_.times.now() - before);
  }

  /// A resumed run needs forces where it had some.
  void check_forces(Archive& archive) const {
    std::int64_t was_pushed = is_pushed_ ? 1 : 0;
    archive("was_pushed", was_pushed);
    if (was_pushed != 0 && !is_pushed_)
      throw UserError(
          fmt::format("{}: external forces acted on this run, and none are given now\n  resume it from Python with the same "
                      "forces=..., or start it again",
                      work_.folder.path().string()));
    if (was_pushed == 0 && is_pushed_ && work_.takes_forces_from_the_start())
      throw UserError(
          fmt::format("{}: the run began without external forces, and cannot take them later\n  resume it without "
                      "forces=..., or start it again with them",
                      work_.folder.path().string()));
  }

  void columns(Archive& archive) {
    check_forces(archive);
    archive.folder("times", [&] { work_.times.columns(archive, work_.part_times()); });
    archive.folder("record", [&] { work_.record.columns(archive); });
    work_.columns(archive);
    archive("observed_step", observed_step_);
    std::vector<char> started(manifest_.started.begin(), manifest_.started.end());
    archive("started", started);
    manifest_.started.assign(started.begin(), started.end());
  }

  void write_manifest(const std::string& status) {
    if (!writes()) return;
    manifest_.status = status;
    manifest_.finished = status == "running" ? "" : observe::time_of_day();
    manifest_.results = work_.record.results(work_.step(), work_.times.now());
    for (auto& figure : work_.more_figures()) manifest_.results.push_back(std::move(figure));
    manifest_.peak_particle_velocity = work_.record.peak_particle_velocity();
    manifest_.state_hash = work_.state_hash();
    observe::write_manifest(work_.folder.manifest(), manifest_);
  }

  /// As much as can still be written after an error.
  void leave_behind(const std::string& status) {
    try {
      if (writes()) work_.record.flush(false);
    } catch (const MachineError&) {  // the error that led here is the one to report
    }
    try {
      write_manifest(status);
    } catch (const MachineError&) {
    }
  }

  std::string where_it_can_go_on() const {
    if (checkpoint_step_ < 0) return "the run cannot be resumed: it has no checkpoint yet";
    std::error_code unknown;
    if (!std::filesystem::exists(work_.folder.checkpoint(), unknown))
      return fmt::format("the run cannot be resumed: {} is not there any more", work_.folder.checkpoint().string());
    return fmt::format("the checkpoint of t = {} s is kept in {}", cases::short_number(work_.clocks.time(checkpoint_step_)),
                       work_.folder.checkpoint().string());
  }

  RunOptions options_;
  Work work_;
  observe::Manifest manifest_ = observe::new_manifest();
  Clock::time_point next_checkpoint_, next_flush_;
  std::int64_t checkpoint_step_ = -1;
  std::int64_t observed_step_ = -1;  ///< of the latest row
  bool is_pushed_ = false;           ///< by forces from outside
};

}  // namespace sazare::runs
