#include "sazare/methods/fem/run/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/motion_of_case.hpp"
#include "sazare/geometry/gmsh/mesher.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/case/contraction.hpp"
#include "sazare/methods/fem/run/drains.hpp"
#include "sazare/methods/fem/run/incident_wave.hpp"
#include "sazare/methods/fem/run/members.hpp"
#include "sazare/methods/fem/run/mesh_names.hpp"
#include "sazare/methods/fem/run/pore_checks.hpp"
#include "sazare/methods/fem/run/sides.hpp"
#include "sazare/methods/fem/run/ties.hpp"
#include "sazare/methods/fem/run/water.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

namespace fem = methods::fem;
using cases::GroupKind;
using fem::Support;

fem::SolidMaterial material_of(const cases::FemMaterial& given, const cases::FemCase& of) {
  constexpr Real degree = std::numbers::pi / 180;
  auto material = fem::SolidMaterial::elastic_of(given.youngs_modulus, given.poisson_ratio, given.density);
  material.name = given.name;
  material.damping_ratio = given.damping_ratio;
  if (given.water_table) {
    const int up = of.mesh.dimension - 1;
    material.saturation = {given.saturated_density,
                           {-given.pore_water_density * of.gravity.acceleration[up], up, *given.water_table}};
    if (given.drainage != cases::Drainage::drained) {
      material.saturation->flow = fem::PoreFlow{given.porosity / given.water_bulk_modulus, 0};
      const Real weight = material.saturation->pore_water.specific_weight;  // without gravity Darcy's law moves nothing
      if (given.drainage == cases::Drainage::flow && weight > 0)
        material.saturation->flow->mobility = given.hydraulic_conductivity / weight;
    }
  }
  if (given.degrades) material.backbone = cases::backbone_of(given, given.shear_modulus());
  if (!given.yields) return material;
  material.strength = laws::MohrCoulomb::make(given.cohesion, given.friction_angle * degree, given.dilation_angle * degree,
                                              given.tensile_strength);
  if (given.contracts()) material.contraction = cases::contraction_of(given);
  return material;
}

std::vector<Index> materials_by_element(const cases::CaseFile& file, const geometry::ElementMesh& mesh, const MeshNames& names) {
  std::vector<Index> by_region(mesh.region_names.size(), -1);
  const auto& materials = file.as<cases::FemCase>().materials;
  for (std::size_t m = 0; m < materials.size(); ++m)
    for (std::size_t k = 0; k < materials[m].regions.size(); ++k)
      by_region[at(names.region(fmt::format("materials.{}.regions.{}", m, k), materials[m].regions[k]))] = static_cast<Index>(m);
  for (std::size_t region = 0; region < by_region.size(); ++region)
    if (by_region[region] < 0)
      refuse(file, "materials", fmt::format("region \"{}\" of the mesh has no material", mesh.region_names[region]),
             "add it to the regions of one of the [[materials]]");
  std::vector<Index> by_element;
  for (const Index region : mesh.region) by_element.push_back(by_region[at(region)]);
  return by_element;
}

/// Parts the mesh along the joints of a case.
std::vector<fem::JointSet> make_joints(const cases::CaseFile& file, geometry::ElementMesh& mesh, const MeshNames& names) {
  std::vector<std::vector<geometry::SharedFace>> cuts;
  std::vector<fem::JointSet> sets;
  const auto& joints = file.as<cases::FemCase>().joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const cases::FemJoint& joint = joints[j];
    const std::string key = fmt::format("joints.{}", j);
    if (joint.on_group())
      cuts.push_back(faces_of_group(mesh, names.group(key + ".group", joint.group, true)));
    else
      cuts.push_back(faces_between(mesh, names.region(key + ".between.0", joint.between[0]),
                                   names.region(key + ".between.1", joint.between[1])));
    if (cuts.back().empty())
      refuse(file, key, fmt::format("the joint \"{}\" lies between no two elements", joint.name),
             "a joint needs an element on either side: regions that touch, or a group inside the body");
    sets.push_back(
        {joint.name,
         {joint.normal_stiffness, joint.shear_stiffness, joint.cohesion, std::tan(joint.friction_angle * std::numbers::pi / 180)},
         {}});
  }
  const auto faces = geometry::split(mesh, cuts);
  for (std::size_t j = 0; j < sets.size(); ++j) sets[j].faces = faces[j];
  return sets;
}

/// Supports and loads of a case; what an earlier boundary holds stays held.
template <int D>
class SupportMaker {
public:
  SupportMaker(const cases::CaseFile& file, const fem::BodyDescription& body, const MeshNames& names)
      : file_(file), fem_(file.as<cases::FemCase>()), body_(body), names_(names) {}

