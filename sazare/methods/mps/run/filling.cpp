#include "sazare/methods/mps/run/filling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/machine_memory.hpp"
#include "sazare/geometry/gmsh/mesher.hpp"
#include "sazare/geometry/gmsh/reader.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

using cases::RegionShape;
constexpr Real tolerance = 1e-6;  // of a spacing
constexpr Real most_sites = 2e9;
constexpr Real bytes_of_particle = 500;  // at least, with its links in the plane

/// A region as a bounding box and a test whether it holds a point.
struct Shape {
  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity());
  Vector3 upper = Vector3::Constant(-std::numeric_limits<Real>::infinity());
  std::function<bool(const Vector3&)> holds;

  void include(const Vector3& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
};

/// A rectangle holds the particles that lie inside it as a whole.
Shape rectangle_shape(const cases::ParticleRegion& region, const cases::ParticleRules& rules) {
  Shape shape;
  shape.lower = region.lower;
  shape.upper = region.upper;
  shape.holds = [&region, &rules](const Vector3& center) {
    const Real margin = (0.5 - tolerance) * rules.spacing;
    for (int axis = 0; axis < rules.dimension; ++axis)
      if (center[axis] < region.lower[axis] + margin || center[axis] > region.upper[axis] - margin) return false;
    return true;
  };
  return shape;
}

/// A polygon holds the particles whose centres lie inside: crossings of the ray to the right are counted.
Shape polygon_shape(const cases::ParticleRegion& region) {
  Shape shape;
  for (const auto& point : region.points) shape.include({point[0], point[1], 0});
  shape.holds = [&region](const Vector3& center) {
    bool inside = false;
    for (std::size_t i = 0; i + 1 < region.points.size(); ++i) {
      const auto &a = region.points[i], &b = region.points[i + 1];
      if ((a[1] > center.y()) == (b[1] > center.y())) continue;
      if (center.x() < a[0] + (center.y() - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
    }
    return inside;
  };
  return shape;
}

/// The tetrahedra of a group.
Shape mesh_shape(const cases::CaseFile& file, std::size_t number) {
  const cases::ParticleRegion& region = file.as<cases::MpsCase>().regions[number];
  std::filesystem::path source = region.file;
  std::optional<TemporaryFolder> folder;
  if (source.extension() == ".geo") {
    source = folder.emplace().path() / "region.msh";
    geometry::mesh_geometry({region.file, source, {}, 1});
  }
  const geometry::TetraMesh mesh = geometry::read_gmsh(source, 1);
  const auto found = std::ranges::find(mesh.region_names, region.group);
  if (found == mesh.region_names.end())
    refuse(file, fmt::format("regions.{}.group", number), fmt::format("the mesh has no volume group \"{}\"", region.group),
           fmt::format("its groups: {}", fmt::join(mesh.region_names, ", ")));
  Shape shape;
  std::vector<geometry::Tetrahedron> tetrahedra;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    if (mesh.region[i] != found - mesh.region_names.begin()) continue;
    tetrahedra.push_back(geometry::corners_of(mesh, static_cast<Index>(i)));
    for (const Vector3& corner : tetrahedra.back()) shape.include(corner);
  }
  shape.holds = [tetrahedra](const Vector3& center) {
    return std::ranges::any_of(tetrahedra, [&](const geometry::Tetrahedron& corners) {
      for (std::size_t face = 0; face < 4; ++face) {
        const Vector3& on_face = corners[static_cast<std::size_t>(geometry::tetrahedron_faces[face][0])];
        if (geometry::face_area_vector(corners, static_cast<int>(face)).dot(center - on_face) > 0) return false;
      }
      return true;
    });
  };
  return shape;
}

std::vector<Shape> shapes_of(const cases::CaseFile& file) {
  const cases::MpsCase& mps = file.as<cases::MpsCase>();
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < mps.regions.size(); ++i) {
    const cases::ParticleRegion& region = mps.regions[i];
    shapes.push_back(region.shape == RegionShape::rectangle ? rectangle_shape(region, mps.particles)
                     : region.shape == RegionShape::polygon ? polygon_shape(region)
                                                            : mesh_shape(file, i));
  }
  return shapes;
}

