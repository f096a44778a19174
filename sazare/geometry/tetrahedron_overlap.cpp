#include "sazare/geometry/tetrahedron_overlap.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace sazare::geometry {

namespace {

constexpr std::array<int, 4> four = {0, 1, 2, 3};

std::size_t n(int index) { return static_cast<std::size_t>(index); }

using Depths = std::array<Real, 4>;

/// A point with its depths below the faces of the other tetrahedron.
struct Place {
  Vector3 point;
  Depths depth;
};

/// A plane convex polygon. A triangle has ten corners at most after seven cuts; where cuts all but fall together round-off may
/// make some more, as small as itself.
struct Polygon {
  std::array<Place, 16> places;
  std::size_t count = 0;

  Polygon() = default;
  Polygon(const Polygon& other) { *this = other; }
  Polygon& operator=(const Polygon& other) {  // the corners there are, of many that there may be
    count = other.count;
    std::copy_n(other.places.begin(), count, places.begin());
    return *this;
  }

  void add(const Place& place) {
    if (count < places.size()) places[count++] = place;
  }
};

Place between(const Place& a, const Place& b, Real share) {
  Place place;
  place.point = a.point + share * (b.point - a.point);
  for (const int m : four) place.depth[n(m)] = a.depth[n(m)] + share * (b.depth[n(m)] - a.depth[n(m)]);
  return place;
}

/// The part of a polygon in which a linear function of the depths is not below 0.
template <class Function>
void cut(Polygon& polygon, Function&& value) {
  std::array<Real, 16> values;
  bool some_out = false;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    values[i] = value(polygon.places[i].depth);
    some_out = some_out || values[i] < 0;
  }
  if (!some_out) return;
  Polygon inside;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const std::size_t next = i + 1 < polygon.count ? i + 1 : 0;
    if (values[i] >= 0) inside.add(polygon.places[i]);
    if ((values[i] >= 0) != (values[next] >= 0))
      inside.add(between(polygon.places[i], polygon.places[next], values[i] / (values[i] - values[next])));
  }
  polygon = inside;
}

void cut_to_inside(Polygon& polygon) {
  for (const int m : four)
    if (polygon.count > 0) cut(polygon, [&](const Depths& depth) { return depth[n(m)]; });
}

/// Calls visit(polygon, m) for the parts of what lies within a tetrahedron to which face m is the nearest.
template <class Visit>
void visit_parts(const Polygon& within, Visit&& visit) {
  for (const int m : four) {
    const auto is_nearest = [&](const Place& place) { return place.depth[n(m)] <= std::ranges::min(place.depth); };
    if (std::ranges::all_of(std::span(within.places).first(within.count), is_nearest)) return visit(within, m);
  }
  for (const int m : four) {
    Polygon nearest = within;
    for (const int other : four)
      if (other != m && nearest.count > 0) cut(nearest, [&](const Depths& depth) { return depth[n(other)] - depth[n(m)]; });
    visit(nearest, m);
  }
}

/// Calls visit(a, b, c) for the triangles of a polygon.
template <class Visit>
void visit_triangles(const Polygon& polygon, Visit&& visit) {
  for (std::size_t i = 1; i + 1 < polygon.count; ++i) visit(polygon.places[0], polygon.places[i], polygon.places[i + 1]);
}

Real area_of(const Place& a, const Place& b, const Place& c, const Vector3& normal) {
  return 0.5 * (b.point - a.point).cross(c.point - a.point).dot(normal);
}

/// Integral of the square of a linear function over a triangle, by its values at the corners.
Real integral_of_square(Real area, Real a, Real b, Real c) { return area / 6 * (a * (a + b + c) + b * (b + c) + c * c); }

/// Integrals over the part of a face that lies within the other tetrahedron.
struct FacePart {
  Real area = 0;                    ///< [m2]
  Real depth = 0;                   ///< of phi [m3]
  Vector3 first = Vector3::Zero();  ///< of phi times the place [m4]
};

void add_integrals(const Polygon& polygon, int m, const Vector3& normal, FacePart& part) {
  visit_triangles(polygon, [&](const Place& a, const Place& b, const Place& c) {
    const Real area = area_of(a, b, c, normal);
    const Real of_a = a.depth[n(m)], of_b = b.depth[n(m)], of_c = c.depth[n(m)], sum = of_a + of_b + of_c;
    part.area += area;
    part.depth += area / 3 * sum;
    part.first += area / 12 * ((of_a + sum) * a.point + (of_b + sum) * b.point + (of_c + sum) * c.point);
  });
}

