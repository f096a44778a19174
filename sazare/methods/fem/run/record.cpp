#include "sazare/methods/fem/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/run/columns.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

/// The numbers of a node as a vector of three.
template <int D>
Vector3 vector_of(const methods::fem::NodalColumn& column, std::size_t node) {
  Vector3 vector = Vector3::Zero();
  for (int axis = 0; axis < D; ++axis) vector[axis] = column[node * D + static_cast<std::size_t>(axis)];
  return vector;
}

/// Of the nodes of the mesh; pressure nodes come after them.
template <int D>
std::vector<Vector3> vectors_of(const methods::fem::NodalColumn& column, std::size_t nodes) {
  std::vector<Vector3> vectors(nodes);
  for (std::size_t node = 0; node < vectors.size(); ++node) vectors[node] = vector_of<D>(column, node);
  return vectors;
}

Real largest(const std::vector<Vector3>& vectors) {
  Real most = 0;
  for (const Vector3& one : vectors) most = std::max(most, one.norm());
  return most;
}

constexpr std::array axis_names = {'x', 'y', 'z'};

}  // namespace

template <int D>
FemRecord<D>::FemRecord(const RunFolder& folder, const cases::CaseFile& file, FemModel<D>& model, const RunClocks& clocks)
    : folder_(&folder),
      file_(&file),
      model_(&model),
      clocks_(clocks),
      files_(folder.snapshots(), "finite_elements"),
      members_(*model.stepper),
      peaks_(model.gauges.size(), 0),
      largest_forces_(model.group_names.size() * D, 0) {
  for (const Index node : model.gauges) gauge_pressure_.push_back(stepper().body().pores().shares_at(node));
}

template <int D>
std::array<Real, columns::fem::energies.size()> FemRecord<D>::energies() const {
  const methods::fem::FemWork& work = stepper().work();
  const Real kinetic = stepper().rules().statics ? 0 : stepper().kinetic_energy();
  return {work.gravity + work.loads + work.water + work.boundary + work.waves + work.sides,
          kinetic,
          stepper().elastic_energy(),
          work.damping,
          work.radiation,
          work.plastic,
          work.friction,
          work.seepage,
          work.members,
          stepper().energy_residual()};
}

template <int D>
std::vector<RecordFiles::Table> FemRecord<D>::tables() const {
  std::vector<std::string> history, gauges;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::fem::motion);
  observe::add_titles(history, columns::fem::energies);
  observe::add_titles(history, columns::fem::work);
  if (has_excess()) observe::add_titles(history, columns::fem::pore_water);
  for (const std::string& name : model_->group_names) observe::add_titles(history, columns::fem::boundary, name, D);
  if (!stepper().supports().waters.empty()) observe::add_titles(history, columns::fem::moving_water);
  for (const auto& water : stepper().supports().waters) observe::add_titles(history, columns::fem::water, water.pressure.name, D);
  for (const auto& set : stepper().body().joints().sets()) observe::add_titles(history, columns::fem::joint_set, set.name);
  members_.add_titles(history);
  observe::add_titles(history, columns::fem::newton);
  observe::add_titles(history, columns::clock);
  observe::add_titles(gauges, columns::time);
  for (const cases::Gauge& gauge : file_->as<cases::FemCase>().gauges)
    observe::add_titles(gauges, columns::place_motion, gauge.name);
  for (std::size_t gauge = 0; gauge < gauge_pressure_.size(); ++gauge)
    if (!gauge_pressure_[gauge].empty())
      observe::add_titles(gauges, columns::fem::gauge_pressure, file_->as<cases::FemCase>().gauges[gauge].name);
  return {{folder_->history(), history}, {folder_->gauges(), gauges}};
}

/// Forces of the boundaries of the case on the body; what two of them hold belongs to the first.
template <int D>
std::vector<Vector<D>> FemRecord<D>::boundary_forces() const {
  std::vector<Vector<D>> forces(model_->group_names.size(), Vector<D>::Zero());
  const auto reactions = stepper().reactions();
  const auto& supports = stepper().supports();
  for (const auto& support : supports.held)
    forces[at(support.boundary)][support.axis] += reactions[at(support.node) * D + static_cast<std::size_t>(support.axis)];
  for (std::size_t i = 0; i < supports.viscous.size(); ++i)
    forces[at(supports.viscous[i].boundary)] += stepper().viscous_force(i);
  for (std::size_t i = 0; i < supports.sides.size(); ++i) forces[at(supports.sides[i].boundary)] += stepper().side_force(i);
  return forces;
}

