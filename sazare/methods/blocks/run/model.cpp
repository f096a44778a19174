#include "sazare/methods/blocks/run/model.hpp"

#include <stdexcept>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/levels/terms/gravity.hpp"
#include "sazare/methods/blocks/contacts.hpp"
#include "sazare/methods/blocks/true_faces/face_contacts.hpp"
#include "sazare/methods/blocks/rates/coupled_rates.hpp"
#include "sazare/methods/blocks/run/blasting/charges.hpp"
#include "sazare/methods/blocks/run/joints/deformable_elements.hpp"
#include "sazare/methods/blocks/run/joints/element_springs.hpp"
#include "sazare/methods/blocks/run/joints/loading_rates.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "sazare/methods/blocks/run/start/base_step.hpp"
#include "sazare/methods/blocks/run/water.hpp"

namespace sazare::runs {

namespace {

using Terms = levels::TermList<3>;

/// Keeps a term in the list and hands back a view of it.
template <class T>
T* keep(Terms& terms, std::unique_ptr<T> term) {
  T* view = term.get();
  terms.push_back(std::move(term));
  return view;
}

laws::DampingCap damping_cap(const cases::Contact& contact) {
  constexpr std::array caps = {laws::DampingCap::literal, laws::DampingCap::critical, laws::DampingCap::step};
  return caps[static_cast<std::size_t>(contact.damping_cap)];
}

laws::SphereContact contact_law(const cases::Contact& contact) {
  return {contact.normal_stiffness, contact.normal_damping, contact.friction_coefficient, damping_cap(contact)};
}

laws::FaceOverlap face_law(const cases::Contact& contact) {
  return {contact.face_stiffness, contact.face_damping, contact.friction_coefficient, damping_cap(contact)};
}

/// Which part of w^2 h^2 + 2 c h = 4 is the larger one.
bool is_bound_by_dashpots(const terms::Rates& rates, Real step) { return 2 * rates.damping > rates.stiffness * step; }

/// What every element's step may be, with its neighbours held.
void find_stable_steps(const Terms& terms, Index bodies, BlocksModel& model) {
  for (Index body = 0; body < bodies; ++body) {
    terms::Rates rates;
    for (const auto& term : terms) rates += term->rates(body);
    model.stable_step.push_back(levels::stable_step(rates));
    model.is_bound_by_dashpots.push_back(is_bound_by_dashpots(rates, model.stable_step.back()));
  }
}

levels::StepRules step_rules(const cases::Time& time, Real base_step) {
  levels::StepRules rules;
  rules.base_step = base_step;
  rules.uniform = time.levels == cases::Levels::uniform;
  rules.stability = time.limiter == cases::Limiter::stability;
  rules.stability_fraction = time.stability_fraction;
  if (time.limiter == cases::Limiter::travel) rules.travel_length = time.travel_length;
  rules.neighbor_levels = time.neighbor_levels;
  return rules;
}

/// Makes the terms of a model. The tables that only this takes are gone when it has.
class TermMaker {
public:
  TermMaker(const cases::BlocksCase& blocks, BlocksModel& model, const state::Bodies<3>& bodies)
      : blocks_(blocks), model_(model), bodies_(bodies) {}

  Terms make(const BlocksSetting& setting) {
    const std::optional<Real>& window = setting.window;
    const auto map = geometry::build_face_map(model_.mesh);
    const MeshFaces faces{model_.mesh, map, geometry::find_surface_faces(model_.mesh, map)};
    const std::vector<Index> joint_of_face = joint_by_face(blocks_, faces, model_.material);
    model_.fit = find_mesh_fit(blocks_, faces, model_.material, joint_of_face);
    make_joints(faces, make_joint_faces(blocks_, faces, joint_of_face), window.value_or(blocks_.time.history_interval));
    const auto free_faces = make_free_faces(blocks_, faces, joint_of_face);
    model_.fit.start_balance = find_balance(blocks_, faces, bodies_, free_faces);
    make_contacts(free_faces);
    if (window && blocks_.contact.normal_stiffness == 0)
      throw UserError(
          "[contact] of a coupled run has no contact_stiffness: spheres behind the faces touch its surface, whatever contact_shape "
          "says; add contact_stiffness = ... (N/m)");
    if (window)
      model_.surface = keep(
          terms_, std::make_unique<methods::blocks::SurfaceContacts>(contact_law(blocks_.contact), *model_.contacts, bodies_));
    if (auto boundaries = make_boundaries(blocks_, faces, model_.material, bodies_); !boundaries.empty())
      model_.boundaries =
          keep(terms_, std::make_unique<methods::blocks::OuterFaces>(std::move(boundaries), make_ground(blocks_), bodies_));
    if (!blocks_.blasts.empty())
      keep(terms_,
           std::make_unique<terms::FacePressure>(make_loads(blocks_), make_pressed_faces(blocks_, faces, bodies_), bodies_));
    if (auto charged = make_charged_faces(blocks_, faces, bodies_); !charged.empty())
      model_.charges =
          keep(terms_, std::make_unique<methods::blocks::ChargeGas>(make_charges(blocks_), std::move(charged), bodies_));
    if (model_.charges != nullptr && has_gas_in_cracks(blocks_))
      keep(terms_,
           std::make_unique<methods::blocks::CrackGas>(*model_.charges, *model_.joints, make_gas_faces(blocks_, faces), bodies_));
    if (!blocks_.gravity.acceleration.isZero())
      keep(terms_, std::make_unique<terms::Gravity<3>>(blocks_.gravity.acceleration, bodies_));
    if (auto water = make_water(blocks_, faces, *model_.joints, bodies_)) model_.water = keep(terms_, std::move(water));
    if (setting.takes_forces) model_.outside_forces = keep(terms_, std::make_unique<terms::OutsideForces>(bodies_));
    return std::move(terms_);
  }

