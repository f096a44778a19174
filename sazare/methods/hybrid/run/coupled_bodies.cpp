#include "sazare/methods/hybrid/run/coupled_bodies.hpp"

#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/methods/blocks/run/run.hpp"
#include "sazare/methods/hybrid/case/continuum.hpp"
#include "sazare/methods/hybrid/run/model.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/mps/run/run.hpp"
#include "sazare/methods/rectangles/case/format.hpp"
#include "sazare/methods/rectangles/run/run.hpp"
#include "sazare/methods/spheres/case/format.hpp"
#include "sazare/methods/spheres/run/rain.hpp"
#include "sazare/methods/spheres/run/run.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

bool repeats(const cases::HybridCase& hybrid) {
  return hybrid.coupling.scheme == cases::HybridScheme::iterative || hybrid.coupling.scheme == cases::HybridScheme::automatic;
}

CoupledSpheres::CoupledSpheres(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_spheres(file, setting.window)),
      side(*model.stepper, surface_material(setting.hybrid), setting.can_return) {}

bool CoupledSpheres::prepare(const RunOptions& options) { return let_rain(file.as<cases::SpheresCase>(), model, options); }

RunIdentity CoupledSpheres::identity() const { return identify(file.as<cases::SpheresCase>(), observe::to_hex(model.start)); }

void CoupledSpheres::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::SpheresCase>(), folder.path()));
}

CoupledRectangles::CoupledRectangles(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_rectangles(file, setting.window)),
      side(*model.stepper, *model.forces, model.elements, setting.can_return) {}

RunIdentity CoupledRectangles::identity() const { return identify(file.as<cases::RectanglesCase>(), assembly_hash(model.stepper->particles())); }

void CoupledRectangles::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::RectanglesCase>(), folder.path()));
}

CoupledBlocks::CoupledBlocks(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_blocks(file.as<cases::BlocksCase>(), load_mesh(file, setting.mesh, setting.keeps_mesh),
                         {.window = setting.window, .takes_forces = setting.takes_forces})),
      side(*model.simulation, *model.surface, setting.can_return) {}

void CoupledBlocks::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::BlocksCase>(), folder.path()));
}

namespace {

Real window_of(const cases::HybridCase& hybrid) { return *cases::continuum_of(hybrid).time.step; }

}  // namespace

template <int D>
CoupledGround<D>::CoupledGround(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_mps<D>(file, MpsCoupling{setting.window, *setting.hybrid.surface.friction_coefficient})),
      side(*model.stepper, *model.at_surface, setting.can_return) {}

template <int D>
bool CoupledGround<D>::prepare(const RunOptions& options, Rest rest) {
  return settle<D>(file.as<cases::MpsCase>(), model, options, rest);
}

template <int D>
RunIdentity CoupledGround<D>::identity() const {
  return identify(file.as<cases::MpsCase>(), filling_hash<D>(model.filling));
}

template <int D>
void CoupledGround<D>::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.as<cases::MpsCase>(), folder.path()));
}

template struct CoupledGround<2>;
template struct CoupledGround<3>;

std::string check_bodies(const cases::HybridCase& hybrid) {
  const cases::CaseFile& bodies = *hybrid.bodies;
  if (bodies.holds<cases::BlocksCase>()) return check_blocks(bodies);
  if (bodies.holds<cases::RectanglesCase>()) return check_rectangles(bodies, window_of(hybrid));
  if (bodies.holds<cases::MpsCase>())
    return check_mps(bodies, MpsCoupling{window_of(hybrid), *hybrid.surface.friction_coefficient});
  cases::CaseFile in_one_step = bodies;  // as they are when coupled
  in_one_step.as<cases::SpheresCase>().time.levels = cases::SphereLevels::uniform;
  return check_spheres(in_one_step);
}

}  // namespace sazare::runs
