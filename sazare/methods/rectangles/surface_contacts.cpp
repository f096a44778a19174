#include "sazare/methods/rectangles/surface_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::rectangles {

namespace {

using geometry::Outline;
using geometry::OutlineKind;
using geometry::Vector2;
constexpr Real skin_share = 0.3;    // of the smallest half width, as of other contacts
constexpr Real least_slope = 1e-9;  // cosine: a face that is this upright on a segment has no length along it
constexpr std::size_t serial_below = 64;

Real longest_side(const Outline& outline) {
  Real longest = 0;
  for (int number = 0; number < geometry::face_count(outline); ++number)
    longest = std::max(longest, 2 * geometry::face_of(outline, number).half);
  return longest;
}

Real cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

SurfaceContacts::SurfaceContacts(const ContactRules& rules, const std::vector<Vector3>& nodes, std::vector<Segment> segments,
                                 const state::Particles<2>& particles, const state::Outlines& outlines)
    : rules_(rules), segments_(std::move(segments)), nodes_(nodes), place_of_(particles.padded(), -1) {
  std::map<Index, Index> begins, ends;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    begins[segments_[i][0]] = static_cast<Index>(i);
    ends[segments_[i][1]] = static_cast<Index>(i);
  }
  const auto found = [](const std::map<Index, Index>& list, Index node) {
    const auto entry = list.find(node);
    return entry == list.end() ? Index{-1} : entry->second;
  };
  for (const Segment& segment : segments_) beside_.push_back({found(ends, segment[0]), found(begins, segment[1])});
  Real smallest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (outlines.block[i] >= 0) smallest = std::min({smallest, outlines.half_width[i], outlines.half_height[i]});
  skin_ = skin_share * smallest;
}

SurfaceContacts::Line SurfaceContacts::line(Index segment) const {
  const Segment& nodes = segments_[at(segment)];
  const Vector2 from = nodes_.place(nodes[0], time_).head<2>(), to = nodes_.place(nodes[1], time_).head<2>();
  const Real length = (to - from).norm();
  const Vector2 along = (to - from) / length;
  return {from, along, {-along.y(), along.x()}, length};
}

void SurfaceContacts::lead(Real step, std::vector<Vector3> from, std::vector<Vector3> with) {
  past_work_ += nodes_.work();
  for (Near& near : near_) near.dashpot_power -= power_of_nodes(near);
  nodes_.lead(0, step, std::move(from), std::move(with));
  for (Near& near : near_) near.dashpot_power += power_of_nodes(near);
  time_ = 0;
}

void SurfaceContacts::evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, bool moved, Real elapsed) {
  time_ += elapsed;
  drift_ += elapsed * nodes_.largest_speed();
  if (moved || !searched_ || drift_ > 0.5 * skin_) search(particles, outlines);
  parallel::parallel_for(near_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) evaluate(particles, outlines, near_[i], elapsed);
  });
  std::vector<geometry::NodeForce> forces;
  for (const Near& near : near_)
    for (const Point& point : near.points) {
      const Vector3 back(-point.force.x(), -point.force.y(), 0);
      forces.push_back({nodes_of(point)[0], (1 - point.share) * back});
      forces.push_back({nodes_of(point)[1], point.share * back});
    }
  nodes_.add_work(forces, elapsed);
}

