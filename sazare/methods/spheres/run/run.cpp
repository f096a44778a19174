#include "sazare/methods/spheres/run/run.hpp"

#include <cmath>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/methods/spheres/case/format.hpp"
#include "sazare/methods/spheres/run/identity.hpp"
#include "sazare/methods/spheres/run/motion_rows.hpp"
#include "sazare/methods/spheres/run/rain.hpp"
#include "sazare/methods/spheres/run/record.hpp"
#include "sazare/methods/spheres/run/restitution.hpp"
#include "sazare/methods/spheres/run/sharing.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/cost.hpp"

namespace sazare::runs {

namespace {

constexpr int spheres_per_thread = 4000;  // with fewer a second thread takes more time than it saves
constexpr std::int64_t motion_check_steps = 32;

using cases::line, cases::number;

/// The part of method spheres in a run, see CaseRun.
struct SpheresWork final : WorkDefaults {
  const cases::CaseFile& file;
  RunTimes times;
  SpheresModel model;
  RunFolder folder;
  RunIdentity identity;
  RunClocks clocks;
  SpheresRecord record;
  const RunOptions& options;
  std::vector<SphereRankWork> rank_work;  ///< at the last collection; of the first of several processes

  SpheresWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        model(build_spheres(of)),
        folder(enter_folder(of_run)),
        identity(identify(of.as<cases::SpheresCase>(), observe::to_hex(model.start))),
        clocks(make_clocks(of, of.as<cases::SpheresCase>().time, "step", model.steps.step)),
        record(folder, of, model, clocks, is_writer(of_run)),
        options(of_run) {
    share_among(model, of_run.sharing);
    give_back_large_tables();
    parallel::limit_threads(static_cast<int>(spheres()) / spheres_per_thread);
  }

  /// Other processes come when the first one has made the folder.
  static RunFolder enter_folder(const RunOptions& options) {
    const bool alone = options.sharing.ranks == nullptr, writes = is_writer(options);
    if (!writes) options.sharing.ranks->barrier();
    RunFolder entered = writes ? RunFolder(options.folder, options.begin) : RunFolder::of_another(options.folder, options.begin);
    if (!alone && writes) options.sharing.ranks->barrier();
    return entered;
  }

  std::int64_t spheres() const { return static_cast<std::int64_t>(model.group.size()); }

  const std::string& title() const { return file.as<cases::SpheresCase>().title; }
  static std::string method() { return "spheres"; }
  std::string words() const {
    const SphereSteps& steps = model.steps;
    const std::string share = number(steps.smallest() / steps.limit, 3);
    std::string words =
        steps.level.empty()
            ? fmt::format("{}, step {} s, {} of the limit", cases::counted(spheres(), "spheres"), number(steps.step), share)
            : fmt::format("{} at {} levels, steps {} to {} s, {} of the limit", cases::counted(spheres(), "spheres"),
                          steps.count.size(), number(steps.smallest()), number(steps.step), share);
    for (const std::string& note : model.wall_notes) words += "\n  " + note;
    return words;
  }
  std::string warning() const override { return warn_of_restitution(file, model); }
  Real checkpoint_interval() const { return file.as<cases::SpheresCase>().output.checkpoint_interval; }

  bool start() {
    if (!let_rain(file.as<cases::SpheresCase>(), model, options)) return false;
    model.stepper->start();
    return true;
  }

  bool advance(const Pause&) {
    model.stepper->advance();
    return true;
  }
  std::int64_t step() const { return model.stepper->steps(); }
  bool must_check() const override { return step() % motion_check_steps == 0; }
  void read_motion(MotionTable& table) { read_spheres(*model.stepper, table); }
  void survey() override {
    model.stepper->survey(record.needs_motion(step()));
    if (!is_writer(options)) record.check_step(clocks.time(step()));  // as the first one does with its row: all throw, or none
  }
  void collect() override {
    model.stepper->collect();
    rank_work = gather_rank_work(model);
  }
  void write_rank_times() override { runs::write_rank_times(folder.ranks(), clocks.time(step()), rank_work); }
  bool takes_forces() const override { return true; }
  void apply(std::span<const Vector3> forces) override { model.stepper->apply({forces.begin(), forces.end()}); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, model.stepper->particle_steps(), model.steps.smallest(), -1, "particle-steps"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::SpheresCase>(), folder.path()));
  }
  void write_end() override { record.write_fragments(); }
};

}  // namespace

std::unique_ptr<LiveRun> open_spheres(const cases::CaseFile& file, const RunOptions& options) {
  return std::make_unique<CaseRun<SpheresWork>>(file, options);
}