/// Rectangles with exact fit stand on the lattice of all.
void check_on_lattice(const cases::CaseFile& file, const Vector3& origin) {
  const cases::MpsCase& mps = file.as<cases::MpsCase>();
  if (mps.particles.fit == cases::ParticleFit::inside) return;
  for (std::size_t i = 0; i < mps.regions.size(); ++i)
    for (int axis = 0; axis < mps.particles.dimension; ++axis) {
      if (mps.regions[i].shape != RegionShape::rectangle) continue;
      const Real place = (mps.regions[i].lower[axis] - origin[axis]) / mps.particles.spacing;
      if (std::abs(place - std::round(place)) <= tolerance) continue;
      refuse(
          file, fmt::format("regions.{}.lower", i),
          fmt::format("the spacing does not fit the region: it begins {} spacings from the beginning of the body on the axis {}",
                      cases::short_number(place), "xyz"[axis]),
          "all regions share one lattice: choose a spacing that divides their distances, or fit = \"inside\"");
    }
}

}  // namespace

template <int D>
Filling<D> fill_regions(const cases::CaseFile& file) {
  const cases::ParticleRules& rules = file.as<cases::MpsCase>().particles;
  const std::vector<Shape> shapes = shapes_of(file);
  Vector3 lower = shapes.front().lower, upper = shapes.front().upper;
  for (const Shape& shape : shapes) {
    lower = lower.cwiseMin(shape.lower);
    upper = upper.cwiseMax(shape.upper);
  }
  check_on_lattice(file, lower);
  Filling<D> filling;
  filling.spacing = rules.spacing;
  std::array<std::int64_t, D> counts;
  Real total = 1;
  for (int axis = 0; axis < D; ++axis) {
    filling.origin[axis] = lower[axis];
    const Real count = std::ceil((upper[axis] - lower[axis]) / rules.spacing - tolerance);
    total *= count;
    counts[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::min(count, most_sites));
  }
  if (total > most_sites)
    refuse(file, "particles.spacing", fmt::format("the regions would contain about {} particles", cases::short_number(total, 2)),
           "choose a larger spacing");
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
  std::vector<std::size_t> held(shapes.size(), 0);
  const Real memory = machine_memory();
  for (std::int64_t number = 0; number < static_cast<std::int64_t>(total); ++number) {
    methods::mps::Site<D> site;
    std::int64_t rest = number / counts[longest];
    site[longest] = static_cast<int>(number % counts[longest]);
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (axis == longest) continue;
      site[axis] = static_cast<int>(rest % counts[axis]);
      rest /= counts[axis];
    }
    Vector3 center = Vector3::Zero();
    for (int axis = 0; axis < D; ++axis)
      center[axis] = lower[axis] + (site[static_cast<std::size_t>(axis)] + 0.5) * rules.spacing;
    for (std::size_t i = shapes.size(); i-- > 0;) {
      if (!shapes[i].holds(center)) continue;
      filling.sites.push_back(site);
      if (static_cast<Real>(filling.sites.size()) * bytes_of_particle > memory)
        refuse(file, "particles.spacing",
               fmt::format("the regions would contain more than {} particles, of {} at most",
                           cases::short_number(static_cast<Real>(filling.sites.size()), 2), cases::short_number(total, 2)),
               fmt::format("this machine has {} GB of memory, and a particle needs {} bytes or more: choose a larger spacing",
                           cases::short_number(1e-9 * memory, 3), bytes_of_particle));
      filling.region.push_back(static_cast<Index>(i));
      ++held[i];
      break;
    }
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] == 0)
      refuse(file, fmt::format("regions.{}", i),
             fmt::format("the region \"{}\" contains no particle", file.as<cases::MpsCase>().regions[i].name),
             "choose a smaller spacing; where regions overlap, the last one of the case applies");
  return filling;
}

template Filling<2> fill_regions<2>(const cases::CaseFile&);
template Filling<3> fill_regions<3>(const cases::CaseFile&);

}  // namespace sazare::runs