template <int D>
std::vector<Real> FemRecord<D>::history_row(Real time, Real wall_seconds) {
  const auto& state = stepper().state();
  methods::fem::NodalColumn moved = state.displacement;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= stepper().initial_displacement()[i];
  const std::size_t nodes = model_->mesh().nodes.size();
  displacement_ = largest(vectors_of<D>(moved, nodes));
  const Real speed = largest(vectors_of<D>(state.velocity, nodes)),
             acceleration = largest(vectors_of<D>(state.acceleration, nodes));
  largest_displacement_ = std::max(largest_displacement_, displacement_);
  largest_speed_ = std::max(largest_speed_, speed);
  largest_acceleration_ = std::max(largest_acceleration_, acceleration);
  std::vector<Real> row = {time, displacement_, speed, acceleration};
  for (const Real value : energies()) row.push_back(value);
  const methods::fem::FemWork& work = state.work;
  row.insert(row.end(), {work.gravity, work.loads, work.boundary, work.waves, work.water, work.sides});
  if (has_excess()) {
    const PoreExtremes found = pore_extremes();
    row.insert(row.end(), {found.largest_excess, found.least_excess, found.least, stepper().elastic_energy_of_water()});
    peak_excess_ = std::max(peak_excess_, found.largest_excess);
    least_pressure_ = std::min(least_pressure_, found.least);
  }
  std::size_t place = 0;
  for (const Vector<D>& force : boundary_forces())
    for (int axis = 0; axis < D; ++axis, ++place) {
      row.push_back(force[axis]);
      largest_forces_[place] = std::max(largest_forces_[place], std::abs(force[axis]));
    }
  if (!stepper().supports().waters.empty()) row.push_back(stepper().kinetic_energy_of_water());
  for (std::size_t water = 0; water < stepper().supports().waters.size(); ++water) {
    const Vector<D> force = stepper().water_force(water);
    row.insert(row.end(), force.begin(), force.end());
  }
  const auto& joints = stepper().body().joints();
  for (std::size_t set = 0; set < joints.sets().size(); ++set) {
    const auto summary = joints.summary(set, state.displacement, state.memory.joints);
    row.insert(row.end(), {summary.open_fraction, summary.sliding_fraction, summary.largest_slip});
  }
  members_.add_values(row);
  row.insert(row.end(), {static_cast<Real>(state.iterations), static_cast<Real>(state.cuts), wall_seconds});
  return row;
}

template <int D>
std::vector<Real> FemRecord<D>::gauge_row(Real time) {
  const auto& state = stepper().state();
  std::vector<Real> row = {time};
  for (std::size_t gauge = 0; gauge < model_->gauges.size(); ++gauge) {
    const std::size_t node = at(model_->gauges[gauge]);
    const Vector3 moved = vector_of<D>(state.displacement, node) - vector_of<D>(stepper().initial_displacement(), node);
    const Vector3 velocity = vector_of<D>(state.velocity, node);
    for (const Vector3& value : {moved, velocity, vector_of<D>(state.acceleration, node)})
      row.insert(row.end(), value.begin(), value.end());
    peaks_[gauge] = std::max(peaks_[gauge], velocity.norm());
  }
  for (const auto& shares : gauge_pressure_) {
    if (shares.empty()) continue;
    Real pressure = 0;
    for (const auto& [node, share] : shares) pressure += share * methods::fem::pore_pressure<D>(node, state.velocity);
    row.push_back(pressure);
  }
  return row;
}

template <int D>
typename FemRecord<D>::PoreExtremes FemRecord<D>::pore_extremes() const {
  const auto& pores = stepper().body().pores();
  PoreExtremes found;
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure) {
    const Real excess = methods::fem::pore_pressure<D>(pores.pressure_node(pressure), stepper().state().velocity);
    found.largest_excess = std::max(found.largest_excess, excess);
    found.least_excess = std::min(found.least_excess, excess);
    const Real whole = pores.pressure_at_rest(pressure) + excess;
    found.least = pressure == 0 ? whole : std::min(found.least, whole);
  }
  return found;
}

