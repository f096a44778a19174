#include "sazare/cases/resolved.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/hybrid_model.hpp"
#include "sazare/runs/hybrid_record.hpp"
#include "sazare/runs/run_case.hpp"
#include "sazare/runs/sphere_rain.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

constexpr int elements_per_thread = 500, spheres_per_thread = 4000;  // see the methods alone

std::string number(Real value, int digits = 4) { return cases::short_number(value, digits); }

/// Measures how long the bodies take.
class TimedChannel final : public coupling::ContinuumChannel {
public:
  TimedChannel(engine::BodySide& bodies, RunTimes& times, engine::PartTime& part)
      : channel_(bodies), times_(&times), part_(&part) {}

  coupling::SurfaceForce open(const coupling::SurfaceShape& shape) override { return channel_.open(shape); }
  coupling::SurfaceForce exchange(const coupling::SurfaceMotion& motion) override {
    const Real before = times_->now();
    coupling::SurfaceForce force = channel_.exchange(motion);
    part_->seconds += times_->now() - before;
    return force;
  }
  void close() override { channel_.close(); }

private:
  engine::DirectChannel channel_;
  RunTimes* times_;
  engine::PartTime* part_;
};

/// The folder of a side: as of a run alone, but for the checkpoint, which both have together.
RunFolder side_folder(const RunFolder& whole, const char* name, Begin begin) {
  const auto path = whole.path() / name;
  if (begin != Begin::resume) RunFolder(path, begin).remove_checkpoint();
  return RunFolder::of_another(path, begin);
}

/// The two sides of a case, ready to begin or to be resumed.
template <int D>
struct HybridModel {
  FemModel<D> continuum;
  SpheresModel bodies;
  engine::SphereSide body_side;
  engine::ContinuumSide<D> continuum_side;

  HybridModel(const cases::CaseFile& file, geometry::ElementMesh mesh)
      : continuum(build_fem<D>(*file.hybrid().continuum, std::move(mesh))),
        bodies(build_spheres(*file.hybrid().bodies, continuum.step)),
        body_side(*bodies.stepper, surface_material(file.hybrid())),
        continuum_side(*continuum.stepper, coupled_surface(file, continuum.mesh()), coupling_rules(file.hybrid())) {}

  /// Points at the case where the surface does not suit the bodies.
  void attach(const cases::CaseFile& file) {
    try {
      body_side.attach(continuum_side.shape());
    } catch (const UserError& error) {
      refuse(file, "surface.group", error.what(), "look at where the bodies begin, at the group and at the units of the mesh");
    }
  }
};

/// The part of method hybrid in a run, see CaseRun. A step of the run is a window.
template <int D>
struct HybridWork {
  const cases::CaseFile& file;
  const RunOptions& options;
  RunTimes times;
  RunFolder folder, continuum_folder, bodies_folder;
  HybridModel<D> model;
  RunIdentity identity;
  RunClocks clocks;
  HybridRecord<D> record;
  std::array<engine::PartTime, 2> parts{{{"finite elements", 0}, {"bodies", 0}}};
  std::string started = observe::time_of_day();

  HybridWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        options(of_run),
        folder(of_run.folder, of_run.begin),
        continuum_folder(side_folder(folder, "continuum", of_run.begin)),
        bodies_folder(side_folder(folder, "bodies", of_run.begin)),
        model(of, load_fem_mesh(continuum_case(), continuum_folder.mesh(), folder.resumes())),
        identity(identify(of.hybrid(), identify(continuum_case().fem(), mesh_hash(model.continuum.mesh())),
                          identify(bodies_case().spheres(), observe::to_hex(model.bodies.start)))),
        clocks(make_clocks(continuum_case().fem().time, model.continuum.step)),
        record({of, folder, continuum_folder, bodies_folder, model.continuum, model.bodies, model.continuum_side,
                steps_per_window()},
               clocks) {
    parallel::limit_threads(static_cast<int>(
        std::max(model.continuum.mesh().elements.size() / elements_per_thread, model.bodies.group.size() / spheres_per_thread)));
  }

  const cases::CaseFile& continuum_case() const { return *file.hybrid().continuum; }
  const cases::CaseFile& bodies_case() const { return *file.hybrid().bodies; }
  std::int64_t steps_per_window() const {
    return static_cast<std::int64_t>(std::round(model.continuum.step / model.bodies.step));
  }

  const std::string& title() const { return file.hybrid().title; }
  static std::string method() { return "hybrid"; }
  static std::string warning() { return ""; }
  std::string words() const {
    return fmt::format("{} elements and {} spheres, windows of {} s, {} steps of the spheres in each",
                       model.continuum.mesh().elements.size(), model.bodies.group.size(), number(model.continuum.step),
                       steps_per_window());
  }
  Real checkpoint_interval() const { return file.hybrid().output.checkpoint_interval; }