/// Which elements are near which segments; those that were near keep what they remember.
void SurfaceContacts::search(const state::Particles<2>& particles, const state::Outlines& outlines) {
  searched_ = true;
  drift_ = 0;
  neighbors::SphereGrid grid;
  std::vector<Line> lines;
  for (Index segment = 0; segment < static_cast<Index>(segments_.size()); ++segment) {
    const Line& here = lines.emplace_back(line(segment));
    const Vector2 middle = here.from + 0.5 * here.length * here.along;
    grid.place(segment, Vector3(middle.x(), middle.y(), 0), 0.5 * here.length);
  }
  std::vector<Near> before = std::exchange(near_, {});
  std::vector<Index> place_before = std::exchange(place_of_, std::vector<Index>(place_of_.size(), -1));
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const bool can_touch = outlines.block[i] >= 0 && (outlines.kind[i] == OutlineKind::circle || outlines.exposed[i] != 0);
    if (!can_touch) continue;
    const Vector2 centre(particles.position(0, i), particles.position(1, i));
    const Real reach = geometry::outer_radius(outlines.at(particles, i)) + skin_;
    std::vector<Index> segments;
    grid.visit_near(Vector3(centre.x(), centre.y(), 0), reach, [&](Index segment) {
      const Line& here = lines[at(segment)];
      const Real foot = std::clamp(here.along.dot(centre - here.from), Real{0}, here.length);
      if ((centre - here.from - foot * here.along).squaredNorm() <= reach * reach) segments.push_back(segment);
    });
    if (segments.empty()) continue;
    std::ranges::sort(segments);
    place_of_[i] = static_cast<Index>(near_.size());
    Near& near = near_.emplace_back();
    if (place_before[i] >= 0) near = std::move(before[at(std::exchange(place_before[i], -1))]);
    near.element = static_cast<Index>(i);
    near.segments = std::move(segments);
  }
  for (const Index gone : place_before) {
    if (gone < 0) continue;
    past_losses_.dashpot += before[at(gone)].loss.dashpot;
    past_losses_.friction += before[at(gone)].loss.friction;
    for (const Touch& touch : before[at(gone)].touches) past_losses_.friction += touch.energy;
  }
}

void SurfaceContacts::evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, Near& near,
                               Real elapsed) const {
  near.loss.dashpot += 0.5 * elapsed * (near.dashpot_power + dashpot_power(particles, near));
  near.force = near.dashpot = {};
  near.elastic = 0;
  near.points.clear();
  const std::vector<Touch> before = std::exchange(near.touches, {});
  const Outline outline = outlines.at(particles, at(near.element));
  if (outline.kind == OutlineKind::circle)
    add_circle(outline, near);
  else
    add_points(outline, near);
  for (const Touch& old : before) {
    const auto now = std::ranges::find(near.touches, old.face, &Touch::face);
    if (now == near.touches.end())
      near.loss.friction += old.energy;
    else
      *now = old;
  }
  for (Index touch = 0; touch < static_cast<Index>(near.touches.size()); ++touch) push(particles, touch, elapsed, near);
  near.dashpot_power = dashpot_power(particles, near);
}

/// The faces of an outline that lie below a segment; none where the outline as a whole lies behind it.
void SurfaceContacts::add_pieces(const Outline& outline, Index segment, std::vector<Piece>& pieces) const {
  const Line here = line(segment);
  const Real deepest = std::min(outline.half_width, outline.half_height);
  const std::size_t first = pieces.size();
  for (int number = 0; number < geometry::face_count(outline); ++number) {
    const geometry::Face face = geometry::face_of(outline, number);
    if (!geometry::is_exposed(outline, number) || face.normal.dot(here.normal) > -least_slope) continue;
    Piece piece{segment, number, {}, {}};
    for (std::size_t end = 0; end < 2; ++end) {
      const Vector2 corner = face.centre + (end == 0 ? -face.half : face.half) * face.along - here.from;
      piece.at[end] = here.along.dot(corner);
      piece.depth[end] = -here.normal.dot(corner);
    }
    if (piece.at[0] > piece.at[1]) {
      std::swap(piece.at[0], piece.at[1]);
      std::swap(piece.depth[0], piece.depth[1]);
    }
    const Real slope = (piece.depth[1] - piece.depth[0]) / (piece.at[1] - piece.at[0]);
    const auto cut = [&](std::size_t end, Real place) {
      piece.depth[end] += slope * (place - piece.at[end]);
      piece.at[end] = place;
    };
    if (piece.at[0] < 0) cut(0, 0);
    if (piece.at[1] > here.length) cut(1, here.length);
    if (!(piece.at[1] > piece.at[0])) continue;
    if (piece.depth[0] <= 0 && piece.depth[1] <= 0) continue;
    for (std::size_t end = 0; end < 2; ++end)
      if (piece.depth[end] < 0) {
        piece.at[end] -= piece.depth[end] / slope;
        piece.depth[end] = 0;
      }
    if (std::max(piece.depth[0], piece.depth[1]) > deepest) return pieces.resize(first);
    pieces.push_back(piece);
  }
}