  fem::Supports<D> make() {
    for (const cases::Motion& motion : fem_.motions) supports_.motions.push_back(cases::motion_of_case(motion));
    for (int axis = 0; axis < D; ++axis) supports_.gravity[axis] = fem_.gravity.acceleration[axis];
    for (std::size_t i = 0; i < fem_.boundaries.size(); ++i) add(i);
    supports_.tied = tied_nodes(file_, body_.mesh, names_, supports_);
    for (std::size_t i = 0; i < fem_.loads.size(); ++i) add_load(i);
    supports_.waters = make_waters<D>(file_, body_, names_);
    supports_.drained = drained_nodes(file_, body_, names_);
    if (fem_.damping.relative_to_base) supports_.find_base();
    add_sides<D>(file_, body_, names_, supports_);
    add_incident_wave<D>(file_, body_, supports_);
    return std::move(supports_);
  }

private:
  void add(std::size_t number) {
    const cases::GroupBoundary& boundary = fem_.boundaries[number];
    if (boundary.kind == GroupKind::free_field) return;
    const bool viscous = boundary.kind == GroupKind::viscous;
    const auto& group = names_.group(fmt::format("boundaries.{}.group", number), boundary.group, viscous);
    if (viscous) return add_viscous(number, group);
    std::set<Index> nodes;
    for (const auto& element : group.elements) nodes.insert(element.node_list().begin(), element.node_list().end());
    if (boundary.kind == GroupKind::fixed) supports_.clamped.insert(supports_.clamped.end(), nodes.begin(), nodes.end());
    for (const Index node : nodes)
      for (int axis = 0; axis < D; ++axis) {
        const Index motion = motion_of(boundary.motion[static_cast<std::size_t>(axis)]);
        const bool held = boundary.kind == GroupKind::fixed || motion >= 0 || boundary.axes[static_cast<std::size_t>(axis)];
        if (held && taken_.insert({node, axis}).second)
          supports_.held.push_back({node, axis, motion, static_cast<Index>(number)});
      }
  }

  void add_viscous(std::size_t number, const geometry::ElementGroup& group) {
    fem::ViscousBoundary<D> boundary;
    boundary.boundary = static_cast<Index>(number);
    for (std::size_t axis = 0; axis < D; ++axis) boundary.motion[axis] = motion_of(fem_.boundaries[number].motion[axis]);
    const auto beside = geometry::elements_beside(body_.mesh, group);
    std::set<Index> nodes;
    for (std::size_t i = 0; i < group.elements.size(); ++i) {
      boundary.surface.push_back(group.elements[i]);
      boundary.faces.push_back(fem::viscous_face<D>(body_, beside[i], group.elements[i]));
      for (const Index node : boundary.faces.back().nodes)
        if (viscous_nodes_.insert(node).second) boundary.nodes.push_back(node);
    }
    std::ranges::sort(boundary.nodes);
    supports_.viscous.push_back(std::move(boundary));
  }

  void add_load(std::size_t number) {
    const cases::FemLoad& given = fem_.loads[number];
    const auto& group = names_.group(fmt::format("loads.{}.group", number), given.group, true);
    fem::Load load{given.name, fem::NodalColumn(body_.mesh.nodes.size() * D, 0), given.ramp};
    for (const auto& face : group.elements) {
      const fem::NodeValues shares = fem::face_shares(body_.mesh, face);
      for (std::size_t i = 0; i < face.node_list().size(); ++i)
        for (int axis = 0; axis < D; ++axis)
          load.force[at(face.nodes[i]) * D + static_cast<std::size_t>(axis)] +=
              shares[static_cast<Eigen::Index>(i)] * given.traction[axis];
    }
    supports_.loads.push_back(std::move(load));
  }

  Index motion_of(const std::string& name) const {
    for (std::size_t i = 0; i < fem_.motions.size(); ++i)
      if (!name.empty() && fem_.motions[i].name == name) return static_cast<Index>(i);
    return Support::no_motion;
  }

  const cases::CaseFile& file_;
  const cases::FemCase& fem_;
  const fem::BodyDescription& body_;
  const MeshNames& names_;
  fem::Supports<D> supports_;
  std::set<std::pair<Index, int>> taken_;
  std::set<Index> viscous_nodes_;
};

methods::fem::FemRules rules_of(const cases::FemCase& fem) {
  methods::fem::FemRules rules;
  rules.step = *fem.time.step;
  rules.statics = fem.time.analysis == cases::Analysis::statics;
  rules.alpha = fem.time.alpha;
  rules.tolerance = fem.solver.tolerance;
  rules.most_iterations = fem.solver.iterations;
  rules.most_cuts = fem.solver.cuts;
  if (fem.damping.f2 > 0) rules.damping = laws::RayleighDamping::make(fem.damping.f1, fem.damping.f2);
  return rules;
}

std::vector<Index> gauge_nodes(const cases::CaseFile& file, const geometry::ElementMesh& mesh) {
  Vector3 low = mesh.nodes.front(), high = low;
  for (const Vector3& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  std::vector<Index> found;
  for (std::size_t number = 0; number < file.as<cases::FemCase>().gauges.size(); ++number) {
    const cases::Gauge& gauge = file.as<cases::FemCase>().gauges[number];
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < mesh.nodes.size(); ++i)
      if ((mesh.nodes[i] - gauge.point).norm() < (mesh.nodes[nearest] - gauge.point).norm()) nearest = i;
    const Real distance = (mesh.nodes[nearest] - gauge.point).norm();
    if (distance > 0.1 * (high - low).norm())
      refuse(file, fmt::format("gauges.{}.point", number),
             fmt::format("gauge \"{}\" is {} m from the nearest node", gauge.name, cases::short_number(distance, 3)),
             "put it on the body");
    found.push_back(static_cast<Index>(nearest));
  }
  return found;
}

