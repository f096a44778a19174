#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sazare/cases/number_text.hpp"
#include "sazare/cases/resolved.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/runs/checkpoint_archive.hpp"
#include "sazare/runs/mps_record.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/run_case.hpp"
#include "sazare/runs/run_identity.hpp"
#include "sazare/runs/run_times.hpp"

namespace sazare::runs {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto flush_interval = std::chrono::seconds(2);
constexpr Index particles_per_thread = 4000;    // with fewer a second thread takes more time than it saves
constexpr std::int64_t motion_check_steps = 32;

std::string number(Real value, int digits = 4) { return cases::short_number(value, digits); }

observe::Manifest new_manifest(const cases::CaseFile& file) {
  observe::Manifest manifest;
  manifest.version = version;
  manifest.commit = commit;
  manifest.case_title = file.mps().title;
  manifest.method = "mps";
  manifest.status = "running";
  manifest.started = observe::time_of_day();
  manifest.machine = observe::this_machine();
  return manifest;
}

template <int D>
std::string filling_hash(const Filling<D>& filling) {
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(filling.sites)));
  hash.add(std::as_bytes(std::span(filling.region)));
  return observe::to_hex(hash.value());
}

template <int D>
class MpsRun {
 public:
  MpsRun(const cases::CaseFile& file, const RunOptions& options)
      : file_(file), options_(options), model_(build_mps<D>(file)), folder_(options.folder, options.begin),
        manifest_(new_manifest(file)), identity_(identify(file.mps(), filling_hash(model_.filling))),
        clocks_(make_clocks(file.mps().time, model_.step)), record_(folder_, file, model_, clocks_) {
    parallel::limit_threads(static_cast<int>(model_.filling.sites.size()) / particles_per_thread);
    manifest_.machine.threads = parallel::threads();
    fmt::print(stderr, "{}", model_.warning);
    times_.add(RunTimes::Part::setup, times_.now());
  }

  RunOutcome run() {
    try {
      folder_.resumes() ? resume() : begin();
      const bool stopped = walk();
      end(stopped ? "stopped" : "done");
      return {stopped, clocks_.time(step()), manifest_};
    } catch (const PhysicsError& error) {
      leave_behind("failed");
      throw PhysicsError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    } catch (const MachineError& error) {
      leave_behind("stopped");
      throw MachineError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    }
  }

 private:
  std::int64_t step() const { return model_.stepper->steps(); }

