#include "sazare/methods/blocks/run/blasting/half_casts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "sazare/observe/csv_writer.hpp"

namespace sazare::runs {

namespace {

constexpr int cuts = 400;

struct Axis {
  Vector3 point, direction;
};

/// The angle of a triangle around an axis where a plane across the axis cuts it, `along` the axis from its point [rad].
Real angle_at(const Axis& axis, Real along, const std::array<Vector3, 3>& corners) {
  std::array<Vector3, 3> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 a = corners[i] - axis.point, b = corners[(i + 1) % 3] - axis.point;
    const Real low = a.dot(axis.direction), high = b.dot(axis.direction);
    if ((low < along) == (high < along)) continue;
    ends[count++] = a + (along - low) / (high - low) * (b - a) - along * axis.direction;
  }
  return count < 2 ? 0 : std::atan2(ends[0].cross(ends[1]).norm(), ends[0].dot(ends[1]));
}

/// What the walls of charges and blasts have in common, each surface once.
struct Hole {
  std::string surface;
  std::optional<Axis> axis;  ///< that of its charge; none: it is measured
};

std::vector<Hole> holes_of(const cases::BlocksCase& blocks) {
  std::vector<Hole> holes;
  const auto add = [&](const std::string& surface, const std::optional<Axis>& axis) {
    if (std::ranges::find(holes, surface, &Hole::surface) == holes.end()) holes.push_back({surface, axis});
  };
  for (const cases::Charge& charge : blocks.charges)
    add(charge.surface, Axis{charge.collar, (charge.toe - charge.collar).normalized()});
  for (const cases::Blast& blast : blocks.blasts) add(blast.surface, std::nullopt);
  return holes;
}

std::optional<Axis> measured_axis(const geometry::TetraMesh& mesh, const std::vector<geometry::OuterFace>& faces) {
  const HoleWall wall = measure_wall(mesh, faces);
  if (!wall.closes() || !wall.has_axis()) return std::nullopt;
  return Axis{wall.first, wall.axis};
}

/// How far a face of the mantle reaches around the axis, the mean [rad].
Real angle_of_a_face(const Axis& axis, const geometry::TetraMesh& mesh, const std::vector<geometry::OuterFace>& faces) {
  Real angles = 0;
  Index count = 0;
  for (const geometry::OuterFace& face : faces) {
    const auto corners = face_corners(mesh, face.nodes);
    const Real radius = axis.direction.cross((corners[0] + corners[1] + corners[2]) / 3 - axis.point).norm();
    if (axis.direction.cross(area_vector(corners)).norm() < 0.5 * area_vector(corners).norm()) continue;  // the end of the hole
    angles += 2 * std::atan(width_around(axis.direction, corners) / (2 * radius));
    ++count;
  }
  return count > 0 ? angles / static_cast<Real>(count) : 0;
}

HalfCast half_cast_of(const std::string& surface, const Axis& axis, const geometry::TetraMesh& mesh,
                      const std::vector<geometry::OuterFace>& faces, const std::vector<bool>& stays) {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const geometry::OuterFace& face : faces)
    for (const Vector3& corner : face_corners(mesh, face.nodes)) {
      const Real along = (corner - axis.point).dot(axis.direction);
      low = std::min(low, along);
      high = std::max(high, along);
    }
  HalfCast cast{surface, axis.point + low * axis.direction, axis.point + high * axis.direction};
  const Real face_angle = angle_of_a_face(axis, mesh, faces), piece = (high - low) / cuts;
  for (int cut = 0; cut < cuts; ++cut) {
    Real all = 0, standing = 0;
    for (const geometry::OuterFace& face : faces) {
      const Real angle = angle_at(axis, low + (cut + 0.5) * piece, face_corners(mesh, face.nodes));
      all += angle;
      if (stays[static_cast<std::size_t>(face.element)]) standing += angle;
    }
    if (all <= 0) continue;
    constexpr Real rounding = 1e-6;
    if (standing > 0.5 * all - 1.5 * face_angle) cast.half += standing > 0 ? piece : 0;  // faces are whole: one less is enough
    if (standing >= all - rounding) cast.whole += piece;
    cast.standing += standing / all / cuts;
  }
  return cast;
}

}  // namespace

std::vector<HalfCast> measure_half_casts(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                                         const std::vector<bool>& stays) {
  const auto map = geometry::build_face_map(mesh);
  const MeshFaces faces{mesh, map, geometry::find_surface_faces(mesh, map)};
  std::vector<HalfCast> casts;
  for (const Hole& hole : holes_of(blocks)) {
    const auto wall = faces.outer(hole.surface);
    if (wall.empty()) continue;
    if (const auto axis = hole.axis ? hole.axis : measured_axis(mesh, wall))
      casts.push_back(half_cast_of(hole.surface, *axis, mesh, wall, stays));
  }
  return casts;
}

Real half_cast_factor(const std::vector<HalfCast>& casts) {
  Real half = 0, length = 0;
  for (const HalfCast& cast : casts) {
    half += cast.half;
    length += cast.length();
  }
  return length > 0 ? half / length : 0;
}

void write_half_casts(const std::filesystem::path& file, const std::vector<HalfCast>& casts) {
  std::vector<std::vector<observe::CsvField>> rows;
  for (const HalfCast& cast : casts) {
    auto& row = rows.emplace_back(std::vector<observe::CsvField>{cast.surface});
    row.insert(row.end(), cast.first.begin(), cast.first.end());
    row.insert(row.end(), cast.last.begin(), cast.last.end());
    row.insert(row.end(), {cast.length(), cast.half, cast.whole, cast.standing});
  }
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::blocks::half_casts);
  observe::write_csv(file, titles, rows);
}

}  // namespace sazare::runs
