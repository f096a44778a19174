#include "sazare/runs/fem_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// The numbers of a node as a vector of three.
template <int D>
Vector3 vector_of(const methods::fem::NodalColumn& column, std::size_t node) {
  Vector3 vector = Vector3::Zero();
  for (int axis = 0; axis < D; ++axis) vector[axis] = column[node * D + static_cast<std::size_t>(axis)];
  return vector;
}

template <int D>
std::vector<Vector3> vectors_of(const methods::fem::NodalColumn& column) {
  std::vector<Vector3> vectors(column.size() / D);
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
      snapshots_(folder.snapshots(), "finite_elements"),
      peaks_(model.gauges.size(), 0),
      largest_forces_(model.group_names.size() * D, 0) {}

template <int D>
std::vector<std::pair<std::string, Real>> FemRecord<D>::energies() const {
  const engine::FemWork& work = stepper().work();
  return {{"work", work.gravity + work.loads + work.boundary + work.waves},
          {"kinetic", stepper().rules().statics ? 0 : stepper().kinetic_energy()},
          {"elastic", stepper().elastic_energy()},
          {"damping", work.damping},
          {"radiation", work.radiation},
          {"plastic", work.plastic},
          {"friction", work.friction},
          {"residual", stepper().energy_residual()}};
}

template <int D>
std::vector<std::string> FemRecord<D>::history_columns() const {
  std::vector<std::string> columns = {"time [s]", "displacement_max [m]", "speed_max [m/s]", "acceleration_max [m/s2]"};
  for (const auto& [name, value] : energies()) columns.push_back(fmt::format("energy_{} [J]", name));
  for (const char* name : {"gravity", "loads", "boundary", "waves"}) columns.push_back(fmt::format("work_{} [J]", name));
  for (const std::string& name : model_->group_names)
    for (int axis = 0; axis < D; ++axis)
      columns.push_back(fmt::format("force.{}_{} [N]", name, axis_names[static_cast<std::size_t>(axis)]));
  for (const auto& set : stepper().body().joints().sets())
    for (const char* what : {"open_share [-]", "slip_share [-]", "slip_max [m]"})
      columns.push_back(fmt::format("joint.{}.{}", set.name, what));
  for (const char* rest : {"iterations [-]", "cuts [-]", "wall_seconds [s]"}) columns.emplace_back(rest);
  return columns;
}

template <int D>
std::vector<std::string> FemRecord<D>::gauge_columns() const {
  std::vector<std::string> columns = {"time [s]"};
  for (const cases::Gauge& gauge : file_->fem().gauges)
    for (const auto& [quantity, unit] : {std::pair{"displacement", "m"}, {"velocity", "m/s"}, {"acceleration", "m/s2"}})
      for (const char axis : axis_names) columns.push_back(fmt::format("{}.{}_{} [{}]", gauge.name, quantity, axis, unit));
  return columns;
}

template <int D>
void FemRecord<D>::begin() {
  history_.emplace(folder_->history(), history_columns());
  gauges_.emplace(folder_->gauges(), gauge_columns());
}

template <int D>
void FemRecord<D>::resume() {
  history_ = observe::CsvWriter::resume(folder_->history(), history_columns(), static_cast<std::size_t>(rows_));
  gauges_ = observe::CsvWriter::resume(folder_->gauges(), gauge_columns(), static_cast<std::size_t>(rows_));
  snapshots_.resume(static_cast<std::size_t>(snapshot_count_));
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
  return forces;
}

template <int D>
std::vector<Real> FemRecord<D>::history_row(Real time, Real wall_seconds) {
  const auto& state = stepper().state();
  methods::fem::NodalColumn moved = state.displacement;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= stepper().settled()[i];
  displacement_ = largest(vectors_of<D>(moved));
  const Real speed = largest(vectors_of<D>(state.velocity)), acceleration = largest(vectors_of<D>(state.acceleration));
  largest_displacement_ = std::max(largest_displacement_, displacement_);
  largest_speed_ = std::max(largest_speed_, speed);
  largest_acceleration_ = std::max(largest_acceleration_, acceleration);
  std::vector<Real> row = {time, displacement_, speed, acceleration};
  for (const auto& [name, value] : energies()) row.push_back(value);
  const engine::FemWork& work = state.work;
  row.insert(row.end(), {work.gravity, work.loads, work.boundary, work.waves});
  std::size_t place = 0;
  for (const Vector<D>& force : boundary_forces())
    for (int axis = 0; axis < D; ++axis, ++place) {
      row.push_back(force[axis]);
      largest_forces_[place] = std::max(largest_forces_[place], std::abs(force[axis]));
    }
  const auto& joints = stepper().body().joints();
  for (std::size_t set = 0; set < joints.sets().size(); ++set) {
    const auto summary = joints.summary(set, state.displacement, state.memory.joints);
    row.insert(row.end(), {summary.open_share, summary.slip_share, summary.largest_slip});
  }
  row.insert(row.end(), {static_cast<Real>(state.iterations), static_cast<Real>(state.cuts), wall_seconds});
  return row;
}

template <int D>
std::vector<Real> FemRecord<D>::gauge_row(Real time) {
  const auto& state = stepper().state();
  std::vector<Real> row = {time};
  for (std::size_t gauge = 0; gauge < model_->gauges.size(); ++gauge) {
    const std::size_t node = at(model_->gauges[gauge]);
    const Vector3 moved = vector_of<D>(state.displacement, node) - vector_of<D>(stepper().settled(), node);
    const Vector3 velocity = vector_of<D>(state.velocity, node);
    for (const Vector3& value : {moved, velocity, vector_of<D>(state.acceleration, node)})
      row.insert(row.end(), value.begin(), value.end());
    peaks_[gauge] = std::max(peaks_[gauge], velocity.norm());
  }
  return row;
}

template <int D>
void FemRecord<D>::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  history_->add_row(history_row(time, wall_seconds));
  gauges_->add_row(gauge_row(time));
  ++rows_;
  if (!clocks_.is_snapshot(step)) return;
  write_snapshot(time);
  ++snapshot_count_;
}

