#include "sazare/methods/blocks/run/run.hpp"

#include "sazare/cases/format/counted.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/blocks/run/blasting/holes_file.hpp"
#include "sazare/methods/blocks/run/check/stability.hpp"
#include "sazare/methods/blocks/run/identity.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/methods/blocks/run/record.hpp"
#include "sazare/methods/blocks/run/rows/motion_rows.hpp"
#include "sazare/methods/blocks/run/rows/rank_times.hpp"
#include "sazare/methods/blocks/run/start/relax.hpp"
#include "sazare/methods/blocks/run/state_hash.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"

namespace sazare::runs {

namespace {

constexpr Index elements_per_thread = 4000;        // with fewer a second thread takes more time than it saves (measured)
constexpr std::int64_t motion_check_steps = 8;     // a failing motion grows by some orders of magnitude in a step
constexpr std::int64_t motion_check_ticks = 1024;  // more than a base step has, but where levels grow very deep

/// The part of method blocks in a run, see CaseRun.
struct BlocksWork final : WorkDefaults {
  const cases::CaseFile& file;
  const RunOptions& options;
  RunTimes times;
  RunFolder folder;
  BlocksModel model;
  RunIdentity identity;
  RunClocks clocks;
  RunRecord record;

  BlocksWork(const cases::CaseFile& of, const RunOptions& with)
      : file(of),
        options(with),
        folder(enter_folder()),
        model(make_model()),
        identity(identify(of.as<cases::BlocksCase>(), model.mesh)),
        clocks(make_clocks(of, of.as<cases::BlocksCase>().time, "base_step", simulation().levels().step(0))),
        record(folder, of, model, clocks) {
    parallel::limit_threads(simulation().bodies().size() / elements_per_thread);
  }

  /// Other processes come when the first one has made the folder and the mesh.
  RunFolder enter_folder() const {
    if (is_writer(options)) return {options.folder, options.begin};
    options.sharing.ranks->barrier();
    return RunFolder::of_another(options.folder, options.begin);
  }

  /// What only the making takes is given back before the run needs as much for its snapshots.
  BlocksModel make_model() const {
    give_back_large_tables();
    return build_blocks(file.as<cases::BlocksCase>(), mesh(),
                        {.sharing = options.sharing, .takes_forces = options.takes_forces && options.sharing.ranks == nullptr});
  }

  geometry::TetraMesh mesh() const {
    geometry::TetraMesh loaded = load_mesh(file, folder.mesh(), folder.resumes() || !is_writer(options));
    if (options.sharing.ranks == nullptr) return loaded;
    if (is_writer(options)) options.sharing.ranks->barrier();
    options.sharing.ranks->barrier();  // now all have read it, and it may be given another name
    return loaded;
  }

  levels::Simulation<3>& simulation() { return *model.simulation; }
  const levels::Simulation<3>& simulation() const { return *model.simulation; }

  const std::string& title() const { return file.as<cases::BlocksCase>().title; }
  static std::string method() { return "blocks"; }
  std::string warning() const override { return warn_of(file, model); }
  std::string words() const {
    return fmt::format("{}, {}, base step {} s", cases::counted(simulation().bodies().size(), "elements"),
                       cases::counted(std::ssize(model.joints->links()), "joints"),
                       cases::short_number(simulation().levels().step(0), 4));
  }
  Real checkpoint_interval() const { return file.as<cases::BlocksCase>().output.checkpoint_interval; }

  bool settles() const { return file.as<cases::BlocksCase>().settles(); }

  bool start() {
    if (settles()) {
      if (!relax(file.as<cases::BlocksCase>(), model, options)) return false;
      if (options.warns && is_writer(options)) fmt::print(stderr, "{}", warn_of_relaxation(file, model));
    } else {
      simulation().start();
    }
    record.watch(step());
    return true;
  }
  bool advance(const Pause& pause) {
    const bool is_there = simulation().advance([&] {
      if (simulation().counters().ticks % motion_check_ticks == 0) record.check_motion(simulation().now().seconds());
      return options.sharing.ranks == nullptr && pause();
    });
    if (is_there) record.watch(step());
    return is_there;
  }
  std::int64_t step() const {
    const Instant now = simulation().now();
    return now.has_begun() ? (now.tick - now.start) / schedule::base_stride : 0;
  }
  bool must_check() const override {
    const bool mixed = simulation().levels().finest() > 0;  // then a base step is many
    return mixed || step() % motion_check_steps == 0;
  }
  void collect() override {
    simulation().collect();
    if (options.sharing.ranks != nullptr) record.unite(*options.sharing.ranks);
  }
  void survey() override { record.survey(step(), options.sharing.ranks); }
  bool takes_forces() const override { return model.outside_forces != nullptr; }
  bool takes_moments() const override { return true; }
  bool takes_forces_from_the_start() const override { return true; }
  void apply(std::span<const Vector3> forces) override { apply_forces(model, forces, {}); }
  void apply_with_moments(std::span<const Vector3> forces, std::span<const Vector3> moments) override {
    apply_forces(model, forces, moments);
  }
  void read_motion(MotionTable& table) const { read_bodies(simulation(), table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, simulation().counters().pair_evaluations, record.latest_smallest_step(), model.joints->broken_count()};
  }
  void columns(Archive& archive) {
    archive.folder("simulation", [&] { simulation().columns(archive); });
    if (!settles()) return;
    archive.folder("equilibrium", [&] {
      simulation().relaxation_columns(archive);
      archive("places", model.equilibrium);
    });
  }

  std::uint64_t state_hash() const { return runs::state_hash(model); }
  std::vector<levels::PartTime> part_times() const override { return simulation().part_times(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::BlocksCase>(), folder.path()));
  }
  void write_end() override {
    const auto& blocks = file.as<cases::BlocksCase>();
    if (!blocks.blasts.empty() || !blocks.charges.empty()) {
      write_holes(folder.holes(), blocks, model.mesh);
      record.write_half_casts();
    }
    record.write_fragments();
    record.write_gauge_peaks();
  }
  void write_rank_times() override { runs::write_rank_times(folder.ranks(), simulation()); }
};

}  // namespace

std::unique_ptr<LiveRun> open_blocks(const cases::CaseFile& file, const RunOptions& options) {
  return std::make_unique<CaseRun<BlocksWork>>(file, options);
}

}  // namespace sazare::runs
