#include "sazare/methods/mps/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/mps/run/columns.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

constexpr Real senseless_acceleration = 1e15;  // m/s2; [Yoshida2010], 3.3

/// The translations of a particle as a vector of three.
template <class Columns>
Vector3 vector_of(const Columns& columns, int dimension, std::size_t i) {
  Vector3 vector = Vector3::Zero();
  for (int axis = 0; axis < dimension; ++axis) vector[axis] = columns[static_cast<std::size_t>(axis)][i];
  return vector;
}

}  // namespace

template <int D>
std::vector<std::size_t> gauge_particles(const cases::CaseFile& file, const Filling<D>& filling) {
  std::vector<std::size_t> found;
  for (std::size_t number = 0; number < file.as<cases::MpsCase>().gauges.size(); ++number) {
    const cases::Gauge& gauge = file.as<cases::MpsCase>().gauges[number];
    std::size_t nearest = 0;
    Real shortest = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < filling.sites.size(); ++i) {
      const Real distance = (filling.place(i) - gauge.point.template head<D>()).norm();
      if (distance >= shortest - 1e-9 * filling.spacing) continue;
      shortest = distance;
      nearest = i;
    }
    if (shortest > filling.spacing)
      refuse(file, fmt::format("gauges.{}.point", number),
             fmt::format("gauge \"{}\" is {} m from the nearest particle", gauge.name, cases::short_number(shortest, 3)),
             "put it within a spacing of the body");
    found.push_back(nearest);
  }
  return found;
}

template <int D>
MpsRecord<D>::MpsRecord(const RunFolder& folder, const cases::CaseFile& file, MpsModel<D>& model, const RunClocks& clocks)
    : folder_(&folder),
      file_(&file),
      model_(&model),
      clocks_(clocks),
      gauge_particles_(gauge_particles<D>(file, model.filling)),
      files_(folder.snapshots(), "particles"),
      tensors_(file.as<cases::MpsCase>(), model),
      peaks_(gauge_particles_.size(), 0) {}

template <int D>
std::vector<RecordFiles::Table> MpsRecord<D>::tables() const {
  std::vector<std::string> history, gauges;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::mps::motion);
  if (has_energy_balance()) observe::add_titles(history, columns::mps::energy_balance);
  if (model_->failing != nullptr) observe::add_titles(history, columns::mps::failure);
  if (model_->at_surface != nullptr) observe::add_titles(history, columns::mps::surface);
  observe::add_titles(history, columns::clock);
  observe::add_titles(gauges, columns::time);
  for (const cases::Gauge& gauge : file_->as<cases::MpsCase>().gauges)
    observe::add_titles(gauges, columns::place_motion, gauge.name);
  return {{folder_->history(), history}, {folder_->gauges(), gauges}};
}

template <int D>
Vector3 MpsRecord<D>::displacement_of(std::size_t i) const {
  return vector_of(model_->stepper->particles().displacement, D, i) - vector_of(model_->stepper->initial_displacement(), D, i);
}

template <int D>
Real MpsRecord<D>::settlement() const {
  Real largest = 0;
  for (std::size_t i = 0; i < model_->filling.sites.size(); ++i)
    largest = std::max(largest, vector_of(model_->stepper->initial_displacement(), D, i).norm());
  return largest;
}

template <int D>
void MpsRecord<D>::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  const auto& particles = model_->stepper->particles();
  const auto velocity = model_->stepper->velocity(), acceleration = model_->stepper->acceleration();
  Real displacement = 0, speed = 0, largest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    displacement = std::max(displacement, displacement_of(i).norm());
    speed = std::max(speed, vector_of(velocity, D, i).norm());
    largest = std::max(largest, vector_of(acceleration, D, i).norm());
  }
  close_energy_balance(step == 0);
  std::vector<Real> history = {time, kinetic_, elastic_, displacement, speed, largest};
  if (has_energy_balance())
    history.insert(history.end(), {work_.gravity, work_.boundary, work_.prescribed, work_.applied, -work_.damping, residual_});
  if (const auto* failing = model_->failing) {
    const auto work = failing->work();
    history.insert(history.end(), {work.flow, work.rupture, work.contact, static_cast<Real>(failing->broken_links()),
                                   static_cast<Real>(failing->contacts())});
  }
  if (const auto* touched = surface())
    history.insert(history.end(), {touched->work(), touched->dissipated(), static_cast<Real>(touched->touching())});
  history.push_back(wall_seconds);
  files_.add_row(0, history);
  displacement_ = displacement;
  largest_displacement_ = std::max(largest_displacement_, displacement);
  largest_speed_ = std::max(largest_speed_, speed);
  largest_acceleration_ = std::max(largest_acceleration_, largest);
  std::vector<Real> row = {time};
  for (std::size_t gauge = 0; gauge < gauge_particles_.size(); ++gauge) {
    const std::size_t i = gauge_particles_[gauge];
    for (const Vector3& value : {displacement_of(i), vector_of(velocity, D, i), vector_of(acceleration, D, i)})
      row.insert(row.end(), value.begin(), value.end());
    peaks_[gauge] = std::max(peaks_[gauge], vector_of(velocity, D, i).norm());
  }
  files_.add_row(1, row);
  if (clocks_.is_snapshot(step)) write_snapshot(time, velocity, acceleration);
}

