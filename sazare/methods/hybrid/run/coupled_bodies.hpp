#pragma once

/// The bodies of a hybrid case, method by method: what a run of both sides, or of the bodies alone, needs of them.
///
/// Each has the members
///
///     Record                            what it writes down, see RunRecord
///     method, name                      as a case calls the method, and as words call its bodies
///     count_key, steps_key, evaluated   of figures and progress
///     per_thread                        bodies that keep a thread busy, see the method alone
///     meets(dimension)                  whether they may meet a continuum of that dimension
///     model, side                       the bodies, and their side of the coupling
///     count(), step()                   how many there are, and their own step [s]
///     prepare(options)                  what comes before the windows; false when asked to stop meanwhile
///     warning()                         see CaseRun
///     identity(), title(), write_case(folder)
///     apply(forces)                     from outside, a row for each body as read_motion has them
///     read_motion(table), columns(archive)

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/run/check/stability.hpp"
#include "sazare/methods/blocks/run/identity.hpp"
#include "sazare/methods/blocks/run/record.hpp"
#include "sazare/methods/blocks/run/rows/motion_rows.hpp"
#include "sazare/methods/hybrid/block_side.hpp"
#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/methods/hybrid/ground_side.hpp"
#include "sazare/methods/hybrid/rectangle_side.hpp"
#include "sazare/methods/hybrid/sphere_side.hpp"
#include "sazare/methods/mps/run/identity.hpp"
#include "sazare/methods/mps/run/record.hpp"
#include "sazare/methods/mps/run/settle.hpp"
#include "sazare/methods/rectangles/run/identity.hpp"
#include "sazare/methods/rectangles/run/record.hpp"
#include "sazare/methods/spheres/run/identity.hpp"
#include "sazare/methods/spheres/run/motion_rows.hpp"
#include "sazare/methods/spheres/run/record.hpp"
#include "sazare/runs/motion_table.hpp"
#include "sazare/runs/particle_rows.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// What bodies are made for.
struct BodiesSetting {
  const cases::HybridCase& hybrid;
  Real window = 0;                  ///< [s]
  bool can_return = true;           ///< whether a window may be gone through again, or taken back
  std::filesystem::path mesh = {};  ///< where a mesh that is made for them is kept
  bool keeps_mesh = false;          ///< whether one that stands there is taken
  bool takes_forces = false;        ///< from outside, see LiveRun::apply
};

/// Whether windows of a case may be gone through again within one program.
bool repeats(const cases::HybridCase& hybrid);

struct CoupledSpheres {
  using Record = SpheresRecord;
  static constexpr const char *method = "spheres", *name = "spheres";
  static constexpr const char *count_key = "particles", *steps_key = "particle_steps", *evaluated = "particle-steps";
  static constexpr int per_thread = 4000;
  static constexpr bool meets(int) { return true; }

  const cases::CaseFile& file;
  SpheresModel model;
  methods::hybrid::SphereSide side;

  explicit CoupledSpheres(const BodiesSetting& setting);
  std::int64_t count() const { return static_cast<std::int64_t>(model.group.size()); }
  Real step() const { return model.steps.step; }
  bool prepare(const RunOptions& options);
  static std::string warning() { return ""; }
  RunIdentity identity() const;
  const std::string& title() const { return file.as<cases::SpheresCase>().title; }
  void write_case(const RunFolder& folder) const;
  void apply(std::span<const Vector3> forces) { model.stepper->apply({forces.begin(), forces.end()}); }
  void read_motion(MotionTable& table) { read_spheres(*model.stepper, table); }
  void columns(Archive& archive) { model.stepper->columns(archive); }
};

struct CoupledRectangles {
  using Record = RectanglesRecord;
  static constexpr const char *method = "rectangles", *name = "rectangles";
  static constexpr const char *count_key = "body_elements", *steps_key = "body_element_steps", *evaluated = "element-steps";
  static constexpr int per_thread = 4000;
  static constexpr bool meets(int dimension) { return dimension == 2; }

  const cases::CaseFile& file;
  RectanglesModel model;
  methods::hybrid::RectangleSide side;

