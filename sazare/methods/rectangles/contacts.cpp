#include "sazare/methods/rectangles/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::rectangles {

namespace {

using geometry::OutlineKind;
using geometry::Vector2;
constexpr Real skin_share = 0.3;      // of the smallest half width
constexpr Real same_direction = 0.7;  // cosine: beyond it a normal belongs to another face
constexpr std::size_t serial_below = 128;

bool may_touch(const state::Outlines& outlines, std::size_t i) {
  return outlines.block[i] < 0 || outlines.kind[i] == OutlineKind::circle || outlines.exposed[i] != 0;
}

/// Whether two elements of a block hold together, side by side or round a corner. What was joined side by side and is open does
/// not: the sides of a crack that ends beside a third element press on one another.
bool are_joined(const FaceLinks& links, Index one, Index other) {
  bool joined = false, was_joined = false, round_corner = false;
  links.visit_links(one, [&](Index link, Index beside) {
    if (beside == other) was_joined = true;
    if (links.is_open(link)) return;
    if (beside == other) joined = true;
    links.visit_links(beside, [&](Index further, Index next) {
      if (next == other && !links.is_open(further)) round_corner = true;
    });
  });
  return joined || (round_corner && !was_joined);
}

/// Velocity of one element against another where both are [m/s].
Vector2 relative_velocity(const state::Particles<2>& particles, std::size_t i, std::size_t j, const Vector2& place) {
  const Vector2 arm1 = place - Vector2(particles.position(0, i), particles.position(1, i));
  const Vector2 arm2 = place - Vector2(particles.position(0, j), particles.position(1, j));
  const Real spin1 = particles.velocity[2][i], spin2 = particles.velocity[2][j];
  return {particles.velocity[0][i] - spin1 * arm1.y() - particles.velocity[0][j] + spin2 * arm2.y(),
          particles.velocity[1][i] + spin1 * arm1.x() - particles.velocity[1][j] - spin2 * arm2.x()};
}

/// The moment of a force at a place about an element's centre [N m].
Real moment_about(const state::Particles<2>& particles, std::size_t element, const Vector2& place, const Vector2& force) {
  return (place.x() - particles.position(0, element)) * force.y() - (place.y() - particles.position(1, element)) * force.x();
}

/// What the dashpots of a contact take by the present velocities [W].
Real dashpot_power(const state::Particles<2>& particles, const Contact& contact) {
  const std::size_t i = at(contact.first), j = at(contact.second);
  const auto& [x, y, first, second] = contact.dashpot;
  const auto& v = particles.velocity;
  return x * (v[0][i] - v[0][j]) + y * (v[1][i] - v[1][j]) - first * v[2][i] - second * v[2][j];
}

/// Adds to a contact what acts at one of its points.
void add_force(const state::Particles<2>& particles, const Vector2& place, const laws::PointForce& of, Contact& contact) {
  const std::size_t i = at(contact.first), j = at(contact.second);
  const Vector2 tangent(contact.normal.y(), -contact.normal.x());
  const Vector2 force = of.normal * contact.normal + of.shear * tangent;
  const Vector2 dashpot = of.normal_dashpot * contact.normal + of.shear_dashpot * tangent;
  contact.force += force;
  contact.first_moment -= moment_about(particles, i, place, force);
  contact.second_moment += moment_about(particles, j, place, force);
  contact.dashpot[0] += dashpot.x();
  contact.dashpot[1] += dashpot.y();
  contact.dashpot[2] -= moment_about(particles, i, place, dashpot);
  contact.dashpot[3] += moment_about(particles, j, place, dashpot);
}

}  // namespace

laws::ContactSprings contact_springs(const ContactRules& rules, const state::Outlines& outlines,
                                     const state::Particles<2>& particles, Index first, Index second) {
  const bool one_point = outlines.kind[at(first)] == OutlineKind::circle || outlines.kind[at(second)] == OutlineKind::circle;
  return laws::contact_springs(rules, outlines.spring_radius(at(first)), outlines.spring_radius(at(second)), one_point ? 1 : 2,
                               particles.inverse_mass[at(first)] + particles.inverse_mass[at(second)]);
}

Contacts::Contacts(const ContactRules& rules, const state::Particles<2>& particles, const state::Outlines& outlines)
    : rules_(rules) {
  Real smallest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (outlines.kind[i] != OutlineKind::wall) smallest = std::min({smallest, outlines.half_width[i], outlines.half_height[i]});
  skin_ = skin_share * smallest;
  index_pairs(particles.size());
}

bool Contacts::is_stale(const state::Particles<2>& particles) const {
  if (!searched_) return true;
  const Real most = 0.25 * skin_ * skin_;
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    const std::size_t i = at(surface_[k]);
    const Real x = particles.displacement[0][i] - seen_[0][k], y = particles.displacement[1][i] - seen_[1][k];
    if (!(x * x + y * y <= most)) return true;
  }
  return false;
}

void Contacts::look_at_surface(const state::Particles<2>& particles, const state::Outlines& outlines) {
  surface_.clear();
  for (state::Column& column : seen_) column.clear();
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (!may_touch(outlines, i)) continue;
    surface_.push_back(static_cast<Index>(i));
    for (std::size_t axis = 0; axis < 2; ++axis) seen_[axis].push_back(particles.displacement[axis][i]);
  }
}