/// The residual of the energy balance: the energy of linear forces is kept to round-off with the kinetic energy of the kick.
template <int D>
void MpsRecord<D>::close_energy_balance(bool at_beginning) {
  kinetic_ = model_->stepper->kinetic_energy();
  elastic_ = model_->stepper->elastic_energy();
  if (!has_energy_balance()) return;
  work_ = model_->stepper->work();
  if (model_->free_field != nullptr) work_.boundary += model_->free_field->work();
  Real carried = model_->stepper->kinetic_energy_of_kick() + elastic_;
  if (const auto* failing = model_->failing) {
    const auto lost = failing->work();
    carried += lost.flow + lost.rupture + lost.contact;
  }
  if (surface() != nullptr) carried += surface()->dissipated() - surface()->work();
  if (at_beginning) energy_at_beginning_ = carried;
  residual_ = energy_at_beginning_ + work_.sum() - carried;
}

template <int D>
void MpsRecord<D>::write_snapshot(Real time, const state::FreedomColumns<D>& velocity,
                                  const state::FreedomColumns<D>& acceleration) {
  const auto& particles = model_->stepper->particles();
  std::vector<Vector3> place, displacement, speed, change;
  std::vector<Real> size(particles.size(), particles.spacing);
  std::vector<std::int32_t> number(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    displacement.push_back(displacement_of(i));
    place.push_back(vector_of(particles.start, D, i) + vector_of(particles.displacement, D, i));
    speed.push_back(vector_of(velocity, D, i));
    change.push_back(vector_of(acceleration, D, i));
    number[i] = static_cast<std::int32_t>(i);
  }
  std::vector<observe::CellData> data =
      observe::cell_data(columns::mps::particles, displacement, speed, change, model_->filling.region, model_->material, size, supported());
  for (const observe::CellData& one : tensors_.measure()) data.push_back(one);
  std::vector<Real> slip, broken, sheared;
  if (const auto* failing = model_->failing) {
    const state::Column& all = failing->strength().slip();
    slip.assign(all.data(), all.data() + particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) broken.push_back(failing->broken_fraction(static_cast<Index>(i)));
    for (const observe::CellData& one : observe::cell_data(columns::mps::failed_particles, slip, broken)) data.push_back(one);
    if (const auto& degrading = failing->strength().degrading(); !degrading.empty()) {
      for (std::size_t i = 0; i < particles.size(); ++i) sheared.push_back(degrading.peak(static_cast<Index>(i)));
      for (const observe::CellData& one : observe::cell_data(columns::mps::degraded_particles, sheared)) data.push_back(one);
    }
  }
  files_.add_snapshot({observe::Grid::Cell::vertex, place, number, data, time});
}

/// By particle: 0 free, 1 held, 2 prescribed, 3 on a viscous boundary, 4 on a free-field side.
template <int D>
const std::vector<std::int32_t>& MpsRecord<D>::supported() {
  if (!supported_.empty()) return supported_;
  const auto& supports = model_->stepper->supports();
  supported_.assign(model_->filling.sites.size(), 0);
  for (const auto& held : supports.held) supported_[at(held.particle)] = 1;
  for (const auto& dashpot : supports.dashpots) supported_[at(dashpot.particle)] = dashpot.is_beside_column ? 4 : 3;
  for (const auto& driven : supports.driven) supported_[at(driven.particle)] = 2;
  return supported_;
}

template <int D>
void MpsRecord<D>::check_motion(Real time) const {
  const Real largest = model_->stepper->largest_acceleration();
  if (largest < senseless_acceleration) return;
  const Real limit = model_->stable_step(file_->as<cases::MpsCase>().time);
  throw PhysicsError(fmt::format(
      "the motion of the particles diverged at t = {} s: the largest acceleration is {} m/s2, above {} m/s2\n  the step of {} s "
      "is {} times the limit of {} s predicted for small motion: set time.stability_fraction = 0.5, or check the loads",
      cases::short_number(time), cases::short_number(largest, 3), cases::short_number(senseless_acceleration, 3),
      cases::short_number(model_->step, 4), cases::short_number(model_->step / limit, 3), cases::short_number(limit, 4)));
}

