#include "sazare/methods/hybrid/run/run.hpp"

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/methods/hybrid/case/format.hpp"
#include "sazare/methods/hybrid/run/continuum.hpp"
#include "sazare/methods/hybrid/run/coupled_bodies.hpp"
#include "sazare/methods/hybrid/run/identity.hpp"
#include "sazare/methods/hybrid/run/model.hpp"
#include "sazare/methods/hybrid/run/record.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

using cases::line, cases::number;

/// Measures how long the bodies take.
class TimedChannel final : public coupling::ContinuumChannel {
public:
  TimedChannel(methods::hybrid::BodySide& bodies, RunTimes& times, levels::PartTime& part)
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
  methods::hybrid::DirectChannel channel_;
  RunTimes* times_;
  levels::PartTime* part_;
};

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<Real>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// The two sides of a case, ready to begin or to be resumed.
template <int D, class Bodies>
struct HybridModel {
  ContinuumModel<D> continuum;
  Bodies bodies;
  methods::hybrid::ContinuumSide<D> continuum_side;

  HybridModel(const cases::CaseFile& file, geometry::ElementMesh mesh, const std::filesystem::path& mesh_of_bodies,
              bool keeps_mesh, bool takes_forces)
      : continuum(build_continuum<D>(*file.as<cases::HybridCase>().continuum, std::move(mesh))),
        bodies(BodiesSetting{file.as<cases::HybridCase>(), continuum.step, repeats(file.as<cases::HybridCase>()), mesh_of_bodies,
                             keeps_mesh, takes_forces}),
        continuum_side(*continuum.stepper, coupled_surface(file, continuum.mesh()),
                       coupling_rules(file.as<cases::HybridCase>())) {}

  /// Points at the case where the surface does not suit the bodies.
  void attach(const cases::CaseFile& file) {
    try {
      bodies.side.attach(continuum_side.shape());
    } catch (const UserError& error) {
      refuse(file, "surface.group", error.what(),
             "check the initial positions of the bodies, the group and the units of the mesh");
    }
  }
};

/// The part of method hybrid in a run, see CaseRun. A step of the run is a window.
template <int D, class Bodies>
struct HybridWork final : WorkDefaults {
  const cases::CaseFile& file;
  const RunOptions& options;
  RunTimes times;
  RunFolder folder, continuum_folder, bodies_folder;
  HybridModel<D, Bodies> model;
  RunIdentity identity;
  RunClocks clocks;
  HybridRecord<D, Bodies> record;
  std::array<levels::PartTime, 2> parts{{{"finite elements", 0}, {"bodies", 0}}};
  std::string started = observe::time_of_day();

  HybridWork(const cases::CaseFile& of, const RunOptions& of_run)
      : file(of),
        options(of_run),
        folder(of_run.folder, of_run.begin),
        continuum_folder(RunFolder::of_side(folder, "continuum", of_run.begin)),
        bodies_folder(RunFolder::of_side(folder, "bodies", of_run.begin)),
        model(of, load_continuum_mesh(continuum_case(), continuum_folder.mesh(), folder.resumes()), bodies_folder.mesh(),
              folder.resumes(), of_run.takes_forces),
        identity(identify(of.as<cases::HybridCase>(), identify(continuum_content(), mesh_hash(model.continuum.mesh())),
                          model.bodies.identity())),
        clocks(make_clocks(continuum_case(), continuum_content().time, "step", model.continuum.step)),
        record({of, folder, continuum_folder, bodies_folder, model.continuum, model.bodies, model.continuum_side,
                steps_per_window()},
               clocks) {
    parallel::limit_threads(static_cast<int>(
        std::max<std::int64_t>(static_cast<std::int64_t>(model.continuum.mesh().elements.size()) / continuum_elements_per_thread,
                               model.bodies.count() / Bodies::per_thread)));
  }

  const cases::CaseFile& continuum_case() const { return *file.as<cases::HybridCase>().continuum; }
  const cases::ContinuumCase& continuum_content() const { return cases::continuum_of(file.as<cases::HybridCase>()); }
  std::int64_t steps_per_window() const {
    return static_cast<std::int64_t>(std::round(model.continuum.step / model.bodies.step()));
  }

