#include <cmath>

#include "sazare/cases/resolved.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/run_case.hpp"
#include "sazare/runs/spheres_record.hpp"

namespace sazare::runs {

namespace {

constexpr int spheres_per_thread = 4000;  // with fewer a second thread takes more time than it saves
constexpr std::int64_t motion_check_steps = 32;

std::string number(Real value, int digits = 4) { return cases::short_number(value, digits); }

/// The part of method spheres in a run, see CaseRun.
struct SpheresWork {
  const cases::CaseFile& file;
  RunTimes times;
  SpheresModel model;
  RunFolder folder;
  RunIdentity identity;
  RunClocks clocks;
  SpheresRecord record;
  const RunOptions& options;
  std::string no_warning;

  SpheresWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        model(build_spheres(of)),
        folder(of_run.folder, of_run.begin),
        identity(identify(of.spheres(), observe::to_hex(model.start))),
        clocks(make_clocks(of.spheres().time, model.step)),
        record(folder, of, model, clocks),
        options(of_run) {
    give_back_large_tables();
    parallel::limit_threads(static_cast<int>(spheres()) / spheres_per_thread);
  }

  std::int64_t spheres() const { return static_cast<std::int64_t>(model.group.size()); }

  const std::string& title() const { return file.spheres().title; }
  static std::string method() { return "spheres"; }
  const std::string& warning() const { return no_warning; }
  std::string words() const {
    return fmt::format("{} spheres, step {} s, {} of the limit", spheres(), number(model.step),
                       number(model.step / model.limit, 3));
  }
  Real checkpoint_interval() const { return file.spheres().output.checkpoint_interval; }

  bool start() {
    if (!rain()) return false;
    model.stepper->start();
    return true;
  }

  /// False when asked to stop before all that falls rests.
  bool rain() {
    engine::RainRules rules = rain_rules(file.spheres(), model);
    if (std::ranges::count(rules.rains, 1) == 0) return true;
    if (!options.quiet) fmt::print("falling to rest under gravity\n");
    std::fflush(stdout);
    Progress progress(options.quiet, {.smallest_step = model.step, .broken_joints = -1, .evaluated = "particle-steps"});
    Real first = 0;
    rules.goes_on = [&](std::int64_t done, Real unrest) {
      first = std::max(first, unrest);
      // What is left falls by about the same factor in equal times.
      if (progress.is_due())
        progress.show({std::log(first / unrest) / std::log(first), 0, done * spheres(), model.step, -1, "particle-steps"});
      return options.stop_asked == nullptr || !options.stop_asked->load(std::memory_order_relaxed);
    };
    const engine::RainEnd end = model.stepper->rain(rules);
    if (!end.goes_on || end.unrest <= 1) return end.goes_on;
    throw PhysicsError(
        fmt::format("what rains does not come to rest: after {} steps it moves {} times as much as at rest\n"
                    "  it finds no ground, or nothing brakes it: look at the walls below, at friction and at restitution",
                    end.steps, number(end.unrest, 3)));
  }
  void advance() { model.stepper->advance(); }
  std::int64_t step() const { return model.stepper->steps(); }
  bool must_check() const { return step() % motion_check_steps == 0; }
  void collect() {}
  void read_motion(MotionTable& table) { read_spheres(*model.stepper, table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, step() * spheres(), model.step, -1, "particle-steps"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  static std::span<const engine::PartTime> part_times() { return {}; }
  void write_case() const { observe::write_file(folder.case_file(), cases::write_resolved(file.spheres(), folder.path())); }
  void write_end() {}
  void write_rank_times() {}
};

}  // namespace

std::unique_ptr<LiveRun> open_spheres(const cases::CaseFile& file, const RunOptions& options) {
  return std::make_unique<CaseRun<SpheresWork>>(file, options);
}

std::string check_spheres(const cases::CaseFile& file) {
  const SpheresModel model = build_spheres(file);
  const RunClocks clocks = make_clocks(file.spheres().time, model.step);
  const auto spheres = static_cast<Real>(model.group.size());
  Real volume = 0, mass = 0, smallest = 0, largest = 0;
  for (const state::Clump& clump : model.stepper->clumps().clumps) {
    volume += clump.volume;
    mass += clump.mass;
  }
  for (std::size_t i = 0; i < model.group.size(); ++i) {
    const state::SpherePlace& place = model.stepper->spheres().place[i];  // before the first step, by number
    if (model.body[i] < 0) mass += place.mass;
    smallest = smallest > 0 ? std::min(smallest, place.radius) : place.radius;
    largest = std::max(largest, place.radius);
  }
  return cases::explain(file.spheres()) +
         fmt::format("  {:<12}{} spheres of radius {} to {} m, {} kg, {} walls\n", "body", model.group.size(), number(smallest),
                     number(largest), number(mass), model.stepper->walls().walls().size()) +
         (model.clumps > 0 ? fmt::format("  {:<12}{} rigid, of {} m3 together\n", "clumps", model.clumps, number(volume)) : "") +
         (model.bonds > 0 ? fmt::format("  {:<12}{} at the start\n", "bonds", model.bonds) : "") +
         fmt::format("  {:<12}limit {} s\n", "stability", number(model.limit, 5)) +
         fmt::format("  {:<12}{} s, {} of the limit, {} to a history row\n", "step", number(model.step, 5),
                     number(model.step / model.limit, 3), clocks.steps_per_row) +
         fmt::format("  {:<12}{} steps, {} particle-steps\n", "work", clocks.steps(),
                     number(spheres * static_cast<Real>(clocks.steps())));
}

}  // namespace sazare::runs