/// The corners of a tetrahedron, with their depths below the faces of another.
std::array<Place, 4> corners_within(const SolidTetrahedron& solid, const SolidTetrahedron& other) {
  std::array<Place, 4> places;
  for (const int corner : four) {
    Place& place = places[n(corner)];
    place.point = solid.corners[n(corner)];
    for (const int m : four) place.depth[n(m)] = other.depth(m, place.point);
  }
  return places;
}

/// Whether a face of the other tetrahedron parts some points from it.
bool are_parted(std::span<const Place> places) {
  return std::ranges::any_of(
      four, [&](int m) { return std::ranges::all_of(places, [&](const Place& place) { return place.depth[n(m)] <= 0; }); });
}

Polygon face_within(const std::array<Place, 4>& corners, int face) {
  Polygon polygon;
  for (const int corner : tetrahedron_faces[n(face)]) polygon.add(corners[n(corner)]);
  if (are_parted(std::span(polygon.places).first(3)))
    polygon.count = 0;
  else
    cut_to_inside(polygon);
  return polygon;
}

struct Parts {
  std::array<FacePart, 4> of_first, of_second;
};

Parts parts_of(const SolidTetrahedron& first, const SolidTetrahedron& second) {
  Parts parts;
  const auto of_first = corners_within(first, second), of_second = corners_within(second, first);
  if (are_parted(of_first) || are_parted(of_second)) return parts;
  const auto add = [&](const Polygon& polygon, const Vector3& normal, FacePart& part) {
    if (polygon.count > 2) visit_parts(polygon, [&](const Polygon& one, int m) { add_integrals(one, m, normal, part); });
  };
  for (const int face : four) {
    add(face_within(of_first, face), first.normals[n(face)], parts.of_first[n(face)]);
    add(face_within(of_second, face), second.normals[n(face)], parts.of_second[n(face)]);
  }
  return parts;
}

/// Integral of phi of a tetrahedron over what it has in common with another [m4]. Where face m is the nearest, phi is the
/// divergence of -n_m phi^2/2, so that Gauss's theorem needs integrals of phi^2 over the faces of the other, and over the planes
/// that part the regions of two faces of its own:
///
///     int phi dV = -sum n_m . n_g int phi^2/2 dA  +  sum |n_m - n_j| int phi^2/2 dA
///
/// All of them are as small as the result, so that nothing is lost where two just touch.
Real weight_in(const SolidTetrahedron& solid, const SolidTetrahedron& other) {
  Real twice = 0;
  const auto corners = corners_within(other, solid);
  for (const int face : four)
    visit_parts(face_within(corners, face), [&](const Polygon& polygon, int m) {
      const Vector3& normal = other.normals[n(face)];
      visit_triangles(polygon, [&](const Place& a, const Place& b, const Place& c) {
        twice -= solid.normals[n(m)].dot(normal) *
                 integral_of_square(area_of(a, b, c, normal), a.depth[n(m)], b.depth[n(m)], c.depth[n(m)]);
      });
    });
  const auto own = corners_within(solid, other);
  Place middle{solid.middle, {}};
  for (const int m : four) middle.depth[n(m)] = other.depth(m, middle.point);
  for (const int m : four)
    for (int j = m + 1; j < 4; ++j) {
      Polygon parting;
      for (const int corner : four)
        if (corner != m && corner != j) parting.add(own[n(corner)]);
      parting.add(middle);
      const Vector3 across = (parting.places[1].point - parting.places[0].point).cross(middle.point - parting.places[0].point);
      cut_to_inside(parting);
      const auto depth = [&](const Place& place) { return solid.depth(m, place.point); };
      visit_triangles(parting, [&](const Place& a, const Place& b, const Place& c) {
        twice += (solid.normals[n(m)] - solid.normals[n(j)]).norm() *
                 integral_of_square(area_of(a, b, c, across.normalized()), depth(a), depth(b), depth(c));
      });
    }
  return 0.5 * twice;
}

/// Sums over faces that count.
struct Meeting {
  Real depth = 0;
  Vector3 push = Vector3::Zero(), turning = Vector3::Zero(), place = Vector3::Zero(), across = Vector3::Zero();

  /// `sign` is 1 for faces of the first.
  void add(const SolidTetrahedron& solid, const std::array<FacePart, 4>& parts, FaceBits counts, Real sign) {
    for (const int face : four) {
      const FacePart& part = parts[n(face)];
      if ((counts >> face & 1) == 0 || part.area == 0) continue;
      const Vector3 normal = sign * solid.normals[n(face)];
      push += 0.5 * part.depth * normal;
      turning += 0.5 * part.first.cross(normal);
      across += 0.5 * part.area * normal;
      depth += part.depth;
      place += part.first;
    }
  }
};

