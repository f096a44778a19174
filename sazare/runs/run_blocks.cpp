#include "sazare/runs/run_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sazare/cases/number_text.hpp"
#include "sazare/cases/resolved.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/version.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/runs/checkpoint_archive.hpp"
#include "sazare/runs/mesh_source.hpp"
#include "sazare/runs/progress.hpp"
#include "sazare/runs/rank_times.hpp"
#include "sazare/runs/run_identity.hpp"
#include "sazare/runs/run_record.hpp"
#include "sazare/runs/run_times.hpp"
#include "sazare/runs/stability.hpp"
#include "sazare/runs/state_hash.hpp"

namespace sazare::runs {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto flush_interval = std::chrono::seconds(2);
constexpr Index elements_per_thread = 4000;  // with fewer a second thread takes more time than it saves (measured)
constexpr std::int64_t motion_check_steps = 8;  // a failing motion grows by some orders of magnitude in a step

observe::Manifest new_manifest(const cases::CaseFile& file) {
  observe::Manifest manifest;
  manifest.version = version;
  manifest.commit = commit;
  manifest.case_title = file.blocks().title;
  manifest.method = "blocks";
  manifest.status = "running";
  manifest.started = observe::time_of_day();
  manifest.machine = observe::this_machine();
  return manifest;
}

class BlocksRun {
 public:
  BlocksRun(const cases::CaseFile& file, const RunOptions& options)
      : file_(file), options_(options), folder_(enter_folder()), manifest_(new_manifest(file)),
        model_(build_blocks(file.blocks(), mesh(), options.sharing)),
        identity_(identify(file.blocks(), model_.mesh)), clocks_(make_clocks(file.blocks().time, simulation().levels().step(0))),
        record_(folder_, file, model_, clocks_) {
    parallel::limit_threads(simulation().bodies().size() / elements_per_thread);
    manifest_.machine.threads = parallel::threads();
    if (options.sharing.ranks != nullptr) manifest_.machine.ranks = options.sharing.ranks->size();
    const std::string warning = check_stability(file, model_);
    if (!warning.empty()) fmt::print(stderr, "{}", warning);
    times_.add(RunTimes::Part::setup, times_.now());
  }

  RunOutcome run() {
    try {
      if (folder_.resumes())
        resume();
      else
        begin();
      const bool stopped = walk();
      end(stopped ? "stopped" : "done");
      return {stopped, clocks_.time(step_), manifest_};
    } catch (const PhysicsError& error) {
      leave_behind("failed");
      throw PhysicsError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    } catch (const MachineError& error) {
      leave_behind("stopped");
      throw MachineError(fmt::format("{}\n  {}", error.what(), where_it_can_go_on()));
    }
  }

 private:
  /// Of several processes, only the first one writes. The others come when it has made the folder and the mesh.
  bool writes() const { return options_.sharing.ranks == nullptr || options_.sharing.ranks->is_first(); }

  RunFolder enter_folder() const {
    if (writes()) return {options_.folder, options_.begin};
    options_.sharing.ranks->barrier();
    return RunFolder::of_another(options_.folder, options_.begin);
  }

  geometry::TetraMesh mesh() const {
    geometry::TetraMesh loaded = load_mesh(file_, folder_.mesh(), folder_.resumes() || !writes());
    if (writes() && options_.sharing.ranks != nullptr) options_.sharing.ranks->barrier();
    return loaded;
  }

  bool agree(bool by_first) const {
    return options_.sharing.ranks == nullptr ? by_first : options_.sharing.ranks->from_first(by_first) != 0;
  }

  engine::Simulation<3>& simulation() { return *model_.simulation; }