template <int D>
void FemRecord<D>::write_snapshot(Real time) {
  const geometry::ElementMesh& mesh = model_->mesh();
  const auto& state = stepper().state();
  std::vector<Vector3> places = mesh.nodes, moved(mesh.nodes.size());
  for (std::size_t node = 0; node < places.size(); ++node) {
    moved[node] = vector_of<D>(state.displacement, node) - vector_of<D>(stepper().settled(), node);
    places[node] += vector_of<D>(state.displacement, node);
  }
  const std::vector<Vector3> velocity = vectors_of<D>(state.velocity), acceleration = vectors_of<D>(state.acceleration);
  std::vector<methods::fem::Voigt<D>> stress;
  std::vector<Real> slip, pressure;
  stepper().body().stresses(state.displacement, state.memory, stress, slip);
  std::vector<Vector3> normal, shear;
  for (const auto& one : stress) {
    normal.push_back(one.template head<3>());
    shear.push_back(Vector3::Zero());
    shear.back().template head<methods::fem::stress_size<D> - 3>() = one.template tail<methods::fem::stress_size<D> - 3>();
    pressure.push_back(-one.template head<3>().sum() / 3);
  }
  std::vector<std::int32_t> connectivity, region(mesh.region.begin(), mesh.region.end());
  std::vector<std::uint8_t> types;
  for (const geometry::MeshElement& element : mesh.elements) {
    for (const int place : geometry::vtk_order(element.shape))
      connectivity.push_back(element.nodes[static_cast<std::size_t>(place)]);
    types.push_back(geometry::facts(element.shape).vtk_type);
  }
  const auto of_vectors = [](const std::string& name, const std::vector<Vector3>& values) {
    return observe::CellData{name, 3, std::span<const Real>(values.empty() ? nullptr : values.front().data(), 3 * values.size())};
  };
  const std::vector<observe::CellData> of_points = {of_vectors("displacement", moved), of_vectors("velocity", velocity),
                                                    of_vectors("acceleration", acceleration)};
  const std::vector<observe::CellData> of_cells = {of_vectors("normal_stress", normal),
                                                   of_vectors("shear_stress", shear),
                                                   {"pressure", 1, std::span<const Real>(pressure)},
                                                   {"plastic_slip", 1, std::span<const Real>(slip)},
                                                   {"region", 1, std::span<const std::int32_t>(region)}};
  observe::Grid grid{observe::Grid::Cell::vertex, places, connectivity, of_cells, time};
  grid.point_data = of_points;
  grid.types = types;
  snapshots_.write(grid);
}