Meeting meeting_of(const SolidTetrahedron& first, const SolidTetrahedron& second, const Parts& parts, FaceBits first_counts,
                   FaceBits second_counts) {
  Meeting sum;
  sum.add(first, parts.of_first, first_counts, 1);
  sum.add(second, parts.of_second, second_counts, -1);
  return sum;
}

/// Separation of two by a unit vector from the first to the second [m], and how fast it grows as the faces of both together are
/// drawn in.
struct Separation {
  Real width, growth;
};

Separation separation(const SolidTetrahedron& first, const SolidTetrahedron& second, const Vector3& axis) {
  const Real one = first.extent(axis), other = second.extent(-axis);
  return {axis.dot(second.middle - first.middle) - one - other, 0.5 * (one / first.radius + other / second.radius)};
}

}  // namespace

Real SolidTetrahedron::extent(const Vector3& along) const {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const Vector3& corner : corners) most = std::max(most, along.dot(corner - middle));
  return most;
}

SolidTetrahedron solid_tetrahedron(const Tetrahedron& corners) {
  SolidTetrahedron solid{corners, {}, Vector3::Zero(), 0};
  Real area = 0;
  for (const int face : four) {
    const Vector3 across = face_area_vector(corners, face);
    solid.normals[n(face)] = across.normalized();
    solid.middle += across.norm() * corners[n(face)];
    area += across.norm();
  }
  solid.middle /= area;
  solid.radius = 3 * volume(corners) / area;
  return solid;
}

SolidTetrahedron placed(const SolidTetrahedron& solid, const Vector3& position, const Matrix3& rotation, Real inset) {
  SolidTetrahedron there;
  const Real size = std::max(Real{0}, 1 - inset / solid.radius);
  there.middle = position + rotation * solid.middle;
  there.radius = size * solid.radius;
  for (const int k : four) {
    there.corners[n(k)] = there.middle + size * (rotation * (solid.corners[n(k)] - solid.middle));
    there.normals[n(k)] = rotation * solid.normals[n(k)];
  }
  return there;
}

Real gap(const SolidTetrahedron& first, const SolidTetrahedron& second) {
  Real widest = -std::numeric_limits<Real>::infinity();
  const auto look = [&](const SolidTetrahedron& solid, const SolidTetrahedron& other) {
    for (const int face : four) {
      Real deepest = -std::numeric_limits<Real>::infinity();
      for (const Vector3& corner : other.corners) deepest = std::max(deepest, solid.depth(face, corner));
      widest = std::max(widest, -deepest);
    }
  };
  look(first, second);
  look(second, first);
  return widest;
}

Real shared_depth(const SolidTetrahedron& first, const SolidTetrahedron& second) {
  Real least = std::numeric_limits<Real>::infinity();
  const auto look = [&](const Vector3& axis) {
    const Separation found = separation(first, second, axis);
    least = std::min(least, std::max(Real{0}, -found.width / found.growth));
  };
  for (const int face : four) {
    look(first.normals[n(face)]);
    look(-second.normals[n(face)]);
  }
  constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  for (const auto& [a, b] : edges)
    for (const auto& [c, d] : edges) {
      const Vector3 one = first.corners[n(b)] - first.corners[n(a)], other = second.corners[n(d)] - second.corners[n(c)];
      const Vector3 across = one.cross(other);
      if (!(across.squaredNorm() > 1e-20 * one.squaredNorm() * other.squaredNorm())) continue;  // parallel: a face tells more
      look(across.normalized());
      look(-across.normalized());
    }
  return least;
}

TetrahedronOverlap overlap(const SolidTetrahedron& first, const SolidTetrahedron& second, FaceBits first_counts,
                           FaceBits second_counts) {
  TetrahedronOverlap found;
  const Parts parts = parts_of(first, second);
  const Meeting all = meeting_of(first, second, parts, all_four_faces, all_four_faces);
  if (!(all.depth > 0)) return found;
  Meeting counting = meeting_of(first, second, parts, first_counts, second_counts);
  if (!(counting.depth > 0) || !(counting.push.squaredNorm() > 0)) counting = all;
  if (!(counting.push.squaredNorm() > 0)) return found;
  found.push = all.push;
  found.turning = all.turning;
  found.normal = counting.push.normalized();
  found.area = counting.across.dot(found.normal);
  found.place = counting.place / counting.depth;
  return found;
}

Real overlap_weight(const SolidTetrahedron& first, const SolidTetrahedron& second) {
  if (are_parted(corners_within(first, second)) || are_parted(corners_within(second, first))) return 0;
  return 0.5 * (weight_in(first, second) + weight_in(second, first));
}

}  // namespace sazare::geometry
