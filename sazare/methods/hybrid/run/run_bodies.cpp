#include <cmath>

#include "sazare/coupling/surface_messages.hpp"
#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/methods/hybrid/run/coupled_bodies.hpp"
#include "sazare/methods/hybrid/run/identity.hpp"
#include "sazare/methods/hybrid/case/continuum.hpp"
#include "sazare/methods/hybrid/run/model.hpp"
#include "sazare/methods/hybrid/run/one_side.hpp"
#include "sazare/methods/hybrid/run/run.hpp"
#include "sazare/runs/case_run.hpp"

namespace sazare::runs {

namespace {

/// The record of the bodies' side alone. The steps of such a run are windows; those of the bodies are counted in the figures.
template <class Record>
class BodiesRecord : public Record {
public:
  template <class Model>
  BodiesRecord(const RunFolder& folder, const cases::CaseFile& file, Model& model, const RunClocks& clocks, Real window,
               Real step)
      : Record(folder, file, model, clocks), steps_per_window_(std::llround(window / step)) {}

  auto results(std::int64_t windows, Real wall_seconds) { return Record::results(windows * steps_per_window_, wall_seconds); }

private:
  std::int64_t steps_per_window_;
};

/// The bodies of a hybrid case, see CaseRun. A step of the run is a window that the continuum has accepted.
template <class Bodies>
struct BodiesWork final : WorkDefaults {
  const cases::CaseFile& file;
  const RunOptions& options;
  RunTimes times;
  RunFolder folder;
  Bodies bodies;
  RunIdentity identity;
  RunClocks clocks;
  BodiesRecord<typename Bodies::Record> record;
  PartnerLine<coupling::FileBodyChannel> line;
  SideTimes side_times{"bodies"};
  std::optional<coupling::SurfaceMotion> motion;  ///< the next one; none when the continuum has closed
  std::optional<coupling::Stopped> stopped;       ///< the continuum, after the last window

  BodiesWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        options(of_run),
        folder(of_run.folder, of_run.begin),
        bodies(BodiesSetting{of.as<cases::HybridCase>(), window(), true, folder.mesh(), folder.resumes()}),
        identity(identify(of.as<cases::HybridCase>(), {}, bodies.identity())),
        clocks(make_clocks(cases::continuum_of(of.as<cases::HybridCase>()).time, window())),
        record(folder, bodies.file, bodies.model, clocks, window(), bodies.step()),
        line(of_run) {
    parallel::limit_threads(static_cast<int>(bodies.count() / Bodies::per_thread));
  }

  Real window() const { return *cases::continuum_of(file.as<cases::HybridCase>()).time.step; }

  const std::string& title() const { return bodies.title(); }
  static std::string method() { return Bodies::method; }
  std::string warning() const override { return bodies.warning(); }
  std::string words() const {
    return fmt::format("{} {}, windows of {} s, step {} s, the continuum in another program", bodies.count(), Bodies::name,
                       cases::short_number(window(), 4), cases::short_number(bodies.step(), 4));
  }
  Real checkpoint_interval() const { return file.as<cases::HybridCase>().output.checkpoint_interval; }

  bool start() {
    attach();
    if (!bodies.prepare(options)) return false;
    line.channel().answer(bodies.side.start());
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
    expected.dimension = cases::continuum_of(file.as<cases::HybridCase>()).mesh.dimension;
    if (expected.dimension == 2) expected.width = surface_width(file.as<cases::HybridCase>());
    coupling::check_same(expected, shape, file.path.string());
    bodies.side.attach(shape);
  }

  /// Goes through a window as often as the continuum asks for it. One of which it is not known whether it was accepted is taken
  /// back.
  bool advance(const Pause&) {
    if (stopped) throw coupling::Stopped(*stopped);
    if (!motion)
      throw UserError(fmt::format("{}: the continuum ended its run at t = {} s, before the end of this case",
                                  file.path.string(), cases::short_number(clocks.time(step()))));
    const Real before = times.now(), exchanged = line.cost().seconds;
    const std::int64_t window = bodies.side.windows();
    Real waited = 0;
    try {
      do {
        const coupling::SurfaceForce force = bodies.side.answer(*motion);
        const Real answered = times.now();
        line.channel().answer(force);
        motion = line.channel().receive();
        waited += times.now() - answered;
      } while (motion && motion->window == window);
    } catch (const coupling::Stopped& stop) {
      motion.reset();
      if (!stop.by_partner || stop.window <= window) {
        bodies.side.take_back();
        throw;
      }
      stopped.emplace(stop);
    }
    line.mark();
    side_times.add(times.now() - before, waited, line.cost().seconds - exchanged);
    return true;
  }
  std::int64_t step() const { return bodies.side.windows(); }
  void read_motion(MotionTable& table) { bodies.read_motion(table); }

  ProgressState progress(Real share, Real time) const {
    const std::int64_t steps = step() * bodies.side.steps_per_window();
    return {share, time, steps * bodies.count(), bodies.step(), -1, Bodies::evaluated};
  }

  /// The surface first: it has a place among the bodies' columns.
  void columns(Archive& archive) {
    archive.folder("exchange", [&] { line.columns(archive); });
    if (archive.reading()) attach();
    archive.folder("side", [&] { bodies.side.columns(archive); });
    archive.folder("stepper", [&] { bodies.columns(archive); });
    if (archive.reading()) motion = line.channel().receive();
  }

  bool has_partner() const override { return true; }
  void checkpoint_made() override { line.checkpoint_made(); }
  void part(coupling::Farewell reason, const std::string& words) override { line.part(reason, step(), words); }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::vector<levels::PartTime> part_times() const override { return {side_times.parts.begin(), side_times.parts.end()}; }
  std::vector<std::pair<std::string, observe::Figure>> more_figures() const override { return line.figures(); }
  void write_case() const { bodies.write_case(folder); }
  void write_end() override {
    if constexpr (requires { record.write_fragments(); }) record.write_fragments();
  }
};

}  // namespace

std::unique_ptr<LiveRun> open_bodies(const cases::CaseFile& file, const RunOptions& options) {
  return visit_bodies(file.as<cases::HybridCase>(), [&]<class Bodies>(std::type_identity<Bodies>) {
    return std::unique_ptr<LiveRun>(std::make_unique<CaseRun<BodiesWork<Bodies>>>(file, options));
  });
}

}  // namespace sazare::runs