  void say(const std::string& line) const {
    if (options_.quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  void begin() {
    if (options_.begin == Begin::resume)
      say(fmt::format("{}: no checkpoint to resume from, so the run begins anew", folder_.path().string()));
    write_manifest("running");
    if (writes()) observe::write_file(folder_.case_file(), cases::write_resolved(file_.blocks(), folder_.path()));
    say(fmt::format("{}: {} elements, {} joints, base step {} s", file_.blocks().title, simulation().bodies().size(),
                    model_.joints->links().size(), cases::short_number(simulation().levels().step(0), 4)));
    if (writes()) record_.begin();
    simulation().start();
    observe();
    save_checkpoint();
  }

  void resume() {
    const observe::CheckpointReader in(folder_.checkpoint());
    check_identity(in, folder_.path(), identity_);
    CheckpointLoader loader(in);
    columns(loader);
    if (writes()) record_.resume();
    checkpoint_step_ = step_;
    write_manifest("running");
    say(fmt::format("{}: resumed at t = {} s of {} s", file_.blocks().title, cases::short_number(clocks_.time(step_)),
                    cases::short_number(clocks_.end)));
  }

  /// To the end, or until asked to stop: then true.
  bool walk() {
    Progress progress(options_.quiet, state());
    auto next_checkpoint = Clock::now() + checkpoint_interval();
    auto next_flush = Clock::now() + flush_interval;
    while (step_ < clocks_.steps()) {
      if (agree(options_.stop_asked != nullptr && options_.stop_asked->load(std::memory_order_relaxed))) return true;
      simulation().advance();
      ++step_;
      check_motion();
      observe();
      if (progress.is_due()) progress.show(state());
      const auto now = Clock::now();
      if (writes() && now >= next_flush) {
        record_.flush(false);
        next_flush = now + flush_interval;
      }
      if (!agree(now >= next_checkpoint && step_ < clocks_.steps())) continue;
      save_checkpoint();
      next_checkpoint = Clock::now() + checkpoint_interval();
    }
    return false;
  }

  void check_motion() {
    const bool mixed = simulation().levels().finest() > 0;  // then a base step is many
    if (mixed || clocks_.is_row(step_) || step_ % motion_check_steps == 0) record_.check_motion(clocks_.time(step_));
  }

  Clock::duration checkpoint_interval() const {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<Real>(
        std::min(file_.blocks().output.checkpoint_interval, Real{1e8})));
  }

  ProgressState state() {
    const Real share = static_cast<Real>(step_) / static_cast<Real>(clocks_.steps());
    return {share, clocks_.time(step_), simulation().counters().pair_evaluations, record_.latest_smallest_step(),
            model_.joints->broken_count()};
  }

  void observe() {
    if (!clocks_.is_row(step_)) return;
    const Real before = times_.now();
    simulation().collect();
    if (!writes()) return;
    record_.observe(step_, before);
    times_.add(RunTimes::Part::output, times_.now() - before);
  }

  void end(const std::string& status) {
    if (status != "done") save_checkpoint();
    simulation().collect();
    if (!writes()) return;
    if (status == "done") {
      const Real before = times_.now();
      record_.flush(true);
      record_.write_fragments();
      times_.add(RunTimes::Part::output, times_.now() - before);
    }
    times_.write(folder_.timing(), simulation().part_times());
    rank_times_.write(folder_.ranks(), simulation());
    write_manifest(status);
    if (status == "done") folder_.remove_checkpoint();
  }

  /// Never of a state that is no number: the last good checkpoint stays.
  void save_checkpoint() {
    record_.check_motion(clocks_.time(step_));
    const Real before = times_.now();
    simulation().collect();
    if (!writes()) return;
    record_.flush(true);
    observe::CheckpointWriter out(folder_.checkpoint());
    write_identity(out, identity_);
    CheckpointSaver saver(out);
    columns(saver);
    out.commit();
    checkpoint_step_ = step_;
    times_.add(RunTimes::Part::checkpoints, times_.now() - before);
    write_manifest("running");
  }

  void columns(Archive& archive) {
    archive("step", step_);
    archive.folder("times", [&] { times_.columns(archive, simulation().part_times()); });
    archive.folder("record", [&] { record_.columns(archive); });
    archive.folder("simulation", [&] { simulation().columns(archive); });
    std::vector<char> started(manifest_.started.begin(), manifest_.started.end());
    archive("started", started);
    manifest_.started.assign(started.begin(), started.end());
  }

  void write_manifest(const std::string& status) {
    if (!writes()) return;
    manifest_.status = status;
    manifest_.finished = status == "running" ? "" : observe::time_of_day();
    manifest_.results = record_.results(step_, times_.now());
    manifest_.peak_particle_velocity = record_.peak_particle_velocity();
    manifest_.state_hash = state_hash(model_);
    observe::write_manifest(folder_.manifest(), manifest_);
  }

  /// As much as can still be written after an error.
  void leave_behind(const std::string& status) {
    try {
      if (writes()) record_.flush(false);
    } catch (const MachineError&) {  // the error that led here is the one to report
    }
    try {
      write_manifest(status);
    } catch (const MachineError&) {
    }
  }

  std::string where_it_can_go_on() const {
    if (checkpoint_step_ < 0) return "nothing of the run can be resumed: it had no checkpoint yet";
    return fmt::format("the checkpoint of t = {} s is kept in {}", cases::short_number(clocks_.time(checkpoint_step_)),
                       folder_.checkpoint().string());
  }

  const cases::CaseFile& file_;
  const RunOptions& options_;
  RunTimes times_;
  RankTimes rank_times_;
  RunFolder folder_;
  observe::Manifest manifest_;
  BlocksModel model_;
  RunIdentity identity_;
  RunClocks clocks_;
  RunRecord record_;
  std::int64_t step_ = 0;
  std::int64_t checkpoint_step_ = -1;
};

}  // namespace

RunOutcome run_blocks(const cases::CaseFile& file, const RunOptions& options) { return BlocksRun(file, options).run(); }

}  // namespace sazare::runs