  void say(const std::string& line) const {
    if (options_.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  void begin() {
    if (options_.begin == Begin::resume)
      say(fmt::format("{}: no checkpoint to resume from, so the run begins anew", folder_.path().string()));
    write_manifest("running");
    observe::write_file(folder_.case_file(), cases::write_resolved(file_.mps(), folder_.path()));
    say(fmt::format("{}: {} particles, step {} s, {} of the predicted limit", file_.mps().title, model_.filling.sites.size(),
                    number(model_.step), number(model_.step / model_.stable_step(file_.mps().time.integrator), 3)));
    record_.begin();
    model_.stepper->start();
    observe();
    save_checkpoint();
  }

  void resume() {
    const observe::CheckpointReader in(folder_.checkpoint());
    check_identity(in, folder_.path(), identity_);
    CheckpointLoader loader(in);
    columns(loader);
    record_.resume();
    checkpoint_step_ = step();
    write_manifest("running");
    say(fmt::format("{}: resumed at t = {} s of {} s", file_.mps().title, number(clocks_.time(step())), number(clocks_.end)));
  }

  /// To the end, or until asked to stop: then true.
  bool walk() {
    Progress progress(options_.quiet, state());
    auto next_checkpoint = Clock::now() + checkpoint_interval();
    auto next_flush = Clock::now() + flush_interval;
    while (step() < clocks_.steps()) {
      if (options_.stop_asked != nullptr && options_.stop_asked->load(std::memory_order_relaxed)) return true;
      model_.stepper->advance();
      if (clocks_.is_row(step()) || step() % motion_check_steps == 0) record_.check_motion(clocks_.time(step()));
      observe();
      if (progress.is_due()) progress.show(state());
      const auto now = Clock::now();
      if (now >= next_flush) {
        record_.flush(false);
        next_flush = now + flush_interval;
      }
      if (now < next_checkpoint || step() == clocks_.steps()) continue;
      save_checkpoint();
      next_checkpoint = Clock::now() + checkpoint_interval();
    }
    return false;
  }

  Clock::duration checkpoint_interval() const {
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<Real>(std::min(file_.mps().output.checkpoint_interval, Real{1e8})));
  }

  ProgressState state() const {
    const Real share = static_cast<Real>(step()) / static_cast<Real>(clocks_.steps());
    const auto done = step() * static_cast<std::int64_t>(model_.filling.sites.size());
    return {share, clocks_.time(step()), done, model_.step, -1, "particle-steps"};
  }

  void observe() {
    if (!clocks_.is_row(step())) return;
    const Real before = times_.now();
    record_.observe(step(), before);
    times_.add(RunTimes::Part::output, times_.now() - before);
  }

  void end(const std::string& status) {
    if (status == "done") {
      record_.flush(true);
    } else {
      save_checkpoint();
    }
    times_.write(folder_.timing(), {});
    write_manifest(status);
    if (status == "done") folder_.remove_checkpoint();
  }

  void save_checkpoint() {
    record_.check_motion(clocks_.time(step()));
    const Real before = times_.now();
    record_.flush(true);
    observe::CheckpointWriter out(folder_.checkpoint());
    write_identity(out, identity_);
    CheckpointSaver saver(out);
    columns(saver);
    out.commit();
    checkpoint_step_ = step();
    times_.add(RunTimes::Part::checkpoints, times_.now() - before);
    write_manifest("running");
  }

  void columns(Archive& archive) {
    archive.folder("times", [&] { times_.columns(archive, {}); });
    archive.folder("record", [&] { record_.columns(archive); });
    archive.folder("stepper", [&] { model_.stepper->columns(archive); });
    std::vector<char> started(manifest_.started.begin(), manifest_.started.end());
    archive("started", started);
    manifest_.started.assign(started.begin(), started.end());
  }

  void write_manifest(const std::string& status) {
    manifest_.status = status;
    manifest_.finished = status == "running" ? "" : observe::time_of_day();
    manifest_.results = record_.results(step(), times_.now());
    manifest_.peak_particle_velocity = record_.peak_particle_velocity();
    manifest_.state_hash = record_.state_hash();
    observe::write_manifest(folder_.manifest(), manifest_);
  }

  /// As much as can still be written after an error, which is the one to report.
  void leave_behind(const std::string& status) {
    try {
      record_.flush(false);
      write_manifest(status);
    } catch (const MachineError&) {
    }
  }

  std::string where_it_can_go_on() const {
    if (checkpoint_step_ < 0) return "nothing of the run can be resumed: it had no checkpoint yet";
    return fmt::format("the checkpoint of t = {} s is kept in {}", number(clocks_.time(checkpoint_step_)), folder_.checkpoint().string());
  }

  const cases::CaseFile& file_;
  const RunOptions& options_;
  RunTimes times_;
  MpsModel<D> model_;
  RunFolder folder_;
  observe::Manifest manifest_;
  RunIdentity identity_;
  RunClocks clocks_;
  MpsRecord<D> record_;
  std::int64_t checkpoint_step_ = -1;
};

template <int D>
std::string check(const cases::CaseFile& file) {
  const MpsModel<D> model = build_mps<D>(file);
  gauge_particles<D>(file, model.filling);
  const RunClocks clocks = make_clocks(file.mps().time, model.step);
  const Real limit = model.stable_step(file.mps().time.integrator);
  const auto& supports = model.stepper->supports();
  const auto particles = static_cast<Real>(model.filling.sites.size());
  return cases::explain(file.mps()) +
         fmt::format("  {:<12}{} particles, number density {}, {} freedoms held, {} prescribed, {} on viscous boundaries\n", "body",
                     model.filling.sites.size(), number(model.number_density, 6), supports.held.size(), supports.driven.size(),
                     supports.dashpots.size()) +
         fmt::format("  {:<12}limit {} s, predicted from the largest frequency, {} rad/s, and the damping\n", "stability", number(limit, 5),
                     number(model.limit.frequency, 6)) +
         fmt::format("  {:<12}{} s, {} of the limit, {} to a history row\n", "step", number(model.step, 5), number(model.step / limit, 3),
                     clocks.steps_per_row) +
         fmt::format("  {:<12}{} steps, {} particle-steps\n", "work", clocks.steps(), number(particles * static_cast<Real>(clocks.steps()))) +
         (model.warning.empty() ? "" : "\n" + model.warning);
}

}  // namespace

RunOutcome run_mps(const cases::CaseFile& file, const RunOptions& options) {
  return file.mps().particles.dimension == 2 ? MpsRun<2>(file, options).run() : MpsRun<3>(file, options).run();
}

std::string check_mps(const cases::CaseFile& file) { return file.mps().particles.dimension == 2 ? check<2>(file) : check<3>(file); }

}  // namespace sazare::runs