/// Adds the excess pressure of the elements to that at rest. Without settle there is no stress to which it has a ratio.
template <int D>
void FemRecord<D>::add_pressures(std::vector<Real>& total, std::vector<Real>& excess, std::vector<Real>& ratio) {
  const auto& pores = stepper().body().pores();
  excess.assign(total.size(), 0);
  ratio.assign(total.size(), 0);
  for (std::size_t i = 0; i < pores.size(); ++i) {
    const std::size_t element = at(pores.element(i));
    excess[element] = pores.mean(i, stepper().state().velocity);
    total[element] += excess[element];
    if (!file_->as<cases::FemCase>().gravity.settle || !(initial_stress_[element] < 0)) continue;
    ratio[element] = excess[element] / -initial_stress_[element];
    peak_ratio_ = std::max(peak_ratio_, ratio[element]);
  }
}

template <int D>
void FemRecord<D>::observe(std::int64_t step, Real wall_seconds) {
  members_.observe(clocks_.time(step));
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  files_.add_row(0, history_row(time, wall_seconds));
  files_.add_row(1, gauge_row(time));
  if (clocks_.is_snapshot(step)) write_snapshot(time);
}

/// By normal stresses xx, yy, zz and shear stresses xy, yz, zx [Pa].
Real von_mises_stress(const Vector3& normal, const Vector3& shear) {
  const Vector3 deviator = normal.array() - normal.mean();
  return std::sqrt(1.5 * deviator.squaredNorm() + 3 * shear.squaredNorm());
}

/// Of the elements, by the material at the middle of their nodes [kg/m3].
template <int D>
std::vector<Real> FemRecord<D>::densities() const {
  const geometry::ElementMesh& mesh = model_->mesh();
  const auto& body = stepper().body().description();
  std::vector<Real> densities;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Vector3 middle = Vector3::Zero();
    for (const Index node : mesh.elements[e].node_list()) middle += mesh.nodes[static_cast<std::size_t>(node)];
    middle /= static_cast<Real>(mesh.elements[e].node_list().size());
    densities.push_back(body.materials[static_cast<std::size_t>(body.material[e])].density_at(middle));
  }
  return densities;
}

template <int D>
void FemRecord<D>::write_snapshot(Real time) {
  const geometry::ElementMesh& mesh = model_->mesh();
  const auto& state = stepper().state();
  std::vector<Vector3> places = mesh.nodes, moved(mesh.nodes.size());
  for (std::size_t node = 0; node < places.size(); ++node) {
    moved[node] = vector_of<D>(state.displacement, node) - vector_of<D>(stepper().initial_displacement(), node);
    places[node] += vector_of<D>(state.displacement, node);
  }
  const std::vector<Vector3> velocity = vectors_of<D>(state.velocity, places.size()),
                             acceleration = vectors_of<D>(state.acceleration, places.size());
  std::vector<Real> slip, peak, pressure, pore_pressure, excess, ratio, von_mises;
  std::vector<Vector3> normal, shear;
  for (const auto& one : stepper().body().means(state.displacement, state.memory)) {
    normal.push_back(one.stress.template head<3>());
    shear.push_back(Vector3::Zero());
    shear.back().template head<methods::fem::stress_size<D> - 3>() = one.stress.template tail<methods::fem::stress_size<D> - 3>();
    pressure.push_back(-one.stress.template head<3>().sum() / 3);
    slip.push_back(one.slip);
    peak.push_back(one.peak);
    von_mises.push_back(von_mises_stress(normal.back(), shear.back()));
  }
  if (initial_stress_.empty())
    for (const Vector3& stress : normal) initial_stress_.push_back(stress[D - 1]);
  std::vector<std::int32_t> connectivity, region(mesh.region.begin(), mesh.region.end());
  std::vector<std::uint8_t> types;
  for (const geometry::MeshElement& element : mesh.elements) {
    for (const int place : geometry::vtk_order(element.shape))
      connectivity.push_back(element.nodes[static_cast<std::size_t>(place)]);
    types.push_back(geometry::facts(element.shape).vtk_type);
  }
  auto of_points = observe::cell_data(columns::fem::nodes, moved, velocity, acceleration);
  std::ranges::copy(members_.fields(), std::back_inserter(of_points));
  const std::vector<Real> density = densities();
  auto of_cells = observe::cell_data(columns::fem::elements, normal, shear, pressure, von_mises, slip, region, density);
  const auto has_backbone = [](const auto& material) { return material.backbone.has_value(); };
  if (std::ranges::any_of(stepper().body().description().materials, has_backbone))
    of_cells.push_back(observe::cell_data(columns::fem::soil[0].name, peak));
  const auto is_saturated = [](const auto& material) { return material.saturation.has_value(); };
  if (std::ranges::any_of(stepper().body().description().materials, is_saturated)) {
    pore_pressure = stepper().body().pore_pressures();
    if (has_excess()) {
      add_pressures(pore_pressure, excess, ratio);
      of_cells.push_back(observe::cell_data(columns::fem::excess[0].name, excess));
      of_cells.push_back(observe::cell_data(columns::fem::excess[1].name, ratio));
    }
    of_cells.push_back(observe::cell_data(columns::fem::pores[0].name, pore_pressure));
  }
  observe::Grid grid{observe::Grid::Cell::vertex, places, connectivity, of_cells, time};
  grid.point_data = of_points;
  grid.types = types;
  files_.add_snapshot(grid);
}