bool SurfaceContacts::is_nearer_elsewhere(const Piece& piece, std::span<const Index> segments) const {
  const Line own = line(piece.segment);
  const Real depth = 0.5 * (piece.depth[0] + piece.depth[1]);
  const Vector2 middle = own.from + 0.5 * (piece.at[0] + piece.at[1]) * own.along - depth * own.normal;
  return std::ranges::any_of(segments, [&](Index other) {
    if (other == piece.segment) return false;
    const Line here = line(other);
    const Vector2 apart = middle - here.from;
    if (here.normal.dot(apart) >= 0) return false;
    const Real foot = std::clamp(here.along.dot(apart), Real{0}, here.length);
    return (apart - foot * here.along).norm() < (1 - 1e-9) * depth;
  });
}

void SurfaceContacts::find_pieces(const Outline& outline, std::span<const Index> segments, std::vector<Piece>& pieces) const {
  pieces.clear();
  for (const Index segment : segments) add_pieces(outline, segment, pieces);
  std::erase_if(pieces, [&](const Piece& piece) { return is_nearer_elsewhere(piece, segments); });
  std::ranges::stable_sort(pieces, {}, &Piece::face);
}

/// The springs along a piece as two at its ends, which have their force, their moment and, together, their energy.
void SurfaceContacts::add_points(const Outline& outline, Near& near) const {
  thread_local std::vector<Piece> pieces;
  find_pieces(outline, near.segments, pieces);
  if (pieces.empty()) return;
  const Real side = longest_side(outline), stiffness = 2 * rules_.normal_stiffness * rules_.thickness / side;
  for (const Piece& piece : pieces) {
    if (near.touches.empty() || near.touches.back().face != piece.face) near.touches.push_back({piece.face, 0, 0});
    const Line here = line(piece.segment);
    const Real length = piece.at[1] - piece.at[0];
    const auto [d0, d1] = piece.depth;
    near.elastic += stiffness * length * (d0 * d0 + d0 * d1 + d1 * d1) / 6;
    for (std::size_t end = 0; end < 2; ++end) {
      Point& point = near.points.emplace_back();
      point.touch = static_cast<Index>(near.touches.size()) - 1;
      point.segment = piece.segment;
      point.share = piece.at[end] / here.length;
      point.place = here.from + piece.at[end] * here.along;
      point.normal = here.normal;
      point.elastic = stiffness * length * (2 * piece.depth[end] + piece.depth[1 - end]) / 6;
      point.weight = 0.5 * length / side;
    }
  }
}

void SurfaceContacts::add_circle(const Outline& outline, Near& near) const {
  const Real stiffness = 2 * rules_.normal_stiffness * rules_.thickness;
  for (const Index segment : near.segments) {
    const Line here = line(segment);
    const Vector2 apart = outline.centre - here.from;
    Real foot = here.along.dot(apart);
    if (here.normal.dot(apart) < 0) continue;
    const auto [previous, next] = beside_[at(segment)];
    if (foot > here.length && next >= 0) continue;  // the node between the two is the next one's
    if (foot < 0 && previous >= 0) {
      const Line other = line(previous);
      if (other.along.dot(outline.centre - other.from) <= other.length) continue;
    }
    foot = std::clamp(foot, Real{0}, here.length);
    const Vector2 place = here.from + foot * here.along;
    const Real distance = (outline.centre - place).norm(), depth = outline.half_width - distance;
    if (!(depth > 0) || !(distance > 0)) continue;
    if (near.touches.empty()) near.touches.push_back({});
    near.elastic += 0.5 * stiffness * depth * depth;
    Point& point = near.points.emplace_back();
    point.segment = segment;
    point.share = foot / here.length;
    point.elastic = stiffness * depth;
    point.weight = 1;
    point.place = place;
    point.normal = (outline.centre - place) / distance;
  }
}

