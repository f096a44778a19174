#include "sazare/methods/spheres/run/placing/clump_shape.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <span>
#include <utility>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/geometry/closed_surface.hpp"
#include "sazare/geometry/shells.hpp"
#include "sazare/geometry/surface_file.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/placing/file.hpp"

namespace sazare::runs {

namespace {

/// A gap of less than this of the sum of two radii is none: numbers of files are rounded.
constexpr Real no_gap = 0.01;

/// The balls of a rigid body must touch: what lies apart is two bodies.
void check_touching(const cases::CaseFile& file, std::size_t number, std::span<const FileBall> rows) {
  std::vector<geometry::Ball> balls;
  for (const FileBall& row : rows) balls.push_back(row.ball);
  const std::vector<bool> joined = geometry::joined_to_first(balls.size(), geometry::neighbouring_balls(balls, no_gap));
  const auto apart = std::ranges::find(joined, false) - joined.begin();
  if (apart == static_cast<std::ptrdiff_t>(joined.size())) return;
  const cases::ClumpShape& shape = file.as<cases::SpheresCase>().shapes[number];
  refuse(file, fmt::format("shapes.{}.file", number),
         fmt::format("the spheres of the rigid shape \"{}\" do not all touch: that of {}:{} is not connected with the first",
                     shape.name, shape.file.filename().string(), rows[static_cast<std::size_t>(apart)].line),
         fmt::format(
             "spheres touch when their gap is at most {} of the sum of their radii: add some between, or make two shapes of it",
             no_gap));
}

/// Every place must be within the solid or not: a surface that goes around some of it twice says neither its mass nor its
/// inertia.
void check_shells(const cases::CaseFile& file, std::size_t number, std::span<const geometry::Triangle> surface) {
  const auto fault = geometry::find_shell_fault(surface);
  if (!fault) return;
  using Kind = geometry::ShellFault::Kind;
  const std::string name = file.as<cases::SpheresCase>().shapes[number].name;
  refuse(file, fmt::format("shapes.{}.file", number),
         fault->kind == Kind::crossing
             ? fmt::format("the surface of the shape \"{}\" crosses itself: its triangles {} and {}, counted "
                           "from 1, go through each other",
                           name, fault->triangle + 1, fault->other + 1)
         : fault->kind == Kind::doubled
             ? fmt::format("parts of the surface of the shape \"{}\" overlap: triangle {}, counted from 1, "
                           "belongs to a solid that lies within another one",
                           name, fault->triangle + 1)
             : fmt::format("a part of the surface of the shape \"{}\" is inside out: that of triangle {}, "
                           "counted from 1",
                           name, fault->triangle + 1),
         "unite the solids before they are exported; a hollow has its triangles turned the other way round than the solid that "
         "holds it");
}

/// A surface around a solid.
std::vector<geometry::Triangle> solid_of(const cases::CaseFile& file, std::size_t number) {
  const cases::ClumpShape& shape = file.as<cases::SpheresCase>().shapes[number];
  std::vector<geometry::Triangle> surface = geometry::read_surface(shape.file, "", shape.scale);
  const geometry::SurfaceEdges edges = geometry::edges_of(surface);
  const std::string key = fmt::format("shapes.{}.file", number);
  if (!edges.are_closed())
    refuse(file, key,
           fmt::format("the surface of the shape \"{}\" has holes: {} edges do not belong to two triangles", shape.name,
                       edges.open + edges.crowded),
           "every edge must belong to two triangles, with corners that agree to the last digit");
  if (edges.turned > 0)
    refuse(file, key,
           fmt::format("the surface of the shape \"{}\" has triangles that are turned inside out, at {} edges", shape.name,
                       edges.turned),
           "all triangles must have the same side out: programs that mend meshes unify their normals");
  check_shells(file, number, surface);
  return surface;
}

/// The balls of a shape, and the mass properties of the body that it is.
struct Body {
  std::vector<geometry::Ball> balls;
  geometry::UnionProperties of;
  std::optional<Real> fill;
};

Body body_of(const cases::CaseFile& file, std::size_t number) {
  const cases::ClumpShape& shape = file.as<cases::SpheresCase>().shapes[number];
  Body body;
  if (shape.source == cases::ClumpSource::mesh) {
    const std::vector<geometry::Triangle> surface = solid_of(file, number);
    body.balls = geometry::fill_with_balls(surface, shape.count);
    if (body.balls.empty()) return body;
    body.of = geometry::properties_of_solid(surface);
    body.fill = geometry::properties_of_union(body.balls).volume / body.of.volume;
    return body;
  }
  if (shape.source == cases::ClumpSource::tetrapod) body.balls = geometry::tetrapod_balls(shape.height, shape.leg_spheres);
  if (shape.source == cases::ClumpSource::file) {
    const std::vector<FileBall> rows = read_balls(shape.file);
    if (shape.bonds.empty()) check_touching(file, number, rows);
    for (const FileBall& row : rows) body.balls.push_back({shape.scale * row.ball.centre, shape.scale * row.ball.radius});
  }
  if (!body.balls.empty()) body.of = geometry::properties_of_union(body.balls);
  return body;
}

/// What balls of a shape have of its mass, and which of them are bonded.
void take_apart(const cases::CaseFile& file, std::size_t number, Shape& shape) {
  const cases::SpheresCase& spheres = file.as<cases::SpheresCase>();
  const auto entry = std::ranges::find(spheres.bonds, spheres.shapes[number].bonds, &cases::BondRules::name);
  shape.bonds = static_cast<Index>(entry - spheres.bonds.begin());
  shape.neighbours = geometry::neighbouring_balls(shape.balls, entry->reach);
  const std::string key = fmt::format("shapes.{}.bonds", number), name = spheres.shapes[number].name;
  if (shape.balls.size() < 2 || !geometry::hang_together(shape.balls.size(), shape.neighbours))
    refuse(file, key, fmt::format("the spheres of the shape \"{}\" are not all connected by bonds", name),
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

Shape along_principal_axes(Shape shape, const Vector3& centre, const Matrix3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(inertia);
  shape.axes = principal.eigenvectors();
  if (shape.axes.determinant() < 0) shape.axes.col(0) = -shape.axes.col(0);
  shape.inertia = principal.eigenvalues();
  for (geometry::Ball& ball : shape.balls) {
    ball.centre = shape.axes.transpose() * (ball.centre - centre);
    shape.reach = std::max(shape.reach, ball.centre.norm() + ball.radius);
  }
  return shape;
}

Shape make_shape(const cases::CaseFile& file, std::size_t number) {
  Shape shape;
  Body body = body_of(file, number);
  shape.balls = std::move(body.balls);
  shape.fill = body.fill;
  if (shape.balls.empty())
    refuse(file, fmt::format("shapes.{}", number),
           fmt::format("the shape \"{}\" has no sphere", file.as<cases::SpheresCase>().shapes[number].name),
           "its file holds no row of radius, x, y and z, or its surface is too flat for a sphere within");
  shape.volume = body.of.volume;
  shape.error = body.of.error;
  shape = along_principal_axes(std::move(shape), body.of.centre, body.of.inertia);
  if (!file.as<cases::SpheresCase>().shapes[number].bonds.empty()) take_apart(file, number, shape);
  return shape;
}

}  // namespace sazare::runs