namespace {

/// What `check` says of shapes and walls of triangles.
std::string notes_text(const SpheresModel& model) {
  std::string text;
  for (const ShapeVolume& shape : model.shapes)
    if (shape.fill)
      text += line("shapes", fmt::format("\"{}\": its spheres fill {} % of its surface, whose mass and inertia it has",
                                         shape.shape, number(100 * *shape.fill, 3)));
  for (const std::string& note : model.wall_notes) text += line("walls", note);
  return text;
}

std::string size_text(const SpheresModel& model) {
  if (model.group.empty()) return "";
  const auto place = [&](std::size_t i) -> const state::SpherePlace& { return model.stepper->spheres().place[i]; };
  return cases::explain_size(cases::extent_of(
      model.group.size(), [&](std::size_t i) { return place(i).centre(); },
      [&](std::size_t i) -> Vector3 { return Vector3::Constant(place(i).radius); }));
}

/// Tells of bodies that fall without end: nothing is below them, no wall and no group that is held.
std::string held_text(const cases::SpheresCase& spheres) {
  const Real fall = 0.5 * spheres.gravity.acceleration.norm() * spheres.time.end * spheres.time.end;
  const bool is_held = std::ranges::any_of(spheres.spheres, [](const cases::SphereGroup& group) { return group.held; });
  if (fall == 0 || is_held || !spheres.walls.empty()) return "";
  return line("held", fmt::format("no wall and no held group: the bodies fall {} m in the time of the run", number(fall)));
}

/// What `check` says of the steps of a body.
std::string steps_text(const SphereSteps& steps, const RunClocks& clocks) {
  std::string text = line("stability", cases::limit_text(steps.limit, 5)) +
                     line(steps.level.empty() ? "step" : "base step",
                          fmt::format("{} s, {} of the limit, {} to a history row", number(steps.step, 5),
                                      number(steps.step / steps.limit, 3), clocks.steps_per_row));
  for (std::size_t level = 0; level < steps.count.size(); ++level)
    text += line(level == 0 ? "levels" : "", fmt::format("{}: {}, {} s", level, cases::counted(steps.count[level], "spheres"),
                                                         number(std::ldexp(steps.step, -static_cast<int>(level)), 5)));
  std::string work = fmt::format("{} steps, {} particle-steps", clocks.steps(),
                                 number(steps.particle_steps * static_cast<Real>(clocks.steps())));
  if (!steps.level.empty())
    work += fmt::format(" or so, {} of those that a uniform step needs", number(steps.share_of_uniform, 2));
  return text + line("work", work);
}

/// On one core, in the cases of the project: single spheres; those of clumps wait for all of their body; bonds cost more than
/// contacts.
Real particle_steps_per_second(const SpheresModel& model) {
  constexpr Real alone = 25e6, in_clumps = 12e6, bonded = 5e6, share_in_water = 0.75;
  const Real dry = model.bonds > 0 ? bonded : model.clumps > 0 ? in_clumps : alone;
  return model.stepper->water().empty() ? dry : share_in_water * dry;
}

std::string cost_text(const cases::SpheresCase& spheres, const SpheresModel& model, const RunClocks& clocks) {
  constexpr Real history_columns = 20, gauge_columns = 12, bytes_of_sphere = 120;
  return runs::cost_text({.work = model.steps.particle_steps * static_cast<Real>(clocks.steps()),
                          .work_per_second = particle_steps_per_second(model),
                          .columns = history_columns + gauge_columns * static_cast<Real>(spheres.gauges.size()),
                          .bodies = static_cast<Real>(model.group.size()),
                          .bytes_of_body = bytes_of_sphere},
                         clocks);
}

}  // namespace

std::string check_spheres(const cases::CaseFile& file) {
  const SpheresModel model = build_spheres(file);
  const RunClocks clocks = make_clocks(file, file.as<cases::SpheresCase>().time, "step", model.steps.step);
  const std::string warning = warn_of_restitution(file, model);
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
  return cases::explain(file.as<cases::SpheresCase>()) +
         line("body",
              fmt::format("{} of radius {} to {} m, {}", cases::counted(static_cast<std::int64_t>(model.group.size()), "spheres"),
                          number(smallest), number(largest),
                          cases::counted(static_cast<std::int64_t>(model.stepper->walls().walls().size()), "walls"))) +
         size_text(model) + line("mass", cases::mass_text(mass)) + held_text(file.as<cases::SpheresCase>()) +
         (model.clumps > 0 ? line("clumps", fmt::format("{} rigid, of {} m3 together", model.clumps, number(volume))) : "") +
         (model.stepper->bodies().empty()
              ? ""
              : line("bodies", fmt::format("{} bonded, their inertia within {} of that of their shapes",
                                           model.stepper->bodies().count(), number(model.share_error, 2)))) +
         (model.bonds > 0 ? line("bonds", fmt::format("{} at the start", model.bonds)) : "") + notes_text(model) +
         steps_text(model.steps, clocks) + cost_text(file.as<cases::SpheresCase>(), model, clocks) +
         (warning.empty() ? "" : "\n" + warning);
}

}  // namespace sazare::runs