template <int D>
void FemRecord<D>::flush(bool to_disk) {
  if (history_) history_->flush(to_disk);
  if (gauges_) gauges_->flush(to_disk);
  if (to_disk) snapshots_.sync();
}

template <int D>
void FemRecord<D>::check_motion(Real time) const {
  const auto& moved = stepper().state().displacement;
  const auto bad = std::ranges::find_if(moved, [](Real value) { return !std::isfinite(value); });
  if (bad == moved.end()) return;
  const auto node = static_cast<std::size_t>(bad - moved.begin()) / D;
  throw PhysicsError(
      fmt::format("the displacement of node {} is no number any more, found at t = {} s\n  look at the loads and motions",
                  model_->mesh().node_tags[node], cases::short_number(time)));
}

template <int D>
std::vector<std::pair<std::string, observe::Figure>> FemRecord<D>::results(std::int64_t step, Real wall_seconds) const {
  const auto& state = stepper().state();
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"nodes", static_cast<std::int64_t>(model_->mesh().nodes.size())},
      {"elements", static_cast<std::int64_t>(model_->mesh().elements.size())},
      {"freedoms", static_cast<std::int64_t>(stepper().free_freedoms())},
      {"steps", step},
      {"step", model_->step},
      {"iterations", state.iterations},
      {"cuts", state.cuts},
      {"wall_seconds", wall_seconds},
      {"final_displacement", displacement_},
      {"peak_displacement", largest_displacement_},
      {"peak_speed", largest_speed_},
      {"peak_acceleration", largest_acceleration_}};
  for (const auto& [name, value] : energies()) results.emplace_back("energy_" + name, value);
  for (std::size_t i = 0; i < largest_forces_.size(); ++i)
    results.emplace_back(fmt::format("peak_force_{}_{}", model_->group_names[i / D], axis_names[i % D]), largest_forces_[i]);
  const auto& joints = stepper().body().joints();
  for (std::size_t set = 0; set < joints.sets().size(); ++set)
    results.emplace_back(fmt::format("slip_max_{}", joints.sets()[set].name),
                         joints.summary(set, state.displacement, state.memory.joints).largest_slip);
  return results;
}

template <int D>
std::vector<std::pair<std::string, Real>> FemRecord<D>::peak_particle_velocity() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks.emplace_back(file_->fem().gauges[i].name, peaks_[i]);
  return peaks;
}

template <int D>
std::uint64_t FemRecord<D>::state_hash() const {
  observe::Hash hash;
  const auto& state = stepper().state();
  for (const auto* column : {&state.displacement, &state.velocity, &state.memory.solids, &state.memory.joints})
    hash.add(std::as_bytes(std::span(*column)));
  return hash.value();
}

template <int D>
void FemRecord<D>::columns(Archive& archive) {
  archive("rows", rows_);
  archive("snapshots", snapshot_count_);
  archive("displacement", displacement_);
  archive("largest_displacement", largest_displacement_);
  archive("largest_speed", largest_speed_);
  archive("largest_acceleration", largest_acceleration_);
  archive("largest_forces", largest_forces_);
  archive("peaks", peaks_);
}

template class FemRecord<2>;
template class FemRecord<3>;

}  // namespace sazare::runs