/// The largest plastic shear strain of particles with a link to others [-].
template <int D>
Real unbroken_shear_strain(const methods::mps::FailingForces<D>& failing, Index particles) {
  Real largest = 0;
  for (Index i = 0; i < particles; ++i)
    if (failing.broken_fraction(i) < 1) largest = std::max(largest, failing.strength().plastic_shear(i));
  return largest;
}

template <int D>
std::vector<std::pair<std::string, observe::Figure>> MpsRecord<D>::results(std::int64_t step, Real wall_seconds) const {
  const auto particles = static_cast<std::int64_t>(model_->filling.sites.size());
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"particles", particles},
      {"steps", step},
      {"step", model_->step},
      {"predicted_limit", model_->stable_step(file_->as<cases::MpsCase>().time)},
      {"largest_frequency", model_->limit.frequency},
      {"particle_steps", particles * step},
      {"wall_seconds", wall_seconds},
      {"energy_kinetic", kinetic_},
      {"energy_elastic", elastic_},
      {"peak_displacement", largest_displacement_},
      {"peak_speed", largest_speed_},
      {"peak_acceleration", largest_acceleration_}};
  results.emplace_back("final_displacement", displacement_);
  if (has_energy_balance())
    results.insert(results.end(), {{"energy_work_gravity", work_.gravity},
                                   {"energy_work_viscous", work_.boundary},
                                   {"energy_work_boundary", work_.prescribed},
                                   {"energy_work_applied", work_.applied},
                                   {"energy_damping", -work_.damping},
                                   {"energy_residual", residual_}});
  if (file_->as<cases::MpsCase>().gravity.settle) results.emplace_back("settlement", settlement());
  if (const auto* failing = model_->failing) {
    const auto work = failing->work();
    results.insert(results.end(), {{"broken_links", static_cast<std::int64_t>(failing->broken_links())},
                                   {"unbroken_shear_strain", unbroken_shear_strain<D>(*failing, particles)},
                                   {"energy_plastic", work.flow},
                                   {"energy_fracture", work.rupture},
                                   {"energy_contact", work.contact}});
  }
  if (const auto* touched = surface())
    results.insert(results.end(), {{"energy_work_surface", touched->work()}, {"energy_surface_contact", touched->dissipated()}});
  for (const cases::Motion& motion : file_->as<cases::MpsCase>().motions) {
    if (motion.type != cases::MotionShape::record || motion.quantity != laws::MotionQuantity::acceleration) continue;
    results.emplace_back(fmt::format("drift_velocity_{}", motion.name), motion.amplitude * motion.record.first.back());
    results.emplace_back(fmt::format("drift_displacement_{}", motion.name), motion.amplitude * motion.record.second.back());
  }
  return results;
}

template <int D>
std::vector<std::pair<std::string, Real>> MpsRecord<D>::peak_particle_velocity() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks.emplace_back(file_->as<cases::MpsCase>().gauges[i].name, peaks_[i]);
  return peaks;
}

template <int D>
std::uint64_t MpsRecord<D>::state_hash() const {
  observe::Hash hash;
  const auto& particles = model_->stepper->particles();
  const auto add = [&](const state::Column& column) { hash.add(std::as_bytes(std::span(column.data(), particles.size()))); };
  for (const auto& column : particles.displacement) add(column);
  for (const auto& column : particles.rotation) add(column);
  for (const auto& column : particles.velocity) add(column);
  return hash.value();
}

template <int D>
void MpsRecord<D>::columns(Archive& archive) {
  files_.columns(archive);
  archive("displacement", displacement_);
  archive("largest_displacement", largest_displacement_);
  archive("largest_speed", largest_speed_);
  archive("largest_acceleration", largest_acceleration_);
  archive("kinetic", kinetic_);
  archive("elastic", elastic_);
  archive("energy_at_beginning", energy_at_beginning_);
  archive("gravity", work_.gravity);
  archive("boundary", work_.boundary);
  archive("prescribed", work_.prescribed);
  archive("damping", work_.damping);
  archive("applied", work_.applied);
  archive("residual", residual_);
  archive("peaks", peaks_);
}

template std::vector<std::size_t> gauge_particles<2>(const cases::CaseFile&, const Filling<2>&);
template std::vector<std::size_t> gauge_particles<3>(const cases::CaseFile&, const Filling<3>&);
template class MpsRecord<2>;
template class MpsRecord<3>;

}  // namespace sazare::runs
