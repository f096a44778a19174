#include "sazare/methods/rectangles/run/run.hpp"

#include <cmath>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/methods/rectangles/case/format.hpp"
#include "sazare/methods/rectangles/run/identity.hpp"
#include "sazare/methods/rectangles/run/record.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/cost.hpp"
#include "sazare/runs/particle_rows.hpp"

namespace sazare::runs {

namespace {

constexpr int elements_per_thread = 4000;  // with fewer a second thread takes more time than it saves
constexpr std::int64_t motion_check_steps = 64;

using cases::line, cases::number;

/// The part of method rectangles in a run, see CaseRun.
struct RectanglesWork final : WorkDefaults {
  const cases::CaseFile& file;
  RunTimes times;
  RectanglesModel model;
  RunFolder folder;
  RunIdentity identity;
  RunClocks clocks;
  RectanglesRecord record;

  RectanglesWork(const cases::CaseFile& of, const RunOptions& options)
      : file(of),
        model(build_rectangles(of)),
        folder(options.folder, options.begin),
        identity(identify(of.as<cases::RectanglesCase>(), assembly_hash(model.stepper->particles()))),
        clocks(make_clocks(of, of.as<cases::RectanglesCase>().time, "step", model.step)),
        record(folder, of, model, clocks) {
    parallel::limit_threads(model.elements / elements_per_thread);
  }

  const std::string& title() const { return file.as<cases::RectanglesCase>().title; }
  static std::string method() { return "rectangles"; }
  std::string warning() const override { return model.warning; }
  std::string words() const {
    return fmt::format("{}, step {} s, {} of the predicted limit", cases::counted(model.elements, "elements"), number(model.step),
                       number(model.step / model.limit.limit, 3));
  }
  Real checkpoint_interval() const { return file.as<cases::RectanglesCase>().output.checkpoint_interval; }

  bool start() {
    model.stepper->start();
    return true;
  }
  bool advance(const Pause&) {
    model.stepper->advance();
    return true;
  }
  std::int64_t step() const { return model.stepper->steps(); }
  bool must_check() const override { return step() % motion_check_steps == 0; }
  bool takes_forces() const override { return true; }
  void apply(std::span<const Vector3> forces) override { model.stepper->apply(forces); }
  void read_motion(MotionTable& table) const { read_particles(*model.stepper, model.elements, table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, step() * model.elements, model.step, -1, "element-steps"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::RectanglesCase>(), folder.path()));
  }
};

}  // namespace

std::unique_ptr<LiveRun> open_rectangles(const cases::CaseFile& file, const RunOptions& options) {
  return std::make_unique<CaseRun<RectanglesWork>>(file, options);
}

namespace {

std::string size_text(const RectanglesModel& model) {
  const state::Particles<2>& particles = model.stepper->particles();
  return cases::explain_size(cases::extent_of(
      static_cast<std::size_t>(model.elements),
      [&](std::size_t i) { return Vector3(particles.position(0, i), particles.position(1, i), 0); },
      [&](std::size_t i) { return Vector3(model.forces->outlines().spring_radius(i) * Vector3(1, 1, 0)); }));
}

/// Mass, what holds, and the waves that a lattice of squares can follow.
std::string second_look(const cases::RectanglesCase& rectangles, const RectanglesModel& model) {
  const state::Particles<2>& particles = model.stepper->particles();
  Real mass = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.elements); ++i) mass += 1 / particles.inverse_mass[i];
  std::string text = line("mass", cases::mass_text(mass));
  for (const cases::SquareMaterial& material : rectangles.materials) {
    Real size = 0;
    for (const cases::SquareBlock& block : rectangles.blocks)
      if (block.material == material.name) size = std::max(size, block.element_size);
    if (size > 0)
      text += cases::explain_waves(material.name, std::sqrt(material.normal_stiffness / material.density),
                                   std::sqrt(material.shear_stiffness / material.density), size);
  }
  if (rectangles.walls.empty() && rectangles.rollers.empty()) {
    const Real fall = 0.5 * rectangles.gravity.acceleration.norm() * rectangles.time.end * rectangles.time.end;
    text += line(
        "held", fall > 0 ? fmt::format("no wall or roller holds the blocks, which fall {} m in the time of the run", number(fall))
                         : std::string("no wall or roller holds the blocks"));
  }
  return text;
}

std::string cost_text(const cases::RectanglesCase& rectangles, const RectanglesModel& model, const RunClocks& clocks) {
  constexpr Real element_steps_per_second = 20e6, history_columns = 20, gauge_columns = 6, bytes_of_element = 200;
  const auto elements = static_cast<Real>(model.elements);
  return runs::cost_text({.work = elements * static_cast<Real>(clocks.steps()),
                          .work_per_second = element_steps_per_second,
                          .columns = history_columns + gauge_columns * static_cast<Real>(rectangles.gauges.size()),
                          .bodies = elements,
                          .bytes_of_body = bytes_of_element},
                         clocks);
}

}  // namespace

std::string check_rectangles(const cases::CaseFile& file, std::optional<Real> window) {
  const RectanglesModel model = build_rectangles(file, window);
  gauge_elements(file, model);
  const RunClocks clocks = make_clocks(file, file.as<cases::RectanglesCase>().time, "step", model.step);
  const std::string paper = model.limit.paper > 0 ? fmt::format("; (26) of the paper: {} s", number(model.limit.paper)) : "";
  return cases::explain(file.as<cases::RectanglesCase>()) + line("body", cases::counted(model.elements, "elements")) +
         size_text(model) + second_look(file.as<cases::RectanglesCase>(), model) +
         line("stability", fmt::format("{}, predicted from the largest frequency, {} rad/s, and the dashpots{}",
                                       cases::limit_text(model.limit.limit), number(model.limit.largest_frequency), paper)) +
         line("step", fmt::format("{} s, {} of the limit, {} per history row", number(model.step, 5),
                                  number(model.step / model.limit.limit, 3), clocks.steps_per_row)) +
         line("work", fmt::format("{} steps, {} element-steps", clocks.steps(),
                                  number(static_cast<Real>(model.elements) * static_cast<Real>(clocks.steps())))) +
         cost_text(file.as<cases::RectanglesCase>(), model, clocks) + (model.warning.empty() ? "" : "\n" + model.warning);
}

}  // namespace sazare::runs
