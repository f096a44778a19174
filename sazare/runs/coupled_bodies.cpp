#include "sazare/runs/coupled_bodies.hpp"

#include "sazare/cases/resolved.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/check_blocks.hpp"
#include "sazare/runs/hybrid_model.hpp"
#include "sazare/runs/mesh_source.hpp"
#include "sazare/runs/run_case.hpp"
#include "sazare/runs/sphere_rain.hpp"

namespace sazare::runs {

bool repeats(const cases::HybridCase& hybrid) { return hybrid.coupling.scheme == cases::HybridScheme::repeat; }

CoupledSpheres::CoupledSpheres(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_spheres(file, setting.window)),
      side(*model.stepper, surface_material(setting.hybrid), setting.can_return) {}

bool CoupledSpheres::prepare(const RunOptions& options) { return let_rain(file.spheres(), model, options); }

RunIdentity CoupledSpheres::identity() const { return identify(file.spheres(), observe::to_hex(model.start)); }

void CoupledSpheres::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.spheres(), folder.path()));
}

CoupledRectangles::CoupledRectangles(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_rectangles(file, setting.window)),
      side(*model.stepper, *model.forces, model.elements, setting.can_return) {}

RunIdentity CoupledRectangles::identity() const { return identify(file.rectangles(), assembly_hash(model.stepper->particles())); }

void CoupledRectangles::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.rectangles(), folder.path()));
}

CoupledBlocks::CoupledBlocks(const BodiesSetting& setting)
    : file(*setting.hybrid.bodies),
      model(build_blocks(file.blocks(), load_mesh(file, setting.mesh, setting.keeps_mesh), {}, setting.window)),
      side(*model.simulation, *model.surface, setting.can_return) {}

void CoupledBlocks::write_case(const RunFolder& folder) const {
  observe::write_file(folder.case_file(), cases::write_resolved(file.blocks(), folder.path()));
}

std::string check_bodies(const cases::CaseFile& bodies, Real window) {
  if (std::holds_alternative<cases::BlocksCase>(bodies.content)) return check_blocks(bodies);
  if (std::holds_alternative<cases::RectanglesCase>(bodies.content)) return check_rectangles(bodies, window);
  cases::CaseFile in_one_step = bodies;  // as they are when coupled
  std::get<cases::SpheresCase>(in_one_step.content).time.levels = cases::SphereLevels::uniform;
  return check_spheres(in_one_step);
}

}  // namespace sazare::runs