  Real base_step() const { return base_step_; }

private:
  void make_joints(const MeshFaces& faces, std::vector<methods::blocks::JointFace> joint_faces, Real whole) {
    add_own_springs(blocks_, model_.material, bodies_, joint_faces);
    model_.fit.softest_of_joint = find_softest_faces(blocks_, bodies_, joint_faces);
    auto rate_laws = add_loading_rates(blocks_, model_.material, joint_faces);
    model_.kinds = scatter_strengths(blocks_, model_.mesh, joint_faces);
    model_.fit.overstressed = find_overstressed(blocks_, model_.kinds, joint_faces);
    const auto& kinds = model_.kinds.kinds;
    const auto elastic = methods::blocks::elastic_joints(kinds);
    auto joint_rates = methods::blocks::joint_rates(elastic, joint_faces, bodies_);
    constexpr Real most_coupling = 2;  // strains are not among the motions that are searched for the largest coupled rate
    const Real coupling =
        bodies_.strain.empty() ? methods::blocks::coupled_damping(elastic, joint_faces, bodies_, joint_rates) : most_coupling;
    for (terms::Rates& rates : joint_rates) rates.damping *= coupling / 2;
    std::vector<Real> steps;
    for (const terms::Rates& rates : joint_rates) steps.push_back(blocks_.time.stability_fraction * levels::stable_step(rates));
    base_step_ = blocks_.time.base_step.value_or(choose_base_step(steps, joint_faces, whole));
    if (blocks_.time.limiter == cases::Limiter::stability) sort_by_level(joint_faces, steps, base_step_);
    model_.joints = keep(terms_, std::make_unique<methods::blocks::Joints>(kinds, joint_faces, std::move(joint_rates), bodies_,
                                                                           std::move(rate_laws)));
    if (!bodies_.strain.empty())
      model_.elements = keep(terms_, std::make_unique<methods::blocks::Elements>(
                                         make_elements(blocks_, faces, model_.material, bodies_, joint_faces), bodies_));
  }

  void make_contacts(const std::vector<methods::blocks::FreeFace>& free_faces) {
    const cases::Contact& contact = blocks_.contact;
    const geometry::ElementCorners corners{model_.mesh.nodes, model_.mesh.tetrahedra};
    if (contact.shape == cases::ContactShape::faces)
      model_.contacts = keep(terms_, std::make_unique<methods::blocks::FaceContacts>(face_law(contact), contact.edge_division,
                                                                                     *model_.joints, corners, free_faces, bodies_));
    else
      model_.contacts = keep(terms_, std::make_unique<methods::blocks::Contacts>(contact_law(contact), contact.edge_division,
                                                                                 *model_.joints, corners, free_faces, bodies_));
  }

  const cases::BlocksCase& blocks_;
  BlocksModel& model_;
  const state::Bodies<3>& bodies_;
  Terms terms_;
  Real base_step_ = 0;  // [s]
};

}  // namespace

BlocksModel build_blocks(const cases::BlocksCase& blocks, geometry::TetraMesh mesh, const BlocksSetting& setting) {
  BlocksModel model;
  model.mesh = std::move(mesh);
  model.material = materials_by_element(blocks, model.mesh);
  state::Bodies<3> bodies = make_bodies(blocks, model.mesh, model.material);
  add_strains(blocks, model.material, bodies);
  TermMaker maker(blocks, model, bodies);
  Terms terms = maker.make(setting);
  find_stable_steps(terms, bodies.size(), model);
  model.simulation = std::make_unique<levels::Simulation<3>>(std::move(bodies), std::move(terms),
                                                             step_rules(blocks.time, maker.base_step()), setting.sharing);
  return model;
}

void apply_forces(BlocksModel& model, std::span<const Vector3> forces, std::span<const Vector3> moments) {
  levels::Simulation<3>& simulation = *model.simulation;
  if (model.outside_forces == nullptr) throw std::logic_error("the blocks were made without forces from outside");
  if (simulation.now().tick % schedule::base_stride != 0) return;
  std::vector<terms::OutsideForces::Load> loads(forces.size());
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i] = {forces[i], moments.empty() ? Vector3(Vector3::Zero()) : moments[i]};
  std::vector<Index> which;
  std::vector<state::Impulse<3>> more;
  for (const auto& lacking : model.outside_forces->set(loads, simulation.now(), simulation.bodies())) {
    which.push_back(lacking.body);
    more.push_back(lacking.impulse);
  }
  simulation.add_to_kicks(which, more);
}

}  // namespace sazare::runs
