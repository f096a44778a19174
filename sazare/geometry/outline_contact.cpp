#include "sazare/geometry/outline_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::geometry {

namespace {

constexpr Real preference = 1e-9;  // of a half width: faces of equal overlap go to the first outline

/// A face of an outline: from `centre` to both sides by `half` along `along`.
struct Face {
  Vector2 centre, normal, along;
  Real half = 0;
};

int face_count(const Outline& outline) { return outline.kind == OutlineKind::wall ? 1 : 4; }

Face face_of(const Outline& outline, int number) {
  if (outline.kind == OutlineKind::wall) return {outline.centre, outline.other_axis(), outline.axis, outline.half_width};
  const bool across = number % 2 == 0;
  const Vector2 outward = (number < 2 ? 1 : -1) * (across ? outline.axis : outline.other_axis());
  return {outline.centre + (across ? outline.half_width : outline.half_height) * outward, outward,
          Vector2(-outward.y(), outward.x()), across ? outline.half_height : outline.half_width};
}

/// How far an outline reaches from its centre against a direction.
Real reach(const Outline& outline, const Vector2& direction) {
  return outline.half_width * std::abs(outline.axis.dot(direction)) +
         outline.half_height * std::abs(outline.other_axis().dot(direction));
}

/// The face that looks most against a direction.
int opposite_face(const Outline& outline, const Vector2& direction) {
  if (outline.kind == OutlineKind::wall) return 0;
  const Real x = -outline.axis.dot(direction), y = -outline.other_axis().dot(direction);
  if (std::abs(x) > std::abs(y)) return x > 0 ? 0 : 2;
  return y > 0 ? 1 : 3;
}

bool is_exposed(const Outline& outline, int face) {
  return outline.kind == OutlineKind::wall || (outline.exposed >> face & 1) != 0;
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

Overlap rectangle_on_wall(const Outline& wall, const Outline& rectangle) {
  const Reference reference = best_face(wall, rectangle);
  if (reference.face < 0 || reference.distance > 0) return {};
  return cut(face_of(wall, 0), face_of(rectangle, reference.opposite), std::min(rectangle.half_width, rectangle.half_height));
}

Overlap rectangles_overlap(const Outline& first, const Outline& second) {
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

Overlap overlap(const Outline& first, const Outline& second) {
  using enum OutlineKind;
  if (first.kind == wall && second.kind == wall) return {};
  if (first.kind == circle && second.kind == circle) return circles_overlap(first, second);
  if (second.kind == circle) return first.kind == wall ? circle_on_wall(first, second) : circle_on_rectangle(first, second);
  if (first.kind == circle) return reversed(overlap(second, first));
  if (first.kind == wall) return rectangle_on_wall(first, second);
  if (second.kind == wall) return reversed(rectangle_on_wall(second, first));
  return rectangles_overlap(first, second);
}

Real outer_radius(const Outline& outline) {
  return outline.kind == OutlineKind::rectangle ? std::hypot(outline.half_width, outline.half_height) : outline.half_width;
}

}  // namespace sazare::geometry
