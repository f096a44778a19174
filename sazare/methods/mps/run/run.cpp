#include "sazare/methods/mps/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/mps/run/identity.hpp"
#include "sazare/methods/mps/run/record.hpp"
#include "sazare/methods/mps/run/settle.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/cost.hpp"
#include "sazare/runs/particle_rows.hpp"

namespace sazare::runs {

namespace {

constexpr int particles_per_thread = 4000;  // with fewer a second thread takes more time than it saves
constexpr std::int64_t motion_check_steps = 32;

using cases::line, cases::number;

/// The part of method mps in a run, see CaseRun.
template <int D>
struct MpsWork final : WorkDefaults {
  const cases::CaseFile& file;
  RunTimes times;
  MpsModel<D> model;
  RunFolder folder;
  RunIdentity identity;
  RunClocks clocks;
  MpsRecord<D> record;
  const RunOptions& options;

  MpsWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        model(build_mps<D>(of)),
        folder(of_run.folder, of_run.begin),
        identity(identify(of.as<cases::MpsCase>(), filling_hash(model.filling))),
        clocks(make_clocks(of, of.as<cases::MpsCase>().time, "step", model.step)),
        record(folder, of, model, clocks),
        options(of_run) {
    parallel::limit_threads(static_cast<int>(particles()) / particles_per_thread);
  }

  std::int64_t particles() const { return static_cast<std::int64_t>(model.filling.sites.size()); }

  const std::string& title() const { return file.as<cases::MpsCase>().title; }
  static std::string method() { return "mps"; }
  std::string warning() const override { return model.warning; }
  std::string words() const {
    std::string text = fmt::format("{} particles, step {} s, {} of the predicted limit", particles(), number(model.step),
                                   number(model.step / model.stable_step(file.as<cases::MpsCase>().time), 3));
    for (const std::string& side : model.sides) text += "\n  " + side;
    return text;
  }
  Real checkpoint_interval() const { return file.as<cases::MpsCase>().output.checkpoint_interval; }

  bool start() {
    if (!settle<D>(file.as<cases::MpsCase>(), model, options)) return false;
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
  void read_motion(MotionTable& table) const { read_particles(*model.stepper, static_cast<Index>(particles()), table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, step() * particles(), model.step, -1, "particle-steps"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::MpsCase>(), folder.path()));
  }
};

/// How many degrees of freedom do not simply follow from forces.
template <int D>
std::string words_of_freedoms(const particles::ParticleSupports<D>& supports) {
  const auto beside = std::ranges::count(supports.dashpots, true, &particles::Dashpot::is_beside_column);
  std::string text = fmt::format("{} degrees of freedom held, {} prescribed, {} on viscous boundaries", supports.held.size(),
                                 supports.driven.size(), std::ssize(supports.dashpots) - beside);
  return beside == 0 ? text : text + fmt::format(", {} on free-field sides", beside);
}

template <int D>
std::string side_lines(const MpsModel<D>& model) {
  std::string text;
  for (const std::string& side : model.sides) text += line("held", side);
  return text;
}

/// Extent of the ground, and the waves that particles can follow.
template <int D>
std::string second_look(const cases::MpsCase& mps, const state::Particles<D>& particles) {
  cases::Extent extent;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto own = std::span(particles.start[axis]).first(particles.size());
    extent.low[static_cast<Eigen::Index>(axis)] = std::ranges::min(own) - 0.5 * particles.spacing;
    extent.high[static_cast<Eigen::Index>(axis)] = std::ranges::max(own) + 0.5 * particles.spacing;
  }
  Real mass = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) mass += 1 / particles.inverse_mass[i];
  std::string text = cases::explain_size(extent) + line("mass", cases::mass_text(mass, D == 2));
  for (const cases::Ground& ground : mps.materials)
    text += cases::explain_waves(ground.name, ground.p_wave_velocity, ground.s_wave_velocity, particles.spacing);
  return text;
}

template <int D>
std::string warn_of_waves(const cases::CaseFile& file, const state::Particles<D>& particles) {
  const auto& mps = file.as<cases::MpsCase>();
  Real slowest = std::numeric_limits<Real>::infinity();
  for (const cases::Ground& ground : mps.materials) slowest = std::min(slowest, ground.s_wave_velocity);
  return cases::warn_of_short_waves(file, mps.motions, mps.time.end, slowest, particles.spacing);
}

template <int D>
std::string cost_text(const cases::MpsCase& mps, Real particles, const RunClocks& clocks) {
  constexpr Real elastic_in_plane = 30e6, elastic_in_space = 4e6, share_with_strength = 0.4, history_columns = 20,
                 gauge_columns = 6, bytes_of_particle = 270;
  const bool yields = std::ranges::any_of(mps.materials, [](const cases::Ground& ground) { return ground.fails(); });
  return runs::cost_text({.work = particles * static_cast<Real>(clocks.steps()),
                          .work_per_second = (D == 2 ? elastic_in_plane : elastic_in_space) * (yields ? share_with_strength : 1),
                          .columns = history_columns + gauge_columns * static_cast<Real>(mps.gauges.size()),
                          .bodies = particles,
                          .bytes_of_body = bytes_of_particle},
                         clocks);
}

template <int D>
std::string check(const cases::CaseFile& file, const std::optional<MpsCoupling>& coupling) {
  const MpsModel<D> model = build_mps<D>(file, coupling);
  gauge_particles<D>(file, model.filling);
  const auto& mps = file.as<cases::MpsCase>();
  const RunClocks clocks = make_clocks(file, mps.time, "step", model.step);
  const Real limit = model.stable_step(mps.time);
  const auto particles = static_cast<Real>(model.filling.sites.size());
  return cases::explain(file.as<cases::MpsCase>()) +
         line("body", fmt::format("{} particles, number density {}, {}", model.filling.sites.size(),
                                  number(model.number_density, 6), words_of_freedoms<D>(model.stepper->supports()))) +
         second_look<D>(file.as<cases::MpsCase>(), model.stepper->particles()) + side_lines(model) +
         softening_lines(mps, softening_place<D>(mps, *model.links, model.filling, model.material)) +
         line("stability", fmt::format("{}, predicted from the largest frequency, {} rad/s, and the damping",
                                       cases::limit_text(limit, 5), number(model.limit.frequency, 6))) +
         line("step", fmt::format("{} s, {} of the limit, {} per history row", number(model.step, 5),
                                  number(model.step / limit, 3), clocks.steps_per_row)) +
         line("work",
              fmt::format("{} steps, {} particle-steps", clocks.steps(), number(particles * static_cast<Real>(clocks.steps())))) +
         cost_text<D>(file.as<cases::MpsCase>(), particles, clocks) + warn_of_waves<D>(file, model.stepper->particles()) +
         (model.warning.empty() ? "" : "\n" + model.warning);
}

}  // namespace

std::unique_ptr<LiveRun> open_mps(const cases::CaseFile& file, const RunOptions& options) {
  if (file.as<cases::MpsCase>().particles.dimension == 2) return std::make_unique<CaseRun<MpsWork<2>>>(file, options);
  return std::make_unique<CaseRun<MpsWork<3>>>(file, options);
}

std::string check_mps(const cases::CaseFile& file, const std::optional<MpsCoupling>& coupling) {
  return file.as<cases::MpsCase>().particles.dimension == 2 ? check<2>(file, coupling) : check<3>(file, coupling);
}

}  // namespace sazare::runs
