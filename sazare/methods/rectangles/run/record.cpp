#include "sazare/methods/rectangles/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/rectangles/run/columns.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

using geometry::OutlineKind;
using geometry::Vector2;
using methods::rectangles::FaceLinks;
constexpr Real senseless_acceleration = 1e15;  // m/s2

Vector3 vector_of(const auto& columns, std::size_t i) { return {columns[0][i], columns[1][i], 0}; }

bool is_inside(const geometry::Outline& outline, const Vector2& point) {
  const Vector2 apart = point - outline.centre;
  constexpr Real edge = 1 + 1e-9;
  if (outline.kind == OutlineKind::polygon)
    return geometry::holds(outline.corners, {outline.axis.dot(apart), outline.other_axis().dot(apart)},
                           (1 - edge) * outline.half_width);
  return std::abs(outline.axis.dot(apart)) <= edge * outline.half_width &&
         std::abs(outline.other_axis().dot(apart)) <= edge * outline.half_height;
}

/// From its centre, in its own axes, counter-clockwise.
std::vector<Vector2> corners_of(const geometry::Outline& outline) {
  if (outline.kind == OutlineKind::polygon) return {outline.corners.begin(), outline.corners.end()};
  const Real x = outline.half_width, y = outline.half_height;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

std::int32_t face_bit(int face) { return static_cast<std::int32_t>(1U << face); }

std::vector<std::string> support_names(const cases::RectanglesCase& rectangles) {
  std::vector<std::string> names;
  for (const cases::Wall& wall : rectangles.walls) names.push_back(wall.name);
  for (const cases::Roller& roller : rectangles.rollers) names.push_back(roller.name);
  return names;
}

}  // namespace

std::vector<std::size_t> gauge_elements(const cases::CaseFile& file, const RectanglesModel& model) {
  std::vector<std::size_t> found;
  const auto& gauges = file.as<cases::RectanglesCase>().gauges;
  for (std::size_t number = 0; number < gauges.size(); ++number) {
    std::size_t element = 0;
    const auto elements = static_cast<std::size_t>(model.elements);
    while (element < elements &&
           !is_inside(model.forces->outlines().at(model.stepper->particles(), element), gauges[number].point.head<2>()))
      ++element;
    if (element == elements)
      refuse(file, fmt::format("gauges.{}.point", number), fmt::format("gauge \"{}\" is in no element", gauges[number].name),
             "put it inside a block");
    found.push_back(element);
  }
  return found;
}

RectanglesRecord::RectanglesRecord(const RunFolder& folder, const cases::CaseFile& file, RectanglesModel& model,
                                   const RunClocks& clocks)
    : folder_(&folder),
      file_(&file),
      model_(&model),
      clocks_(clocks),
      supports_(support_names(file.as<cases::RectanglesCase>())),
      gauge_elements_(gauge_elements(file, model)),
      files_(folder.snapshots(), "rectangles"),
      peaks_(gauge_elements_.size(), 0),
      largest_force_(supports_.size(), 0) {}

std::vector<RecordFiles::Table> RectanglesRecord::tables() const {
  std::vector<std::string> history, gauges;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::rectangles::history);
  for (const std::string& name : supports_) observe::add_titles(history, columns::rectangles::support, name);
  observe::add_titles(history, columns::clock);
  observe::add_titles(gauges, columns::time);
  for (const cases::Gauge& gauge : file_->as<cases::RectanglesCase>().gauges) {
    observe::add_titles(gauges, columns::place_motion, gauge.name);
    observe::add_titles(gauges, columns::rectangles::gauge_rotation, gauge.name);
  }
  return {{folder_->history(), history}, {folder_->gauges(), gauges}};
}

