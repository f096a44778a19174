#include <cmath>

#include "sazare/cases/resolved.hpp"
#include "sazare/coupling/surface_messages.hpp"
#include "sazare/engine/sphere_side.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/hybrid_model.hpp"
#include "sazare/runs/one_side.hpp"
#include "sazare/runs/run_case.hpp"
#include "sazare/runs/sphere_rain.hpp"
#include "sazare/runs/spheres_record.hpp"

namespace sazare::runs {

namespace {

constexpr int spheres_per_thread = 4000;  // see method spheres

/// Its steps are windows; those of the spheres are counted in the figures.
class BodiesRecord : public SpheresRecord {
public:
  BodiesRecord(const RunFolder& folder, const cases::CaseFile& file, SpheresModel& model, const RunClocks& clocks, Real window)
      : SpheresRecord(folder, file, model, clocks), steps_per_window_(std::llround(window / model.step)) {}

  auto results(std::int64_t windows, Real wall_seconds) const {
    return SpheresRecord::results(windows * steps_per_window_, wall_seconds);
  }

private:
  std::int64_t steps_per_window_;
};

/// The bodies of a hybrid case, see CaseRun. A step of the run is a window that the continuum has accepted.
struct BodiesWork {
  const cases::CaseFile& file;
  const RunOptions& options;
  RunTimes times;
  RunFolder folder;
  SpheresModel model;
  engine::SphereSide side;
  RunIdentity identity;
  RunClocks clocks;
  BodiesRecord record;
  PartnerLine<coupling::FileBodyChannel> line;
  SideTimes side_times{"bodies"};
  std::optional<coupling::SurfaceMotion> motion;  ///< the next one; none when the continuum has closed
  std::optional<coupling::Stopped> stopped;       ///< the continuum, after the last window

  BodiesWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        options(of_run),
        folder(of_run.folder, of_run.begin),
        model(build_spheres(bodies_case(), window())),
        side(*model.stepper, surface_material(of.hybrid())),
        identity(identify(of.hybrid(), {}, identify(bodies_case().spheres(), observe::to_hex(model.start)))),
        clocks(make_clocks(of.hybrid().continuum->fem().time, window())),
        record(folder, bodies_case(), model, clocks, window()),
        line(of_run) {
    parallel::limit_threads(static_cast<int>(model.group.size()) / spheres_per_thread);
  }

  const cases::CaseFile& bodies_case() const { return *file.hybrid().bodies; }
  Real window() const { return *file.hybrid().continuum->fem().time.step; }

  const std::string& title() const { return bodies_case().spheres().title; }
  static std::string method() { return "spheres"; }
  static std::string warning() { return ""; }
  std::string words() const {
    return fmt::format("{} spheres, windows of {} s, step {} s, the continuum in another program", model.group.size(),
                       cases::short_number(window(), 4), cases::short_number(model.step, 4));
  }
  Real checkpoint_interval() const { return file.hybrid().output.checkpoint_interval; }

  bool start() {
    attach();
    if (!let_rain(bodies_case().spheres(), model, options)) return false;
    line.channel().answer(side.start());
    line.mark();
    motion = line.channel().receive();
    return true;
  }

  /// Joins the continuum and takes its surface.
  void attach() {
    line.open();
    const coupling::SurfaceShape shape = line.channel().open();
    coupling::SurfaceShape expected = shape;
    expected.window = window();
    expected.dimension = file.hybrid().continuum->fem().mesh.dimension;
    if (expected.dimension == 2) expected.width = file.hybrid().surface.width;
    coupling::check_same(expected, shape, file.path.string());
    side.attach(shape);
  }

  /// Goes through a window as often as the continuum asks for it. One of which it is not known whether it was accepted is taken
  /// back.
  void advance() {
    if (stopped) throw coupling::Stopped(*stopped);
    if (!motion)
      throw UserError(fmt::format("{}: the continuum has ended its run at t = {} s, before the end of this case",
                                  file.path.string(), cases::short_number(clocks.time(step()))));
    const Real before = times.now(), transport = line.transport();
    const std::int64_t window = side.windows();
    Real waited = 0;
    try {
      do {
        const coupling::SurfaceForce force = side.answer(*motion);
        const Real answered = times.now();
        line.channel().answer(force);
        motion = line.channel().receive();
        waited += times.now() - answered;
      } while (motion && motion->window == window);
    } catch (const coupling::Stopped& stop) {
      motion.reset();
      if (!stop.by_partner || stop.window <= window) {
        side.take_back();
        throw;
      }
      stopped.emplace(stop);
    }
    line.mark();
    side_times.add(times.now() - before, waited, line.transport() - transport);
  }
  std::int64_t step() const { return side.windows(); }
  static bool must_check() { return true; }
  void collect() {}
  void read_motion(MotionTable& table) { read_spheres(*model.stepper, table); }

  ProgressState progress(Real share, Real time) const {
    const std::int64_t steps = step() * side.steps_per_window();
    return {share, time, steps * static_cast<std::int64_t>(model.group.size()), model.step, -1, "particle-steps"};
  }

  /// The surface first: it has a place among the spheres' columns.
  void columns(Archive& archive) {
    archive.folder("exchange", [&] { line.columns(archive); });
    if (archive.reading()) attach();
    archive.folder("side", [&] { side.columns(archive); });
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
    if (archive.reading()) motion = line.channel().receive();
  }

  void checkpoint_made() { line.checkpoint_made(); }
  void part(coupling::Farewell reason, const std::string& words) { line.part(reason, step(), words); }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::span<const engine::PartTime> part_times() const { return side_times.parts; }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(bodies_case().spheres(), folder.path()));
  }
  void write_end() { record.write_fragments(); }
  void write_rank_times() {}
};

}  // namespace

std::unique_ptr<LiveRun> open_bodies(const cases::CaseFile& file, const RunOptions& options) {
  return std::make_unique<CaseRun<BodiesWork>>(file, options);
}

}  // namespace sazare::runs