/// Springs and dashpots of an element that lies on the surface with one face: those on a wall, without points.
laws::ContactSprings SurfaceContacts::springs_of(Real mass) const {
  const Real normal = 2 * rules_.normal_stiffness * rules_.thickness, shear = 2 * rules_.shear_stiffness * rules_.thickness,
             damping = 2 * rules_.damping_ratio * std::sqrt(normal * mass);
  return {normal, shear, damping, damping * std::sqrt(shear / normal)};
}

Vector2 SurfaceContacts::velocity(const Point& point) const {
  const auto& [first, second] = nodes_of(point);
  const Vector3 velocity = (1 - point.share) * nodes_.velocity(first) + point.share * nodes_.velocity(second);
  return velocity.head<2>();
}

/// Springs, dashpots and friction of a face at all its points.
void SurfaceContacts::push(const state::Particles<2>& particles, Index touch_number, Real elapsed, Near& near) const {
  const std::size_t i = at(near.element);
  const laws::ContactSprings springs = springs_of(1 / particles.inverse_mass[i]);
  const Vector2 centre(particles.position(0, i), particles.position(1, i));
  const auto tangent = [](const Point& point) { return Vector2(point.normal.y(), -point.normal.x()); };
  const auto rate = [&](const Point& point) -> Vector2 {  // of the surface against the element
    const Vector2 arm = point.place - centre;
    const Real spin = particles.velocity[2][i];
    return velocity(point) - Vector2(particles.velocity[0][i] - spin * arm.y(), particles.velocity[1][i] + spin * arm.x());
  };
  laws::PressedFace face;
  for (Point& point : near.points) {
    if (point.touch != touch_number) continue;
    const Vector2 closing = rate(point);
    point.dashpot =
        laws::pushing_dashpot(point.weight * springs.normal_damping, point.normal.dot(closing), point.elastic) * point.normal;
    point.force = point.elastic * point.normal + point.dashpot;
    face.add(point.elastic, point.normal.dot(point.force), tangent(point).dot(closing));
  }
  Touch& touch = near.touches[at(touch_number)];
  const laws::FaceFriction along =
      laws::advance_friction(touch.shear, springs, rules_.friction * face.pressure, face.sliding_rate(), elapsed);
  near.loss.friction += along.loss;
  touch.energy = laws::shear_energy(springs, touch.shear);
  for (Point& point : near.points) {
    if (point.touch != touch_number) continue;
    const Real share = face.share_of(point.normal.dot(point.force));
    point.force += share * along.force * tangent(point);
    point.dashpot += share * along.dashpot * tangent(point);
    const Vector2 arm = point.place - centre;
    const auto add = [&](const Vector2& force, std::array<Real, 3>& sum) {
      sum[0] += force.x();
      sum[1] += force.y();
      sum[2] += cross(arm, force);
    };
    add(point.force, near.force);
    add(point.dashpot, near.dashpot);
  }
}

Real SurfaceContacts::power_of_nodes(const Near& near) const {
  Real power = 0;
  for (const Point& point : near.points) power += point.dashpot.dot(velocity(point));
  return power;
}

/// The power of the last dashpot forces at the present velocities [W].
Real SurfaceContacts::dashpot_power(const state::Particles<2>& particles, const Near& near) const {
  Real power = power_of_nodes(near);
  for (std::size_t freedom = 0; freedom < 3; ++freedom)
    power -= near.dashpot[freedom] * particles.velocity[freedom][at(near.element)];
  return power;
}

void SurfaceContacts::add_to(std::size_t element, std::array<Real, 3>& sum) const {
  const Near& near = near_[at(place_of_[element])];
  for (std::size_t freedom = 0; freedom < 3; ++freedom) sum[freedom] += near.force[freedom];
}

}  // namespace sazare::methods::rectangles