EnergyBalance RectanglesRecord::balance() const {
  const auto& particles = model_->stepper->particles();
  EnergyBalance now;
  now.kinetic = model_->stepper->kinetic_energy();
  now.energies = model_->forces->energy_parts(particles);
  const auto gravity = model_->stepper->supports().gravity;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model_->elements); ++i)
    now.work +=
        (gravity.x() * particles.displacement[0][i] + gravity.y() * particles.displacement[1][i]) / particles.inverse_mass[i];
  now.work +=
      now.energies.supports + now.energies.surface + now.energies.base_friction + model_->stepper->applied_work() + energy_at_beginning_;
  now.residual = now.work - now.kinetic - now.energies.elastic - now.energies.lost();
  return now;
}

void RectanglesRecord::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  const auto velocity = model_->stepper->velocity(), acceleration = model_->stepper->acceleration();
  if (step == 0) {
    const EnergyBalance beginning = balance();
    energy_at_beginning_ = beginning.kinetic + beginning.energies.elastic;
  }
  const auto& particles = model_->stepper->particles();
  for (std::size_t i = 0; i < static_cast<std::size_t>(model_->elements); ++i) {
    largest_displacement_ = std::max(largest_displacement_, vector_of(particles.displacement, i).norm());
    largest_speed_ = std::max(largest_speed_, vector_of(velocity, i).norm());
  }
  add_history(time, wall_seconds);
  add_gauges(time, velocity, acceleration);
  if (clocks_.is_snapshot(step)) write_snapshot(time, velocity);
}

void RectanglesRecord::add_history(Real time, Real wall_seconds) {
  balance_ = balance();
  const auto& energies = balance_.energies;
  const auto& links = model_->forces->links();
  std::vector<Real> row = {time,
                           balance_.kinetic,
                           energies.elastic,
                           energies.links.dashpot,
                           energies.links.friction,
                           energies.links.fracture,
                           energies.contacts.dashpot,
                           energies.contacts.friction,
                           balance_.work,
                           balance_.residual,
                           static_cast<Real>(links.broken_springs()),
                           static_cast<Real>(links.broken_links()),
                           static_cast<Real>(model_->forces->contacts().touching()),
                           largest_displacement_,
                           largest_speed_};
  const auto& particles = model_->stepper->particles();
  for (std::size_t k = 0; k < supports_.size(); ++k) {
    const auto& force = model_->forces->support_force(static_cast<Index>(k));
    const std::size_t i = static_cast<std::size_t>(model_->elements) + k;
    row.insert(row.end(), {force[0], force[1], particles.displacement[0][i], particles.displacement[1][i]});
    largest_force_[k] = std::max(largest_force_[k], std::hypot(force[0], force[1]));
  }
  row.push_back(wall_seconds);
  files_.add_row(0, row);
}

void RectanglesRecord::add_gauges(Real time, const state::FreedomColumns<2>& velocity,
                                  const state::FreedomColumns<2>& acceleration) {
  const auto& particles = model_->stepper->particles();
  std::vector<Real> row = {time};
  for (std::size_t gauge = 0; gauge < gauge_elements_.size(); ++gauge) {
    const std::size_t i = gauge_elements_[gauge];
    for (const Vector3& value : {vector_of(particles.displacement, i), vector_of(velocity, i), vector_of(acceleration, i)})
      row.insert(row.end(), value.begin(), value.end());
    row.push_back(particles.angle[i] -
                  file_->as<cases::RectanglesCase>()
                          .blocks[static_cast<std::size_t>(
                              model_->case_block[static_cast<std::size_t>(model_->forces->outlines().block[i])])]
                          .angle *
                      std::numbers::pi / 180);
    peaks_[gauge] = std::max(peaks_[gauge], vector_of(velocity, i).norm());
  }
  files_.add_row(1, row);
}

