#include "sazare/methods/fem/run/run.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "sazare/cases/explanation.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/motion_peaks.hpp"
#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/fem/run/held.hpp"
#include "sazare/methods/fem/run/identity.hpp"
#include "sazare/methods/fem/run/incident_wave.hpp"
#include "sazare/methods/fem/run/motion_rows.hpp"
#include "sazare/methods/fem/run/record.hpp"
#include "sazare/methods/fem/run/sides.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/runs/case_run.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

using cases::line, cases::number;

/// The part of method fem in a run, see CaseRun.
template <int D>
struct FemWork final : WorkDefaults {
  const cases::CaseFile& file;
  RunTimes times;
  RunFolder folder;
  FemModel<D> model;
  RunIdentity identity;
  RunClocks clocks;
  FemRecord<D> record;

  FemWork(const cases::CaseFile& of, const RunOptions& options)
      : file(of),
        folder(options.folder, options.begin),
        model(build_fem<D>(of, load_fem_mesh(of, folder.mesh(), folder.resumes()))),
        identity(identify(of.as<cases::FemCase>(), mesh_hash(model.mesh()))),
        clocks(make_clocks(of, of.as<cases::FemCase>().time, "step", model.step)),
        record(folder, of, model, clocks) {
    parallel::limit_threads(static_cast<int>(model.mesh().elements.size()) / fem_elements_per_thread);
  }

  const std::string& title() const { return file.as<cases::FemCase>().title; }
  static std::string method() { return "fem"; }
  std::string warning() const override { return model.warnings; }
  std::string words() const {
    return fmt::format("{}, {} degrees of freedom, step {} s", cases::counted(std::ssize(model.mesh().elements), "elements"),
                       model.stepper->free_freedoms(), number(model.step));
  }
  Real checkpoint_interval() const { return file.as<cases::FemCase>().output.checkpoint_interval; }

  bool start() {
    if (file.as<cases::FemCase>().gravity.settle) model.stepper->relax();
    model.stepper->start();
    return true;
  }
  bool advance(const Pause&) {
    model.stepper->advance();
    return true;
  }
  std::int64_t step() const { return model.stepper->steps(); }
  bool takes_forces() const override { return true; }
  void apply(std::span<const Vector3> forces) override {
    methods::fem::NodalColumn column;
    for (const Vector3& force : forces) column.insert(column.end(), force.data(), force.data() + D);
    model.stepper->apply(std::move(column));
  }
  void read_motion(MotionTable& table) const { read_nodes(*model.stepper, table); }

  ProgressState progress(Real share, Real time) const {
    return {share, time, model.stepper->state().iterations, model.step, -1, "iterations"};
  }
  void columns(Archive& archive) {
    archive.folder("stepper", [&] { model.stepper->columns(archive); });
  }

  std::uint64_t state_hash() const { return record.state_hash(); }
  void write_case() const {
    observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::FemCase>(), folder.path()));
  }
};

/// The largest distance of two nodes of an element [m].
Real largest_element(const geometry::ElementMesh& mesh) {
  Real largest = 0;
  for (const geometry::MeshElement& element : mesh.elements)
    for (const Index one : element.node_list())
      for (const Index other : element.node_list())
        largest = std::max(largest, (mesh.nodes[at(one)] - mesh.nodes[at(other)]).norm());
  return largest;
}

/// Extent of the mesh, and the waves that it can follow.
std::string second_look(const cases::FemCase& fem, const geometry::ElementMesh& mesh) {
  std::string text = cases::explain_size(cases::extent_of(mesh.nodes));
  for (const cases::FemMaterial& of : fem.materials) {
    const auto material = methods::fem::SolidMaterial::elastic_of(of.youngs_modulus, of.poisson_ratio, of.density);
    text += cases::explain_waves(of.name, material.p_wave_velocity(), material.s_wave_velocity(), largest_element(mesh));
  }
  return text;
}

