#include "sazare/runs/clump_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <utility>

#include "sazare/cases/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/geometry/surface_file.hpp"

namespace sazare::runs {

namespace {

std::vector<geometry::Ball> balls_of(const cases::CaseFile& file, std::size_t number) {
  const cases::ClumpShape& shape = file.spheres().shapes[number];
  if (shape.source == cases::ClumpSource::tetrapod) return geometry::tetrapod_balls(shape.height, shape.leg_spheres);
  if (shape.source == cases::ClumpSource::file) {
    std::vector<geometry::Ball> balls = read_balls(shape.file);
    for (geometry::Ball& ball : balls) ball = {shape.scale * ball.centre, shape.scale * ball.radius};
    return balls;
  }
  const std::vector<geometry::Triangle> surface = geometry::read_surface(shape.file, "", shape.scale);
  if (!geometry::is_closed(surface))
    refuse(file, fmt::format("shapes.{}.file", number), fmt::format("the surface of the shape \"{}\" has holes", shape.name),
           "every edge must belong to two triangles, with corners that agree to the last digit");
  return geometry::fill_with_balls(surface, shape.count);
}

/// What balls of a shape have of its mass, and which of them are bonded.
void take_apart(const cases::CaseFile& file, std::size_t number, Shape& shape) {
  const cases::SpheresCase& spheres = file.spheres();
  const auto entry = std::ranges::find(spheres.bonds, spheres.shapes[number].bonds, &cases::BondRules::name);
  shape.bonds = static_cast<Index>(entry - spheres.bonds.begin());
  shape.neighbours = geometry::neighbouring_balls(shape.balls, entry->reach);
  const std::string key = fmt::format("shapes.{}.bonds", number), name = spheres.shapes[number].name;
  if (shape.balls.size() < 2 || !geometry::hang_together(shape.balls.size(), shape.neighbours))
    refuse(file, key, fmt::format("the spheres of the shape \"{}\" do not hang together by bonds", name),
           fmt::format("neighbours are bonded whose gap is at most reach = {} of the sum of their radii",
                       cases::short_number(entry->reach)));
  geometry::MassShares shares = geometry::share_mass(shape.balls, shape.volume, shape.inertia);
  if (shares.of.empty())
    refuse(file, key, fmt::format("the mass of the shape \"{}\" cannot be shared out among its spheres", name),
           "its centre of mass lies outside of them: use more spheres, spread over the shape");
  shape.shares = std::move(shares.of);
  shape.share_error = shares.error;
}

}  // namespace

std::vector<std::vector<Real>> read_rows(const std::filesystem::path& file, std::size_t count, const std::string& expected) {
  std::ifstream stream(file);
  if (!stream) throw UserError(fmt::format("{}: the file of spheres cannot be read", file.string()));
  std::vector<std::vector<Real>> rows;
  std::string line;
  bool may_be_titles = true;  // of the columns, in the first line that is not empty
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::ranges::replace(line, ',', ' ');
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    if (std::exchange(may_be_titles, false) && std::isalpha(static_cast<unsigned char>(line[begin])) != 0) continue;
    std::istringstream words(line);
    std::vector<Real> row(count);
    bool good = std::ranges::all_of(row, [&](Real& value) { return static_cast<bool>(words >> value); });
    std::string rest;
    good = good && !(words >> rest);
    if (!good) throw UserError(fmt::format("{}:{}: {}, found \"{}\"", file.string(), number, expected, line));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<geometry::Ball> read_balls(const std::filesystem::path& file) {
  std::vector<geometry::Ball> balls;
  for (const auto& row : read_rows(file, 4, "four numbers were expected, radius, x, y and z in m")) {
    balls.push_back({{row[1], row[2], row[3]}, row[0]});
    if (!(balls.back().radius > 0) || !balls.back().centre.allFinite())
      throw UserError(
          fmt::format("{}: sphere {}: a radius greater than 0 and a finite centre were expected, found {} at ({}, {}, {})",
                      file.string(), balls.size(), row[0], row[1], row[2], row[3]));
  }
  return balls;
}

Shape make_shape(const cases::CaseFile& file, std::size_t number) {
  Shape shape;
  shape.balls = balls_of(file, number);
  if (shape.balls.empty())
    refuse(file, fmt::format("shapes.{}", number),
           fmt::format("the shape \"{}\" has no sphere", file.spheres().shapes[number].name),
           "its file holds no row of radius, x, y and z, or its surface is too flat for a sphere within");
  const geometry::UnionProperties of = geometry::properties_of_union(shape.balls);
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(of.inertia);
  shape.axes = principal.eigenvectors();
  if (shape.axes.determinant() < 0) shape.axes.col(0) = -shape.axes.col(0);
  shape.volume = of.volume;
  shape.inertia = principal.eigenvalues();
  shape.error = of.error;
  for (geometry::Ball& ball : shape.balls) {
    ball.centre = shape.axes.transpose() * (ball.centre - of.centre);
    shape.reach = std::max(shape.reach, ball.centre.norm() + ball.radius);
  }
  if (!file.spheres().shapes[number].bonds.empty()) take_apart(file, number, shape);
  return shape;
}

}  // namespace sazare::runs