/// A polygon for each outline, a circle as the square about it, a wall without height; `broken` are the faces whose link has lost
/// a spring, as bits: of a polygon from its n-th point to the next.
void RectanglesRecord::write_snapshot(Real time, const state::FreedomColumns<2>& velocity) {
  const auto& particles = model_->stepper->particles();
  const auto& outlines = model_->forces->outlines();
  const FaceLinks& links = model_->forces->links();
  std::vector<Vector3> corners, displacement, speed;
  std::vector<std::int32_t> connectivity, block, kind, broken(outlines.size(), 0);
  std::vector<Real> rotation;
  std::vector<std::int64_t> ends;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const geometry::Outline outline = outlines.at(particles, i);
    for (const Vector2& own : corners_of(outline)) {
      const Vector2 corner = outline.centre + own.x() * outline.axis + own.y() * outline.other_axis();
      connectivity.push_back(static_cast<std::int32_t>(corners.size()));
      corners.emplace_back(corner.x(), corner.y(), 0);
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
    displacement.push_back(vector_of(particles.displacement, i));
    speed.push_back(vector_of(velocity, i));
    rotation.push_back(particles.angle[i]);
    block.push_back(outlines.block[i] < 0 ? -1 : model_->case_block[static_cast<std::size_t>(outlines.block[i])]);
    kind.push_back(static_cast<std::int32_t>(outlines.kind[i]));
  }
  for (Index number = 0; number < links.count(); ++number) {
    if (!links.has_broken(number)) continue;
    broken[static_cast<std::size_t>(links.link(number).first)] |= face_bit(links.first_face(number));
    broken[static_cast<std::size_t>(links.link(number).second)] |= face_bit(links.second_face(number));
  }
  files_.add_snapshot({observe::Grid::Cell::polygon, corners, connectivity,
                       observe::cell_data(columns::rectangles::elements, displacement, speed, rotation, block, kind, broken),
                       time, ends});
}

void RectanglesRecord::check_motion(Real time) const {
  const Real largest = model_->stepper->largest_acceleration();
  if (largest < senseless_acceleration) return;
  throw PhysicsError(
      fmt::format("the motion of the elements diverged at t = {} s: the largest acceleration is {} m/s2\n  the step of {} s is "
                  "{} times the limit predicted for small motion: set time.stability_fraction = 0.4, or check the loads",
                  cases::short_number(time), cases::short_number(largest, 3), cases::short_number(model_->step, 4),
                  cases::short_number(model_->step / model_->limit.limit, 3)));
}

std::vector<std::pair<std::string, observe::Figure>> RectanglesRecord::results(std::int64_t step, Real wall_seconds) const {
  const auto elements = static_cast<std::int64_t>(model_->elements);
  const auto& links = model_->forces->links();
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"elements", elements},
      {"steps", step},
      {"step", model_->step},
      {"predicted_limit", model_->limit.limit},
      {"element_steps", elements * step},
      {"wall_seconds", wall_seconds},
      {"broken_springs", static_cast<std::int64_t>(links.broken_springs())},
      {"broken_links", static_cast<std::int64_t>(links.broken_links())},
      {"energy_work", balance_.work},
      {"energy_residual", balance_.residual},
      {"peak_displacement", largest_displacement_},
      {"peak_speed", largest_speed_}};
  for (std::size_t k = 0; k < supports_.size(); ++k)
    results.emplace_back(fmt::format("peak_force_{}", supports_[k]), largest_force_[k]);
  return results;
}

std::vector<std::pair<std::string, Real>> RectanglesRecord::peak_particle_velocity() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < peaks_.size(); ++i)
    peaks.emplace_back(file_->as<cases::RectanglesCase>().gauges[i].name, peaks_[i]);
  return peaks;
}

std::uint64_t RectanglesRecord::state_hash() const {
  observe::Hash hash;
  const auto& particles = model_->stepper->particles();
  const auto add = [&](const state::Column& column) { hash.add(std::as_bytes(std::span(column.data(), particles.size()))); };
  for (const auto& column : particles.displacement) add(column);
  add(particles.angle);
  for (const auto& column : particles.velocity) add(column);
  return hash.value();
}

void RectanglesRecord::columns(Archive& archive) {
  files_.columns(archive);
  archive("largest_displacement", largest_displacement_);
  archive("largest_speed", largest_speed_);
  archive("largest_force", largest_force_);
  archive("energy_at_beginning", energy_at_beginning_);
  archive("work", balance_.work);
  archive("residual", balance_.residual);
  archive("peaks", peaks_);
}

}  // namespace sazare::runs