  const std::string& title() const { return file.as<cases::HybridCase>().title; }
  static std::string method() { return "hybrid"; }
  std::string warning() const override { return model.bodies.warning(); }
  std::string words() const {
    const auto elements = static_cast<std::int64_t>(model.continuum.mesh().elements.size());
    return fmt::format("{} and {}, windows of {} s, {} of the {} in each", cases::counted(elements, "finite elements"),
                       cases::counted(model.bodies.count(), Bodies::name), number(model.continuum.step),
                       cases::counted(steps_per_window(), "steps"), Bodies::name);
  }
  Real checkpoint_interval() const { return file.as<cases::HybridCase>().output.checkpoint_interval; }

  bool start() {
    const bool rests = continuum_content().gravity.settle;
    const auto unloaded = model.continuum.stepper->state();
    if (rests) model.continuum.stepper->relax();
    model.attach(file);
    if (!model.bodies.prepare(options)) return false;
    if constexpr (requires { model.bodies.settles(); })
      if (rests && model.bodies.settles() && !settle_together(unloaded)) return false;
    model.continuum.stepper->start();
    model.continuum_side.start(model.bodies.side.start());
    return true;
  }

  /// The equilibrium of both sides: that of the continuum under a force, and that of the bodies on the surface where it then
  /// stands, until the force of the bodies is that one. The force grows from none by shares of what it lacks, which follow from
  /// the last two turns (Aitken's relaxation), so that a surface which yields is approached from one side. False when asked to
  /// stop.
  bool settle_together(const methods::hybrid::ContinuumState<D>& unloaded) {
    constexpr Real first_share = 0.1, least_share = 0.02, tolerance = 1e-3;
    constexpr int most_turns = 60;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(vector_of(model.bodies.side.force().last).size()), lack_before;
    Real share = first_share;
    for (int turn = 0; turn < most_turns; ++turn) {
      const std::vector<Real> found = model.bodies.side.force().last;
      const Eigen::VectorXd lack = vector_of(found) - force;
      if (lack.norm() <= tolerance * vector_of(found).norm()) return model.bodies.prepare(options);
      if (turn > 0) {
        const Eigen::VectorXd change = lack - lack_before;
        share = std::clamp(-share * lack_before.dot(change) / change.squaredNorm(), least_share, Real{1});
      }
      lack_before = lack;
      force += share * lack;
      model.continuum.stepper->restore(unloaded);
      model.continuum.stepper->relax(model.continuum_side.on_nodes({force.begin(), force.end()}));
      model.bodies.side.move_to(model.continuum_side.shape());
      if (!model.bodies.prepare(options, Rest::nearly)) return false;
    }
    throw PhysicsError(fmt::format(
        "no equilibrium of both sides: after {} turns the forces on the surface still differ by more than {} of them\n"
        "  is the continuum held, and the ground stable? Without settle on one side, both begin as they are",
        most_turns, cases::short_number(tolerance)));
  }
  bool advance(const Pause&) {
    TimedChannel channel(model.bodies.side, times, parts[1]);
    const Real before = times.now(), of_bodies = parts[1].seconds;
    model.continuum_side.advance(channel);
    parts[0].seconds += times.now() - before - (parts[1].seconds - of_bodies);
    return true;
  }
  std::int64_t step() const { return model.continuum_side.totals().windows; }

  bool takes_forces() const override { return true; }
  bool takes_forces_from_the_start() const override { return std::is_same_v<Bodies, CoupledBlocks>; }
  /// On nodes, then on bodies.
  void apply(std::span<const Vector3> forces) override {
    const std::size_t nodes = model.continuum.mesh().nodes.size();
    methods::hybrid::NodalColumn column;
    for (const Vector3& force : forces.first(nodes)) column.insert(column.end(), force.data(), force.data() + D);
    model.continuum_side.push(std::move(column));
    model.bodies.apply(forces.subspan(nodes));
  }
  /// Nodes, then bodies.
  void read_motion(MotionTable& table) {
    MotionTable bodies;
    read_nodes(*model.continuum.stepper, table);
    model.bodies.read_motion(bodies);
    for (const auto& [all, more] :
         {std::pair{&table.position, &bodies.position}, {&table.velocity, &bodies.velocity}, {&table.force, &bodies.force}})
      all->insert(all->end(), more->begin(), more->end());
  }

  ProgressState progress(Real share, Real time) const {
    const std::int64_t steps = model.continuum_side.totals().passes * steps_per_window() * model.bodies.count();
    return {share, time, steps, model.bodies.step(), -1, Bodies::evaluated};
  }