/// The resultant of each still water.
template <int D>
std::string water_lines(const methods::fem::FemStepper<D>& stepper) {
  std::string text;
  for (const auto& water : stepper.supports().waters) {
    Vector3 force = Vector3::Zero();
    force.head<D>() = water.force;
    const std::string mass_text =
        water.moving.empty() ? "" : fmt::format(", added mass {} {}", number(water.moving_mass()), D == 2 ? "kg/m" : "kg");
    text += line("water", fmt::format("{} wets {} {}, pressure {} {}{}", water.pressure.name, number(water.wet_area),
                                      D == 2 ? "m" : "m2", cases::vector_text(force), D == 2 ? "N/m" : "N", mass_text));
  }
  return text;
}

template <int D>
std::string warn_of_waves(const cases::CaseFile& file, const FemModel<D>& model) {
  const auto& fem = file.as<cases::FemCase>();
  if (fem.time.analysis == cases::Analysis::statics) return "";
  Real slowest = std::numeric_limits<Real>::infinity();
  for (const cases::FemMaterial& of : fem.materials)
    slowest = std::min(
        slowest, methods::fem::SolidMaterial::elastic_of(of.youngs_modulus, of.poisson_ratio, of.density).s_wave_velocity());
  return cases::warn_of_short_waves(file, fem.motions, fem.time.end, slowest, largest_element(model.mesh()));
}

/// An implicit step is stable, whatever it leaves of the motion.
std::string warn_of_long_steps(const cases::CaseFile& file, Real step) {
  constexpr Real fewest = 8, advised = 20;  // steps to a period
  const auto& fem = file.as<cases::FemCase>();
  if (fem.time.analysis == cases::Analysis::statics) return "";
  for (const cases::Motion& motion : fem.motions) {
    const auto peaks = cases::peaks_of(motion, fem.time.end);
    if (!peaks || !(peaks->velocity > 0)) continue;
    const Real frequency = peaks->acceleration / (2 * std::numbers::pi * peaks->velocity), steps = 1 / (frequency * step);
    if (!(steps < fewest)) continue;
    return cases::warning(
        file, "time.step",
        fmt::format("the motion \"{}\" of {} Hz or so has {} steps to a period, too few to follow it", motion.name,
                    number(frequency, 2), number(steps, 2)),
        fmt::format("take {} s or less, and look whether half of it changes the answer", number(1 / (advised * frequency), 2)));
  }
  return "";
}

template <int D>
std::string check(const cases::CaseFile& file, const std::filesystem::path& folder) {
  const FemModel<D> model = build_fem<D>(file, load_fem_mesh(file, folder / "mesh.msh", false));
  const RunClocks clocks = make_clocks(file, file.as<cases::FemCase>().time, "step", model.step);
  const auto& body = model.stepper->body();
  return cases::explain(file.as<cases::FemCase>()) +
         line("body", fmt::format("{}, {}, {}", cases::counted(std::ssize(model.mesh().nodes), "nodes"),
                                  cases::counted(std::ssize(model.mesh().elements), "elements"),
                                  cases::counted(std::ssize(body.joints()), "joints"))) +
         line("mass", cases::mass_text(body.total_mass(), D == 2)) + side_lines(model.stepper->supports(), model.group_names) +
         incident_wave_line(model.stepper->supports()) + water_lines(*model.stepper) +
         second_look(file.as<cases::FemCase>(), model.mesh()) + held_text(model, file.as<cases::FemCase>().time.end) +
         line("work", fmt::format("{} degrees of freedom, {} equations", model.stepper->free_freedoms(),
                                  body.is_symmetric() ? "symmetric" : "unsymmetric")) +
         line("", fmt::format("{} steps, {} per history row", clocks.steps(), clocks.steps_per_row)) +
         cases::warn_of_size(file, cases::extent_of(model.mesh().nodes)) + warn_of_waves(file, model) +
         warn_of_long_steps(file, model.step) + model.warnings;
}

}  // namespace

std::unique_ptr<LiveRun> open_fem(const cases::CaseFile& file, const RunOptions& options) {
  if (file.as<cases::FemCase>().mesh.dimension == 2) return std::make_unique<CaseRun<FemWork<2>>>(file, options);
  return std::make_unique<CaseRun<FemWork<3>>>(file, options);
}

std::string check_fem(const cases::CaseFile& file) {
  return check_with_meshes([&](const std::filesystem::path& folder) {
    return file.as<cases::FemCase>().mesh.dimension == 2 ? check<2>(file, folder) : check<3>(file, folder);
  });
}

}  // namespace sazare::runs