/// Where the body must find an equilibrium, something has to hold it.
template <int D>
void check_held(const cases::CaseFile& file, methods::fem::FemStepper<D>& stepper) {
  const cases::FemCase& fem = file.as<cases::FemCase>();
  if (fem.time.analysis == cases::Analysis::dynamic && !fem.gravity.settle) return;
  const auto loose = stepper.find_loose_freedom();
  if (!loose) return;
  const geometry::ElementMesh& mesh = stepper.body().mesh();
  if (at(loose->node) >= mesh.nodes.size())
    refuse(file, "members", "the stiffness is singular: nothing keeps a member from turning",
           "let beams run along lines with several nodes in the ground, or fix one of their nodes");
  const Vector3& place = mesh.nodes[at(loose->node)];
  refuse(file, "boundaries",
         fmt::format("the stiffness is singular: nothing holds node {} of the mesh at ({}, {}, {}) m along {}",
                     mesh.node_tags[at(loose->node)], cases::short_number(place.x(), 6), cases::short_number(place.y(), 6),
                     cases::short_number(place.z(), 6), "xyz"[loose->axis]),
         "a body in equilibrium needs supports against translation along every axis and against rotation; parts that touch at a "
         "node, or not at all, need their own");
}

}  // namespace

geometry::ElementMesh load_fem_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep) {
  const cases::FemMesh& mesh = file.as<cases::FemCase>().mesh;
  if (mesh.is_geometry() && !(keep && std::filesystem::exists(made)))
    geometry::mesh_geometry({mesh.file, made, mesh.parameters, mesh.size_factor, mesh.dimension});
  return geometry::read_element_mesh(mesh.is_geometry() ? made : mesh.file, mesh.dimension, mesh.scale);
}

template <int D>
FemModel<D> build_fem(const cases::CaseFile& file, geometry::ElementMesh mesh) {
  const cases::FemCase& given = file.as<cases::FemCase>();
  fem::BodyDescription description;
  description.mesh = std::move(mesh);
  const MeshNames names(file, description.mesh);
  description.integration =
      given.elements.integration == cases::IntegrationKind::full ? fem::Integration::full : fem::Integration::reduced;
  description.mass = given.elements.mass == cases::MassKind::consistent ? fem::MassMatrix::consistent : fem::MassMatrix::lumped;
  for (const cases::FemMaterial& material : given.materials) description.materials.push_back(material_of(material, given));
  description.material = materials_by_element(file, description.mesh, names);
  description.joints = make_joints(file, description.mesh, names);
  description.members = make_members(file, description.mesh, names);
  fem::Supports<D> supports = SupportMaker<D>(file, description, names).make();
  FemModel<D> model;
  model.warnings = warn_of_dry_water(file, supports.waters) + warn_of_free_pores(file, description, supports, names) +
                   warn_of_ground_water(file, description, names) + warn_of_loaded_ties(file, names) +
                   warn_of_hanging_ground(file, description.mesh, names);
  model.step = *given.time.step;
  model.gauges = gauge_nodes(file, description.mesh);
  std::map<std::string, int> seen;
  for (const cases::GroupBoundary& boundary : given.boundaries) {
    const int times = seen[boundary.group]++;
    model.group_names.push_back(times == 0 ? boundary.group : fmt::format("{} {}", boundary.group, times + 1));
  }
  model.stepper = std::make_unique<methods::fem::FemStepper<D>>(std::make_unique<fem::Body<D>>(std::move(description)),
                                                                std::move(supports), rules_of(given));
  check_held(file, *model.stepper);
  return model;
}

std::string mesh_hash(const geometry::ElementMesh& mesh) {
  observe::Hash hash;
  for (const Vector3& node : mesh.nodes) hash.add(std::as_bytes(std::span(node.data(), 3)));
  for (const geometry::MeshElement& element : mesh.elements) hash.add(std::as_bytes(element.node_list()));
  for (const geometry::ElementGroup& group : mesh.groups)
    for (const geometry::MeshElement& element : group.elements) hash.add(std::as_bytes(element.node_list()));
  hash.add(std::as_bytes(std::span(mesh.region)));
  return observe::to_hex(hash.value());
}

geometry::LinearSurface outer_surface(const cases::CaseSource& source, const std::string& key, const std::string& name,
                                      const geometry::ElementMesh& mesh) {
  return geometry::linear_surface(mesh, MeshNames(source, mesh).outer_group(key, name, "no body can touch it"));
}

template FemModel<2> build_fem<2>(const cases::CaseFile&, geometry::ElementMesh);
template FemModel<3> build_fem<3>(const cases::CaseFile&, geometry::ElementMesh);

}  // namespace sazare::runs
