#include "sazare/geometry/plane/outline_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::geometry {

namespace {

constexpr Real preference = 1e-9;  // of a half width: faces of equal overlap go to the first outline

Vector2 in_own_axes(const Outline& outline, const Vector2& direction) {
  return {outline.axis.dot(direction), outline.other_axis().dot(direction)};
}

/// How far an outline reaches from its centre against a direction.
Real reach(const Outline& outline, const Vector2& direction) {
  if (outline.kind == OutlineKind::polygon) {
    const Vector2 own = in_own_axes(outline, direction);
    Real most = 0;  // the centre lies inside
    for (const Vector2& corner : outline.corners) most = std::max(most, -corner.dot(own));
    return most;
  }
  return outline.half_width * std::abs(outline.axis.dot(direction)) +
         outline.half_height * std::abs(outline.other_axis().dot(direction));
}

/// The side of a polygon that faces most against a direction, of the two that end in its lowest corner along the direction.
int opposite_side(const Outline& outline, const Vector2& direction) {
  const Vector2 own = in_own_axes(outline, direction);
  const std::size_t n = outline.corners.size();
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (outline.corners[i].dot(own) < outline.corners[lowest].dot(own)) lowest = i;
  const Vector2 corner = outline.corners[lowest];
  const Vector2 after = outline.corners[(lowest + 1) % n] - corner, before = outline.corners[(lowest + n - 1) % n] - corner;
  const bool is_after = own.dot(after) * before.norm() <= own.dot(before) * after.norm();
  return static_cast<int>(is_after ? lowest : (lowest + n - 1) % n);
}

/// The face that looks most against a direction.
int opposite_face(const Outline& outline, const Vector2& direction) {
  if (outline.kind == OutlineKind::wall) return 0;
  if (outline.kind == OutlineKind::polygon) return opposite_side(outline, direction);
  const Real x = -outline.axis.dot(direction), y = -outline.other_axis().dot(direction);
  if (std::abs(x) > std::abs(y)) return x > 0 ? 0 : 2;
  return y > 0 ? 1 : 3;
}

struct Reference {
  Real distance = -std::numeric_limits<Real>::infinity();  ///< negative where they overlap
  int face = -1;
  int opposite = -1;
};

/// The face of `owner` that keeps the other most apart.
Reference best_face(const Outline& owner, const Outline& other) {
  Reference best;
  for (int number = 0; number < face_count(owner); ++number) {
    const Face face = face_of(owner, number);
    const Real distance = face.normal.dot(other.centre - face.centre) - reach(other, face.normal);
    if (distance <= best.distance) continue;
    const int opposite = opposite_face(other, face.normal);
    const bool admitted = is_exposed(owner, number) && is_exposed(other, opposite);
    if (distance > 0) return {distance, number, opposite};
    if (admitted) best = {distance, number, opposite};
  }
  return best;
}

/// Cuts the opposite face to the length of the reference face; points above it fall out.
Overlap cut(const Face& reference, const Face& opposite, Real deepest) {
  Overlap result;
  Vector2 ends[2] = {opposite.centre - opposite.half * opposite.along, opposite.centre + opposite.half * opposite.along};
  Real at[2] = {reference.along.dot(ends[0] - reference.centre), reference.along.dot(ends[1] - reference.centre)};
  if (at[0] > at[1]) {
    std::swap(at[0], at[1]);
    std::swap(ends[0], ends[1]);
  }
  const Real length = at[1] - at[0];
  const Real low = std::max(at[0], -reference.half), high = std::min(at[1], reference.half);
  if (!(high > low)) return result;
  result.normal = reference.normal;
  result.share = (high - low) / std::min(length, 2 * reference.half);
  for (const Real place : {low, high}) {
    const Vector2 point = ends[0] + (place - at[0]) / length * (ends[1] - ends[0]);
    const Real depth = -reference.normal.dot(point - reference.centre);
    if (depth > deepest) return {};
    if (depth > 0) result.points[static_cast<std::size_t>(result.count++)] = {point + 0.5 * depth * reference.normal, depth};
  }
  return result;
}

Overlap reversed(Overlap overlap) {
  overlap.normal = -overlap.normal;
  return overlap;
}

Overlap faces_on_wall(const Outline& wall, const Outline& other) {
  const Reference reference = best_face(wall, other);
  if (reference.face < 0 || reference.distance > 0) return {};
  return cut(face_of(wall, 0), face_of(other, reference.opposite), std::min(other.half_width, other.half_height));
}

Overlap faces_overlap(const Outline& first, const Outline& second) {
  const Reference a = best_face(first, second);
  if (a.distance > 0) return {};
  const Reference b = best_face(second, first);
  if (b.distance > 0 || (a.face < 0 && b.face < 0)) return {};
  const Real deepest = std::min({first.half_width, first.half_height, second.half_width, second.half_height});
  const bool by_first = a.face >= 0 && !(b.distance > a.distance + preference * deepest);
  return by_first ? cut(face_of(first, a.face), face_of(second, a.opposite), deepest)
                  : reversed(cut(face_of(second, b.face), face_of(first, b.opposite), deepest));
}

Overlap at_point(const Vector2& normal, const Vector2& place, Real depth) {
  Overlap result;
  if (!(depth > 0)) return result;
  result.count = 1;
  result.normal = normal;
  result.points[0] = {place, depth};
  return result;
}

/// A circle and a rectangle; the normal points from the rectangle to the circle.
Overlap circle_on_rectangle(const Outline& rectangle, const Outline& circle) {
  const Vector2 apart = circle.centre - rectangle.centre;
  const Vector2 own(rectangle.axis.dot(apart), rectangle.other_axis().dot(apart));
  const Vector2 half(rectangle.half_width, rectangle.half_height);
  const Real close = 1e-6 * circle.half_width;
  const bool beside = std::abs(own.x()) > half.x() + close, above = std::abs(own.y()) > half.y() + close;
  const int across = own.x() > 0 ? 0 : 2, upward = own.y() > 0 ? 1 : 3;
  const auto world = [&](const Vector2& v) { return Vector2(v.x() * rectangle.axis + v.y() * rectangle.other_axis()); };
  if (beside && above) {
    if (!is_exposed(rectangle, across) || !is_exposed(rectangle, upward)) return {};
    const Vector2 corner(std::copysign(half.x(), own.x()), std::copysign(half.y(), own.y()));
    const Real distance = (own - corner).norm(), depth = circle.half_width - distance;
    const Vector2 normal = world((own - corner) / distance);
    return at_point(normal, rectangle.centre + world(corner) - 0.5 * depth * normal, depth);
  }
  // Beside one face, or inside: then the nearest face.
  const Real to_side = std::abs(own.x()) - half.x(), to_top = std::abs(own.y()) - half.y();
  const bool by_side =
      is_exposed(rectangle, across) && (beside || (!above && (to_side > to_top || !is_exposed(rectangle, upward))));
  if (!by_side && (beside || !is_exposed(rectangle, upward))) return {};
  const int number = by_side ? across : upward;
  const Vector2 normal = face_of(rectangle, number).normal;
  const Real depth = circle.half_width - (by_side ? to_side : to_top);
  return at_point(normal, circle.centre - (circle.half_width - 0.5 * depth) * normal, depth);
}

/// A circle and a polygon, the same: the side of which the centre stands farthest out, or an end of it.
Overlap circle_on_polygon(const Outline& polygon, const Outline& circle) {
  const int n = face_count(polygon);
  int nearest = 0;
  Face face = face_of(polygon, 0);
  Real height = face.normal.dot(circle.centre - face.centre);
  for (int number = 1; number < n; ++number) {
    const Face next = face_of(polygon, number);
    const Real beyond = next.normal.dot(circle.centre - next.centre);
    if (beyond <= height) continue;
    nearest = number;
    face = next;
    height = beyond;
  }
  const Real along = face.along.dot(circle.centre - face.centre), close = 1e-6 * circle.half_width;
  if (height <= close || std::abs(along) <= face.half) {
    if (!is_exposed(polygon, nearest)) return {};
    const Real depth = circle.half_width - height;
    return at_point(face.normal, circle.centre - (circle.half_width - 0.5 * depth) * face.normal, depth);
  }
  const int beside = (nearest + (along > 0 ? 1 : n - 1)) % n;
  if (!is_exposed(polygon, nearest) || !is_exposed(polygon, beside)) return {};
  const Vector2 corner = face.centre + std::copysign(face.half, along) * face.along;
  const Real distance = (circle.centre - corner).norm(), depth = circle.half_width - distance;
  const Vector2 normal = (circle.centre - corner) / distance;
  return at_point(normal, corner - 0.5 * depth * normal, depth);
}

/// A circle and a wall; the normal points from the wall to the circle.
Overlap circle_on_wall(const Outline& wall, const Outline& circle) {
  const Vector2 apart = circle.centre - wall.centre;
  const Real along = std::clamp(wall.axis.dot(apart), -wall.half_width, wall.half_width), height = wall.other_axis().dot(apart);
  if (height < 0) return {};
  const Vector2 from = apart - along * wall.axis;
  const Real distance = from.norm(), depth = circle.half_width - distance;
  if (!(distance > 0)) return {};
  return at_point(from / distance, circle.centre - (circle.half_width - 0.5 * depth) / distance * from, depth);
}

Overlap circles_overlap(const Outline& first, const Outline& second) {
  const Vector2 apart = second.centre - first.centre;
  const Real distance = apart.norm(), depth = first.half_width + second.half_width - distance;
  if (!(distance > 0)) return {};
  return at_point(apart / distance, first.centre + (first.half_width - 0.5 * depth) / distance * apart, depth);
}

}  // namespace