template <int D>
void FemRecord<D>::check_motion(Real time) const {
  const auto& moved = stepper().state().displacement;
  const auto bad = std::ranges::find_if(moved, [](Real value) { return !std::isfinite(value); });
  if (bad == moved.end()) return;
  const auto node = static_cast<std::size_t>(bad - moved.begin()) / D;
  throw PhysicsError(
      fmt::format("the displacement of node {} is no longer a number, found at t = {} s\n  check the loads and motions",
                  model_->mesh().node_tags[node], cases::short_number(time)));
}

template <int D>
std::vector<std::pair<std::string, observe::Figure>> FemRecord<D>::results(std::int64_t step, Real wall_seconds) const {
  const auto& state = stepper().state();
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"nodes", static_cast<std::int64_t>(model_->mesh().nodes.size())},
      {"elements", static_cast<std::int64_t>(model_->mesh().elements.size())},
      {"degrees_of_freedom", static_cast<std::int64_t>(stepper().free_freedoms())},
      {"steps", step},
      {"step", model_->step},
      {"newton_iterations", state.iterations},
      {"step_cuts", state.cuts},
      {"wall_seconds", wall_seconds},
      {"final_displacement", displacement_},
      {"peak_displacement", largest_displacement_},
      {"peak_speed", largest_speed_},
      {"peak_acceleration", largest_acceleration_}};
  const auto joules = energies();
  for (std::size_t i = 0; i < joules.size(); ++i) results.emplace_back(columns::fem::energies[i].name, joules[i]);
  results.emplace_back("energy_round_off", stepper().round_off_energy());
  for (std::size_t i = 0; i < largest_forces_.size(); ++i)
    results.emplace_back(fmt::format("peak_force_{}_{}", model_->group_names[i / D], axis_names[i % D]), largest_forces_[i]);
  if (has_excess()) {
    results.emplace_back("peak_excess_pore_pressure", peak_excess_);
    results.emplace_back("least_pore_pressure", least_pressure_);
    results.emplace_back("peak_pore_pressure_ratio", peak_ratio_);
  }
  const auto& joints = stepper().body().joints();
  for (std::size_t set = 0; set < joints.sets().size(); ++set)
    results.emplace_back(fmt::format("slip_max_{}", joints.sets()[set].name),
                         joints.summary(set, state.displacement, state.memory.joints).largest_slip);
  members_.add_results(results);
  return results;
}

template <int D>
std::vector<std::pair<std::string, Real>> FemRecord<D>::peak_particle_velocity() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks.emplace_back(file_->as<cases::FemCase>().gauges[i].name, peaks_[i]);
  return peaks;
}

template <int D>
std::uint64_t FemRecord<D>::state_hash() const {
  observe::Hash hash;
  const auto& state = stepper().state();
  for (const auto* column : {&state.displacement, &state.velocity, &state.memory.solids, &state.memory.joints})
    hash.add(std::as_bytes(std::span(*column)));
  if (!state.memory.members.empty()) hash.add(std::as_bytes(std::span(state.memory.members)));
  return hash.value();
}

template <int D>
void FemRecord<D>::columns(Archive& archive) {
  files_.columns(archive);
  members_.columns(archive);
  archive("displacement", displacement_);
  archive("largest_displacement", largest_displacement_);
  archive("largest_speed", largest_speed_);
  archive("largest_acceleration", largest_acceleration_);
  archive("largest_forces", largest_forces_);
  archive("peaks", peaks_);
  archive("initial_stress", initial_stress_);
  archive("peak_excess", peak_excess_);
  archive("least_pressure", least_pressure_);
  archive("peak_ratio", peak_ratio_);
}

template class FemRecord<2>;
template class FemRecord<3>;

}  // namespace sazare::runs