  bool start() {
    if (continuum_case().fem().gravity.settle) model.continuum.stepper->settle();
    model.continuum.stepper->start();
    model.attach(file);
    if (!let_rain(bodies_case().spheres(), model.bodies, options)) return false;
    model.continuum_side.start(model.body_side.start());
    return true;
  }
  void advance() {
    TimedChannel channel(model.body_side, times, parts[1]);
    const Real before = times.now(), of_bodies = parts[1].seconds;
    model.continuum_side.advance(channel);
    parts[0].seconds += times.now() - before - (parts[1].seconds - of_bodies);
  }
  std::int64_t step() const { return model.continuum_side.ledger().windows; }
  static bool must_check() { return true; }
  void collect() {}

  /// Nodes, then spheres.
  void read_motion(MotionTable& table) {
    MotionTable spheres;
    read_nodes(*model.continuum.stepper, table);
    read_spheres(*model.bodies.stepper, spheres);
    for (const auto& [all, more] :
         {std::pair{&table.position, &spheres.position}, {&table.velocity, &spheres.velocity}, {&table.force, &spheres.force}})
      all->insert(all->end(), more->begin(), more->end());
  }

  ProgressState progress(Real share, Real time) const {
    const auto spheres = static_cast<std::int64_t>(model.bodies.group.size());
    return {share,           time, model.continuum_side.ledger().passes * steps_per_window() * spheres, model.bodies.step, -1,
            "particle-steps"};
  }

  /// The finite elements first: the surface stands where they have settled.
  void columns(Archive& archive) {
    archive.folder("continuum", [&] { model.continuum.stepper->columns(archive); });
    archive.folder("continuum_side", [&] { model.continuum_side.columns(archive); });
    if (archive.reading()) model.attach(file);
    archive.folder("body_side", [&] { model.body_side.columns(archive); });
    archive.folder("bodies", [&] { model.bodies.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::span<const engine::PartTime> part_times() const { return parts; }

  void write_case() const {
    cases::HybridCase both = file.hybrid();
    both.sides = {continuum_folder.case_file(), bodies_folder.case_file()};
    observe::write_file(folder.case_file(), cases::write_resolved(both, folder.path()));
    observe::write_file(continuum_folder.case_file(), cases::write_resolved(continuum_case().fem(), continuum_folder.path()));
    observe::write_file(bodies_folder.case_file(), cases::write_resolved(bodies_case().spheres(), bodies_folder.path()));
    write_manifests("running");
  }
  void write_end() const {
    record.write_fragments();
    write_manifests("done");
  }
  void write_rank_times() {}

  void write_manifests(const std::string& status) const {
    observe::Manifest manifest;
    manifest.version = version;
    manifest.commit = commit;
    manifest.status = status;
    manifest.started = started;
    manifest.finished = status == "done" ? observe::time_of_day() : "";
    manifest.machine = observe::this_machine();
    record.write_manifests(manifest, step(), times.now());
  }
};

template <int D>
std::string check(const cases::CaseFile& file) {
  const TemporaryFolder folder;
  HybridModel<D> model(file, load_fem_mesh(*file.hybrid().continuum, folder.path() / "mesh.msh", false));
  model.attach(file);
  const RunClocks clocks = make_clocks(file.hybrid().continuum->fem().time, model.continuum.step);
  return cases::explain(file.hybrid()) +
         fmt::format("  {:<12}{} windows, {} steps of the spheres of {} s in each\n", "work", clocks.steps(),
                     model.body_side.steps_per_window(), number(model.bodies.step, 5)) +
         "\n" + check_fem(*file.hybrid().continuum) + "\n" + check_spheres(*file.hybrid().bodies);
}

}  // namespace

std::unique_ptr<LiveRun> open_hybrid(const cases::CaseFile& file, const RunOptions& options) {
  if (options.one_side)
    return options.one_side->side == coupling::Side::continuum ? open_continuum(file, options) : open_bodies(file, options);
  if (file.hybrid().continuum->fem().mesh.dimension == 2) return std::make_unique<CaseRun<HybridWork<2>>>(file, options);
  return std::make_unique<CaseRun<HybridWork<3>>>(file, options);
}

std::string check_hybrid(const cases::CaseFile& file) {
  return file.hybrid().continuum->fem().mesh.dimension == 2 ? check<2>(file) : check<3>(file);
}

}  // namespace sazare::runs