  /// The finite elements first: the surface has their equilibrium position.
  void columns(Archive& archive) {
    archive.folder("continuum", [&] { model.continuum.stepper->columns(archive); });
    archive.folder("continuum_side", [&] { model.continuum_side.columns(archive); });
    if (archive.reading()) model.attach(file);
    archive.folder("body_side", [&] { model.bodies.side.columns(archive); });
    archive.folder("bodies", [&] { model.bodies.columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  std::vector<levels::PartTime> part_times() const override { return {parts.begin(), parts.end()}; }

  void write_case() {
    for (RunFolder* side : {&continuum_folder, &bodies_folder}) {
      side->clear();
      side->remove_checkpoint();
    }
    cases::HybridCase both = file.as<cases::HybridCase>();
    both.sides = {continuum_folder.case_file(), bodies_folder.case_file()};
    observe::write_file(folder.case_file(), cases::write_resolved(both, folder.path()));
    observe::write_file(continuum_folder.case_file(), cases::write_resolved(continuum_content(), continuum_folder.path()));
    model.bodies.write_case(bodies_folder);
    write_manifests("running");
  }
  void write_end() override {
    record.write_end();
    write_manifests("done");
  }

  void write_manifests(const std::string& status) {
    observe::Manifest manifest = observe::new_manifest();
    manifest.status = status;
    manifest.started = started;
    manifest.finished = status == "done" ? observe::time_of_day() : "";
    record.write_manifests(manifest, step(), times.now());
  }
};

template <int D, class Bodies>
std::string check(const cases::CaseFile& file, const std::filesystem::path& folder) {
  HybridModel<D, Bodies> model(file, load_continuum_mesh(*file.as<cases::HybridCase>().continuum, folder / "mesh.msh", false),
                               folder / "bodies.msh", false, false);
  model.attach(file);
  const auto& hybrid = file.as<cases::HybridCase>();
  const RunClocks clocks = make_clocks(*hybrid.continuum, cases::continuum_of(hybrid).time, "step", model.continuum.step);
  return cases::explain(file.as<cases::HybridCase>()) +
         line("work", fmt::format("{} windows, {} steps of the {} of {} s in each", clocks.steps(),
                                  model.bodies.side.steps_per_window(), Bodies::name, number(model.bodies.step(), 5)));
}

/// Calls `visit` with the dimension and the bodies of a case, and hands back what it gives. The case has been checked: bodies
/// that do not meet a continuum of one dimension meet one of the other.
template <class Visit>
auto visit_sides(const cases::HybridCase& hybrid, const Visit& visit) {
  return visit_bodies(hybrid, [&]<class Bodies>(std::type_identity<Bodies> bodies) {
    if constexpr (!Bodies::meets(2))
      return visit(std::integral_constant<int, 3>{}, bodies);
    else {
      if constexpr (Bodies::meets(3))
        if (cases::continuum_of(hybrid).mesh.dimension == 3) return visit(std::integral_constant<int, 3>{}, bodies);
      return visit(std::integral_constant<int, 2>{}, bodies);
    }
  });
}

}  // namespace

std::unique_ptr<LiveRun> open_hybrid(const cases::CaseFile& file, const RunOptions& options) {
  if (options.one_side)
    return options.one_side->side == coupling::Side::continuum ? open_continuum(file, options) : open_bodies(file, options);
  return visit_sides(file.as<cases::HybridCase>(),
                     [&]<int D, class Bodies>(std::integral_constant<int, D>, std::type_identity<Bodies>) {
                       return std::unique_ptr<LiveRun>(std::make_unique<CaseRun<HybridWork<D, Bodies>>>(file, options));
                     });
}

std::string check_hybrid(const cases::CaseFile& file) {
  const auto& hybrid = file.as<cases::HybridCase>();
  const std::string both = visit_sides(
      file.as<cases::HybridCase>(), [&]<int D, class Bodies>(std::integral_constant<int, D>, std::type_identity<Bodies>) {
        return check_with_meshes([&](const std::filesystem::path& folder) { return check<D, Bodies>(file, folder); });
      });
  return both + "\n" + check_continuum(*hybrid.continuum) + "\n" + check_bodies(hybrid);
}

}  // namespace sazare::runs
