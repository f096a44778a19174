#include "sazare/methods/hybrid/case/format.hpp"
#include "sazare/methods/hybrid/continuum_side.hpp"
#include "sazare/methods/hybrid/run/continuum.hpp"
#include "sazare/methods/hybrid/run/identity.hpp"
#include "sazare/methods/hybrid/run/model.hpp"
#include "sazare/methods/hybrid/run/one_side.hpp"
#include "sazare/methods/hybrid/run/run.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"

namespace sazare::runs {

namespace {

/// Measures how long the partner takes.
class TimedLine final : public coupling::ContinuumChannel {
public:
  TimedLine(coupling::ContinuumChannel& channel, const RunTimes& times) : channel_(&channel), times_(&times) {}

  coupling::SurfaceForce open(const coupling::SurfaceShape& shape) override { return channel_->open(shape); }
  coupling::SurfaceForce exchange(const coupling::SurfaceMotion& motion) override {
    const Real before = times_->now();
    coupling::SurfaceForce force = channel_->exchange(motion);
    waited += times_->now() - before;
    return force;
  }
  void close() override { channel_->close(); }

  Real waited = 0;  ///< [s]

private:
  coupling::ContinuumChannel* channel_;
  const RunTimes* times_;
};

/// The finite elements of a hybrid case, see CaseRun. A step of the run is a window.
template <int D>
struct ContinuumWork final : WorkDefaults {
  const cases::CaseFile& file;
  RunTimes times;
  RunFolder folder;
  ContinuumModel<D> model;
  methods::hybrid::ContinuumSide<D> side;
  RunIdentity identity;
  RunClocks clocks;
  ContinuumRecord<D> record;
  PartnerLine<coupling::FileContinuumChannel> line;
  SideTimes side_times{"finite elements"};

  ContinuumWork(const cases::CaseFile& of, const RunOptions& options)
      : file(of),
        folder(options.folder, options.begin),
        model(build_continuum<D>(continuum_case(), load_continuum_mesh(continuum_case(), folder.mesh(), folder.resumes()))),
        side(*model.stepper, coupled_surface(of, model.mesh()), coupling_rules(of.as<cases::HybridCase>())),
        identity(identify(of.as<cases::HybridCase>(), identify(continuum_content(), mesh_hash(model.mesh())), {})),
        clocks(make_clocks(continuum_content().time, model.step)),
        record(folder, continuum_case(), model, clocks),
        line(options) {
    parallel::limit_threads(static_cast<int>(model.mesh().elements.size()) / continuum_elements_per_thread);
  }

  const cases::CaseFile& continuum_case() const { return *file.as<cases::HybridCase>().continuum; }
  const cases::ContinuumCase& continuum_content() const { return cases::continuum_of(file.as<cases::HybridCase>()); }

  const std::string& title() const { return continuum_content().title; }
  static std::string method() { return std::string(cases::continuum_method); }
  std::string words() const {
    return fmt::format("{} elements, {} degrees of freedom, step {} s, the bodies in another program",
                       model.mesh().elements.size(), model.stepper->free_freedoms(), cases::short_number(model.step, 4));
  }
  Real checkpoint_interval() const { return file.as<cases::HybridCase>().output.checkpoint_interval; }

  bool start() {
    if (continuum_content().gravity.settle) model.stepper->relax();
    model.stepper->start();
    line.open();
    side.start(line.channel().open(side.shape()));
    line.mark();
    return true;
  }

  /// A window that the partner does not answer is given up as a whole.
  bool advance(const Pause&) {
    const methods::hybrid::ContinuumSide<D> side_before = side;
    const methods::hybrid::ContinuumState<D> state_before = model.stepper->state();
    const Real before = times.now(), exchanged = line.cost().seconds;
    TimedLine timed(line.channel(), times);
    try {
      side.advance(timed);
    } catch (const coupling::Stopped&) {
      model.stepper->restore(state_before);
      side = side_before;
      throw;
    }
    line.mark();
    side_times.add(times.now() - before, timed.waited, line.cost().seconds - exchanged);
    return true;
  }
  std::int64_t step() const { return side.totals().windows; }
  void read_motion(MotionTable& table) const { read_nodes(*model.stepper, table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, model.stepper->state().iterations, model.step, -1, "iterations"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
    archive.folder("side", [&] { side.columns(archive); });
    archive.folder("exchange", [&] { line.columns(archive); });
    if (!archive.reading()) return;
    line.open();
    line.channel().reopen(side.shape());
  }

  bool has_partner() const override { return true; }
  void checkpoint_made() override { line.checkpoint_made(); }
  void part(coupling::Farewell reason, const std::string& words) override { line.part(reason, step(), words); }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::vector<levels::PartTime> part_times() const override { return {side_times.parts.begin(), side_times.parts.end()}; }
  std::vector<std::pair<std::string, observe::Figure>> more_figures() const override { return line.figures(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(continuum_content(), folder.path()));
  }
  void write_end() override { line.channel().close(); }
};

}  // namespace

std::unique_ptr<LiveRun> open_continuum(const cases::CaseFile& file, const RunOptions& options) {
  if (cases::continuum_of(file.as<cases::HybridCase>()).mesh.dimension == 2)
    return std::make_unique<CaseRun<ContinuumWork<2>>>(file, options);
  return std::make_unique<CaseRun<ContinuumWork<3>>>(file, options);
}

}  // namespace sazare::runs