int face_count(const Outline& outline) {
  if (outline.kind == OutlineKind::polygon) return static_cast<int>(outline.corners.size());
  return outline.kind == OutlineKind::wall ? 1 : 4;
}

Face face_of(const Outline& outline, int number) {
  if (outline.kind == OutlineKind::wall) return {outline.centre, outline.other_axis(), outline.axis, outline.half_width};
  if (outline.kind == OutlineKind::polygon) {
    const auto own = static_cast<std::size_t>(number);
    const Vector2 &begin = outline.corners[own], &end = outline.corners[(own + 1) % outline.corners.size()];
    const auto turned = [&](const Vector2& v) { return Vector2(v.x() * outline.axis + v.y() * outline.other_axis()); };
    const Vector2 way = turned(end - begin), along = way.normalized();
    return {outline.centre + turned(0.5 * (begin + end)), {along.y(), -along.x()}, along, 0.5 * way.norm()};
  }
  const bool across = number % 2 == 0;
  const Vector2 outward = (number < 2 ? 1 : -1) * (across ? outline.axis : outline.other_axis());
  return {outline.centre + (across ? outline.half_width : outline.half_height) * outward, outward,
          Vector2(-outward.y(), outward.x()), across ? outline.half_height : outline.half_width};
}

Overlap overlap(const Outline& first, const Outline& second) {
  using enum OutlineKind;
  if (first.kind == wall && second.kind == wall) return {};
  if (first.kind == circle && second.kind == circle) return circles_overlap(first, second);
  if (second.kind == circle)
    return first.kind == wall      ? circle_on_wall(first, second)
           : first.kind == polygon ? circle_on_polygon(first, second)
                                   : circle_on_rectangle(first, second);
  if (first.kind == circle) return reversed(overlap(second, first));
  if (first.kind == wall) return faces_on_wall(first, second);
  if (second.kind == wall) return reversed(faces_on_wall(second, first));
  return faces_overlap(first, second);
}

Real outer_radius(const Outline& outline) {
  if (outline.kind == OutlineKind::polygon) {
    Real square = 0;
    for (const Vector2& corner : outline.corners) square = std::max(square, corner.squaredNorm());
    return std::sqrt(square);
  }
  return outline.kind == OutlineKind::rectangle ? std::hypot(outline.half_width, outline.half_height) : outline.half_width;
}

}  // namespace sazare::geometry