void Contacts::search(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links) {
  searched_ = true;
  look_at_surface(particles, outlines);
  const auto place = [&](Index i) { return Vector3(particles.position(0, at(i)), particles.position(1, at(i)), 0); };
  const auto radius = [&](Index i) { return geometry::outer_radius(outlines.at(particles, at(i))) + 0.5 * skin_; };
  for (const Index i : surface_) grid_.place(i, place(i), radius(i));
  std::vector<Contact> found;
  for (const Index i : surface_) {
    if (outlines.block[at(i)] < 0) break;  // supports come last
    grid_.visit_near(place(i), radius(i), [&](Index j) {
      if (j <= i) return;
      const Vector3 apart = place(i) - place(j);
      const Real most = radius(i) + radius(j);
      if (apart.squaredNorm() > most * most) return;
      if (outlines.kind[at(j)] == OutlineKind::wall &&
          std::abs(outlines.at(particles, at(j)).other_axis().dot(apart.head<2>())) > radius(i) + skin_)
        return;
      if (outlines.block[at(i)] == outlines.block[at(j)] && are_joined(links, i, j)) return;
      Contact& contact = found.emplace_back();
      contact.first = i;
      contact.second = j;
    });
  }
  std::ranges::sort(found, {}, [](const Contact& contact) { return std::pair(contact.first, contact.second); });
  take_over(std::move(found));
  index_pairs(outlines.size());
}

/// Pairs that are still near keep what they remember; the losses of the others are kept.
void Contacts::take_over(std::vector<Contact> found) {
  auto next = found.begin();
  for (const Contact& old : pairs_) {
    while (next != found.end() && std::pair(next->first, next->second) < std::pair(old.first, old.second)) ++next;
    if (next != found.end() && next->first == old.first && next->second == old.second) {
      *next = old;
      continue;
    }
    past_losses_.dashpot += old.loss.dashpot;
    past_losses_.friction += old.loss.friction + old.energy;
  }
  pairs_ = std::move(found);
}

void Contacts::index_pairs(std::size_t elements) {
  begin_.assign(elements + 1, 0);
  for (const Contact& contact : pairs_) {
    ++begin_[at(contact.first) + 1];
    ++begin_[at(contact.second) + 1];
  }
  for (std::size_t i = 0; i < elements; ++i) begin_[i + 1] += begin_[i];
  of_element_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    for (const Index element : {pairs_[i].first, pairs_[i].second}) of_element_[next[at(element)]++] = static_cast<Index>(i);
}

void Contacts::evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links,
                        Real elapsed) {
  just_searched_ = is_stale(particles);
  if (just_searched_) search(particles, outlines, links);
  parallel::parallel_for(pairs_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) evaluate(particles, outlines, pairs_[i], elapsed);
  });
}

void Contacts::evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, Contact& contact,
                        Real elapsed) const {
  const std::size_t i = at(contact.first), j = at(contact.second);
  const geometry::Overlap overlap = geometry::overlap(outlines.at(particles, i), outlines.at(particles, j));
  contact.loss.dashpot += 0.5 * elapsed * (contact.dashpot_power + dashpot_power(particles, contact));
  contact.dashpot = {};
  contact.dashpot_power = 0;
  contact.force.setZero();
  contact.first_moment = contact.second_moment = 0;
  if (overlap.count == 0 || contact.normal.dot(overlap.normal) < (contact.touches() ? same_direction : 0)) {
    contact.loss.friction += contact.energy;  // of the shear spring: the others have none left where outlines part
    contact.shear = contact.energy = 0;
    contact.normal.setZero();
    if (overlap.count == 0) return;
  }
  contact.normal = overlap.normal;
  const Vector2 tangent(overlap.normal.y(), -overlap.normal.x());
  const auto count = static_cast<std::size_t>(overlap.count);
  std::array<laws::ContactPoint, 2> points;
  for (std::size_t point = 0; point < count; ++point) {
    const Vector2 velocity = relative_velocity(particles, i, j, overlap.points[point].place);
    points[point] = {overlap.points[point].depth, overlap.normal.dot(velocity), tangent.dot(velocity)};
  }
  const laws::FaceContactForce given =
      laws::advance_contact(contact.shear, contact_springs(rules_, outlines, particles, contact.first, contact.second),
                            rules_.friction, std::span(points).first(count), overlap.share, elapsed);
  contact.energy = given.energy;
  contact.loss.friction += given.friction_loss;
  for (std::size_t point = 0; point < count; ++point)
    add_force(particles, overlap.points[point].place, given.point[point], contact);
  contact.dashpot_power = dashpot_power(particles, contact);
}

void Contacts::add_to(std::size_t element, std::array<Real, 3>& sum) const {
  for (std::size_t i = begin_[element]; i < begin_[element + 1]; ++i) {
    const Contact& contact = pairs_[at(of_element_[i])];
    const bool is_second = at(contact.second) == element;
    sum[0] += is_second ? contact.force.x() : -contact.force.x();
    sum[1] += is_second ? contact.force.y() : -contact.force.y();
    sum[2] += is_second ? contact.second_moment : contact.first_moment;
  }
}

Index Contacts::touching() const { return static_cast<Index>(std::ranges::count_if(pairs_, &Contact::touches)); }

Real Contacts::elastic_energy() const {
  Real total = 0;
  for (const Contact& contact : pairs_) total += contact.energy;
  return total;
}

SpringLosses Contacts::losses() const {
  SpringLosses total = past_losses_;
  for (const Contact& contact : pairs_) {
    total.dashpot += contact.loss.dashpot;
    total.friction += contact.loss.friction;
  }
  return total;
}

void Contacts::columns(Archive& archive) {
  archive("pairs", pairs_);
  archive("surface", surface_);
  archive("seen_x", seen_[0]);
  archive("seen_y", seen_[1]);
  std::vector<Real> past{past_losses_.dashpot, past_losses_.friction, searched_ ? 1.0 : 0.0};
  archive("past", past);
  past_losses_.dashpot = past[0];
  past_losses_.friction = past[1];
  searched_ = past[2] != 0;
  if (archive.reading()) index_pairs(begin_.size() - 1);
}

}  // namespace sazare::methods::rectangles
