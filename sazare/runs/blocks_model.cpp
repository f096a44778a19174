#include "sazare/runs/blocks_model.hpp"

#include <utility>

#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/coupled_rates.hpp"
#include "sazare/runs/base_step.hpp"
#include "sazare/runs/blocks_parts.hpp"
#include "sazare/terms/gravity.hpp"

namespace sazare::runs {

namespace {

using Terms = engine::TermList<3>;

/// Keeps a term in the list and hands back a view of it.
template <class T>
T* keep(Terms& terms, std::unique_ptr<T> term) {
  T* view = term.get();
  terms.push_back(std::move(term));
  return view;
}

laws::SphereContact contact_law(const cases::Contact& contact) {
  constexpr std::array caps = {laws::DampingCap::literal, laws::DampingCap::critical, laws::DampingCap::step};
  return {contact.normal_stiffness, contact.normal_damping, contact.friction_coefficient,
          caps[static_cast<std::size_t>(contact.damping_cap)]};
}

std::vector<terms::Rates> rates_of(const Terms& terms, Index bodies) {
  std::vector<terms::Rates> rates(static_cast<std::size_t>(bodies));
  for (Index body = 0; body < bodies; ++body)
    for (const auto& term : terms) rates[static_cast<std::size_t>(body)] += term->rates(body);
  return rates;
}

engine::StepRules step_rules(const cases::Time& time, Real base_step) {
  engine::StepRules rules;
  rules.base_step = base_step;
  rules.uniform = time.levels == cases::Levels::uniform;
  rules.stability = time.limiter == cases::Limiter::stability;
  rules.stability_fraction = time.stability_fraction;
  if (time.limiter == cases::Limiter::travel) rules.travel_length = time.travel_length;
  rules.neighbor_levels = time.neighbor_levels;
  return rules;
}

}  // namespace

BlocksModel build_blocks(const cases::BlocksCase& blocks, geometry::TetraMesh mesh, const engine::Sharing& sharing,
                         std::optional<Real> window) {
  BlocksModel model;
  model.mesh = std::move(mesh);
  for (Index element = 0; element < static_cast<Index>(model.mesh.tetrahedra.size()); ++element)
    model.volume.push_back(geometry::volume(geometry::corners_of(model.mesh, element)));
  const auto map = geometry::build_face_map(model.mesh);
  const MeshFaces faces{model.mesh, map, geometry::find_surface_faces(model.mesh, map)};
  model.material = materials_by_element(blocks, model.mesh);
  state::Bodies<3> bodies = make_bodies(blocks, model.mesh, model.material);

  std::vector<methods::blocks::JointKind> kinds;
  for (const cases::Joint& joint : blocks.joints) kinds.push_back(make_joint_kind(joint));
  const std::vector<Index> joint_of_face = joint_by_face(blocks, faces, model.material);
  auto joint_faces = make_joint_faces(blocks, faces, joint_of_face);
  auto joint_rates = methods::blocks::joint_rates(kinds, joint_faces, bodies);
  const Real coupling = methods::blocks::coupled_damping(kinds, joint_faces, bodies, joint_rates);
  for (terms::Rates& rates : joint_rates) rates.damping *= coupling / 2;
  std::vector<Real> steps;
  for (const terms::Rates& rates : joint_rates) steps.push_back(blocks.time.stability_fraction * engine::stable_step(rates));
  const Real base_step =
      blocks.time.base_step.value_or(choose_base_step(steps, joint_faces, window.value_or(blocks.time.history_interval)));
  if (blocks.time.limiter == cases::Limiter::stability) sort_by_level(joint_faces, steps, base_step);
  std::vector<geometry::Tetrahedron> corners;
  for (Index element = 0; element < bodies.size(); ++element) corners.push_back(geometry::corners_of(model.mesh, element));

  Terms terms;
  model.joints =
      keep(terms, std::make_unique<methods::blocks::Joints>(std::move(kinds), joint_faces, std::move(joint_rates), bodies));
  model.contacts = keep(terms, std::make_unique<methods::blocks::Contacts>(
                                   contact_law(blocks.contact), blocks.contact.edge_division, *model.joints, std::move(corners),
                                   make_free_faces(blocks, faces, joint_of_face), bodies));
  if (window)
    model.surface =
        keep(terms, std::make_unique<methods::blocks::SurfaceContacts>(contact_law(blocks.contact), *model.contacts, bodies));
  if (auto boundaries = make_boundaries(blocks, faces, model.material, bodies); !boundaries.empty())
    keep(terms, std::make_unique<methods::blocks::OuterFaces>(std::move(boundaries), bodies));
  if (!blocks.blasts.empty())
    keep(terms, std::make_unique<terms::FacePressure>(make_loads(blocks), make_pressed_faces(blocks, faces, bodies), bodies));
  if (!blocks.gravity.acceleration.isZero())
    keep(terms, std::make_unique<terms::Gravity<3>>(blocks.gravity.acceleration, bodies));

  model.rates = rates_of(terms, bodies.size());
  for (const terms::Rates& rates : model.rates) model.stable_step.push_back(engine::stable_step(rates));
  model.simulation =
      std::make_unique<engine::Simulation<3>>(std::move(bodies), std::move(terms), step_rules(blocks.time, base_step), sharing);
  return model;
}

}  // namespace sazare::runs
