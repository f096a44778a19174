#include "sazare/cases/resolved.hpp"
#include "sazare/engine/continuum_side.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/fem_record.hpp"
#include "sazare/runs/hybrid_model.hpp"
#include "sazare/runs/one_side.hpp"
#include "sazare/runs/run_case.hpp"

namespace sazare::runs {

namespace {

constexpr int elements_per_thread = 500;  // see method fem

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
struct ContinuumWork {
  const cases::CaseFile& file;
  RunTimes times;
  RunFolder folder;
  FemModel<D> model;
  engine::ContinuumSide<D> side;
  RunIdentity identity;
  RunClocks clocks;
  FemRecord<D> record;
  PartnerLine<coupling::FileContinuumChannel> line;
  SideTimes side_times{"finite elements"};

  ContinuumWork(const cases::CaseFile& of, const RunOptions& options)
      : file(of),
        folder(options.folder, options.begin),
        model(build_fem<D>(continuum_case(), load_fem_mesh(continuum_case(), folder.mesh(), folder.resumes()))),
        side(*model.stepper, coupled_surface(of, model.mesh()), coupling_rules(of.hybrid())),
        identity(identify(of.hybrid(), identify(continuum_case().fem(), mesh_hash(model.mesh())), {})),
        clocks(make_clocks(continuum_case().fem().time, model.step)),
        record(folder, continuum_case(), model, clocks),
        line(options) {
    parallel::limit_threads(static_cast<int>(model.mesh().elements.size()) / elements_per_thread);
  }

  const cases::CaseFile& continuum_case() const { return *file.hybrid().continuum; }

  const std::string& title() const { return continuum_case().fem().title; }
  static std::string method() { return "fem"; }
  static std::string warning() { return ""; }
  std::string words() const {
    return fmt::format("{} elements, {} freedoms, step {} s, the bodies in another program", model.mesh().elements.size(),
                       model.stepper->free_freedoms(), cases::short_number(model.step, 4));
  }
  Real checkpoint_interval() const { return file.hybrid().output.checkpoint_interval; }

  bool start() {
    if (continuum_case().fem().gravity.settle) model.stepper->settle();
    model.stepper->start();
    line.open();
    side.start(line.channel().open(side.shape()));
    line.mark();
    return true;
  }

  /// A window that the partner does not answer is given up as a whole.
  void advance() {
    const engine::ContinuumSide<D> side_before = side;
    const engine::FemState<D> state_before = model.stepper->state();
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
  }
  std::int64_t step() const { return side.ledger().windows; }
  static bool must_check() { return true; }
  void collect() {}
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

  void checkpoint_made() { line.checkpoint_made(); }
  void part(coupling::Farewell reason, const std::string& words) { line.part(reason, step(), words); }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::span<const engine::PartTime> part_times() const { return side_times.parts; }
  auto more_figures() const { return line.figures(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(continuum_case().fem(), folder.path()));
  }
  void write_end() { line.channel().close(); }
  void write_rank_times() {}
};

}  // namespace

std::unique_ptr<LiveRun> open_continuum(const cases::CaseFile& file, const RunOptions& options) {
  if (file.hybrid().continuum->fem().mesh.dimension == 2) return std::make_unique<CaseRun<ContinuumWork<2>>>(file, options);
  return std::make_unique<CaseRun<ContinuumWork<3>>>(file, options);
}

}  // namespace sazare::runs