  explicit CoupledRectangles(const BodiesSetting& setting);
  std::int64_t count() const { return model.elements; }
  Real step() const { return model.step; }
  static bool prepare(const RunOptions&) { return true; }
  const std::string& warning() const { return model.warning; }
  RunIdentity identity() const;
  const std::string& title() const { return file.as<cases::RectanglesCase>().title; }
  void write_case(const RunFolder& folder) const;
  void apply(std::span<const Vector3> forces) { model.stepper->apply(forces); }
  void read_motion(MotionTable& table) const { read_particles(*model.stepper, model.elements, table); }
  void columns(Archive& archive) { model.stepper->columns(archive); }
};

struct CoupledBlocks {
  using Record = RunRecord;
  static constexpr const char *method = "blocks", *name = "blocks";
  static constexpr const char *count_key = "blocks", *steps_key = "block_steps", *evaluated = "block-steps";
  static constexpr int per_thread = 4000;
  static constexpr bool meets(int) { return true; }

  const cases::CaseFile& file;
  BlocksModel model;
  methods::hybrid::BlockSide side;

  explicit CoupledBlocks(const BodiesSetting& setting);
  std::int64_t count() const { return model.simulation->bodies().size(); }
  Real step() const { return model.simulation->levels().step(0); }
  static bool prepare(const RunOptions&) { return true; }
  std::string warning() const { return warn_of(file, model); }
  RunIdentity identity() const { return identify(file.as<cases::BlocksCase>(), model.mesh); }
  const std::string& title() const { return file.as<cases::BlocksCase>().title; }
  void write_case(const RunFolder& folder) const;
  void apply(std::span<const Vector3> forces) { apply_forces(model, forces, {}); }
  void read_motion(MotionTable& table) const { read_bodies(*model.simulation, table); }
  void columns(Archive& archive) { model.simulation->columns(archive); }
};

template <int D>
struct CoupledGround {
  using Record = MpsRecord<D>;
  static constexpr const char *method = "mps", *name = "particles of ground";
  static constexpr const char *count_key = "ground_particles", *steps_key = "ground_particle_steps",
                              *evaluated = "particle-steps";
  static constexpr int per_thread = 4000;
  static constexpr bool meets(int dimension) { return dimension == D; }

  const cases::CaseFile& file;
  MpsModel<D> model;
  methods::hybrid::GroundSide<D> side;

  explicit CoupledGround(const BodiesSetting& setting);
  /// Whether it finds its equilibrium with the surface where that stands.
  bool settles() const { return file.as<cases::MpsCase>().gravity.settle; }
  std::int64_t count() const { return static_cast<std::int64_t>(model.filling.sites.size()); }
  Real step() const { return model.step; }
  bool prepare(const RunOptions& options, Rest rest = Rest::fully);
  const std::string& warning() const { return model.warning; }
  RunIdentity identity() const;
  const std::string& title() const { return file.as<cases::MpsCase>().title; }
  void write_case(const RunFolder& folder) const;
  void apply(std::span<const Vector3> forces) { model.stepper->apply(forces); }
  void read_motion(MotionTable& table) const { read_particles(*model.stepper, static_cast<Index>(count()), table); }
  void columns(Archive& archive) { model.stepper->columns(archive); }
};

extern template struct CoupledGround<2>;
extern template struct CoupledGround<3>;

/// Calls `visit` with the type of the bodies of a case and hands back what it gives.
template <class Visit>
auto visit_bodies(const cases::HybridCase& hybrid, Visit&& visit) {
  if (const auto* ground = std::any_cast<cases::MpsCase>(&hybrid.bodies->content)) {
    if (ground->particles.dimension == 3) return visit(std::type_identity<CoupledGround<3>>{});
    return visit(std::type_identity<CoupledGround<2>>{});
  }
  if (hybrid.bodies->holds<cases::RectanglesCase>())
    return visit(std::type_identity<CoupledRectangles>{});
  if (hybrid.bodies->holds<cases::BlocksCase>()) return visit(std::type_identity<CoupledBlocks>{});
  return visit(std::type_identity<CoupledSpheres>{});
}

/// What the case of the bodies will do, in words.
std::string check_bodies(const cases::HybridCase& hybrid);

}  // namespace sazare::runs
