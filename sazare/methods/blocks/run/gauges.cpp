#include "sazare/methods/blocks/run/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/material_points.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

/// Share of an element's height by which a point may lie outside and still count as on its surface.
constexpr Real on_surface = 1e-9;

/// The smallest of the point's four barycentric coordinates: negative outside.
Real depth_in(const geometry::Tetrahedron& corners, const Vector3& point) {
  Real depth = std::numeric_limits<Real>::infinity();
  for (std::size_t face = 0; face < 4; ++face) {
    const Vector3 area = geometry::face_area_vector(corners, static_cast<int>(face));
    const Vector3& on_face = corners[static_cast<std::size_t>(geometry::tetrahedron_faces[face][0])];
    depth = std::min(depth, area.dot(on_face - point) / area.dot(on_face - corners[face]));
  }
  return depth;
}

Index nearest_element(const geometry::TetraMesh& mesh, const Vector3& point) {
  Index nearest = 0;
  Real shortest = std::numeric_limits<Real>::infinity();
  for (Index element = 0; element < static_cast<Index>(mesh.tetrahedra.size()); ++element) {
    const Real distance = (geometry::centroid(geometry::corners_of(mesh, element)) - point).norm();
    if (distance >= shortest) continue;
    shortest = distance;
    nearest = element;
  }
  return nearest;
}

std::string point_text(const Vector3& point) {
  return fmt::format("({}, {}, {})", cases::short_number(point.x()), cases::short_number(point.y()),
                     cases::short_number(point.z()));
}

}  // namespace

void GaugePeak::raise(Real now, const Vector3& velocity) {
  if (velocity.norm() > speed) {
    speed = velocity.norm();
    time = now;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    components[axis] = std::max(components[axis], std::abs(velocity[static_cast<Eigen::Index>(axis)]));
}

void GaugePeak::raise(const GaugePeak& other) {
  if (other.speed > speed || (other.speed == speed && other.time < time)) {
    speed = other.speed;
    time = other.time;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) components[axis] = std::max(components[axis], other.components[axis]);
}

Index element_at(const geometry::TetraMesh& mesh, const Vector3& point) {
  for (Index element = 0; element < static_cast<Index>(mesh.tetrahedra.size()); ++element)
    if (depth_in(geometry::corners_of(mesh, element), point) >= -on_surface) return element;
  return -1;
}

Gauges::Gauges(const cases::CaseFile& file, const geometry::TetraMesh& mesh) {
  for (std::size_t i = 0; i < file.as<cases::BlocksCase>().gauges.size(); ++i) {
    const cases::Gauge& gauge = file.as<cases::BlocksCase>().gauges[i];
    const Index element = element_at(mesh, gauge.point);
    if (element < 0) {
      const Index nearest = nearest_element(mesh, gauge.point);
      refuse(file, fmt::format("gauges.{}.point", i),
             fmt::format("gauge \"{}\" at {} m is in no element", gauge.name, point_text(gauge.point)),
             fmt::format("the nearest element is {}, with its centre at {} m", element_tag(mesh, nearest),
                         point_text(geometry::centroid(geometry::corners_of(mesh, nearest)))));
    }
    names_.push_back(gauge.name);
    points_.push_back(gauge.point);
    elements_.push_back(element);
  }
  peaks_.resize(names_.size());
}

std::vector<std::string> Gauges::titles() const {
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::time);
  for (const std::string& name : names_) observe::add_titles(titles, columns::blocks::gauge, name);
  return titles;
}

std::vector<Real> Gauges::sample(Real time, const state::Bodies<3>& bodies, const levels::Snapshot<3>& now) {
  std::vector<Real> row = {time};
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const Vector3 velocity = point_velocity(bodies, body_of(now, elements_[i]), elements_[i], points_[i]);
    row.insert(row.end(), velocity.begin(), velocity.end());
    peaks_[i].raise(time, velocity);
  }
  return row;
}

void Gauges::watch(Real time, const levels::Simulation<3>& simulation) {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (simulation.owns(elements_[i]))
      peaks_[i].raise(time, point_velocity(simulation.bodies(), simulation.body_now(elements_[i]), elements_[i], points_[i]));
}

void Gauges::unite(const parallel::Ranks& ranks) {
  const parallel::Gathered all = ranks.gather(std::as_bytes(std::span(peaks_)), parallel::Topic::rows);
  std::vector<GaugePeak> others(peaks_.size());
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (peaks_.empty()) return;
    std::memcpy(static_cast<void*>(others.data()), all.of(rank).data(), all.of(rank).size());
    for (std::size_t i = 0; i < peaks_.size(); ++i) peaks_[i].raise(others[i]);
  }
}

std::vector<std::pair<std::string, Real>> Gauges::peaks() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < names_.size(); ++i) peaks.emplace_back(names_[i], peaks_[i].speed);
  return peaks;
}

void Gauges::write_peaks(const std::filesystem::path& file) const {
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::blocks::gauge_peaks);
  std::vector<std::vector<observe::CsvField>> rows;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    auto& row = rows.emplace_back(std::vector<observe::CsvField>{names_[i]});
    row.insert(row.end(), points_[i].begin(), points_[i].end());
    row.insert(row.end(), {peaks_[i].speed, peaks_[i].time});
    row.insert(row.end(), peaks_[i].components.begin(), peaks_[i].components.end());
  }
  observe::write_csv(file, titles, rows);
}

}  // namespace sazare::runs
