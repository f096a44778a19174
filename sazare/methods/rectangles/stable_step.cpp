#include "sazare/methods/rectangles/stable_step.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "sazare/core/largest_eigenvalue.hpp"

namespace sazare::methods::rectangles {

namespace {

using geometry::Vector2;

/// A spring and its dashpot along one direction: its length changes by the sum of `by` times the motion of its two elements.
struct Spring {
  Index first = 0, second = 0;
  std::array<Real, 6> by{};
  Real stiffness = 0, damping = 0;
};

/// Springs of a link at rest, all along the face taken together.
void add_link(const state::Particles<2>& particles, const FaceLinks& links, Index number, std::vector<Spring>& springs) {
  const FaceLink& link = links.link(number);
  const laws::Facet<Real> face = links.springs_of(number);
  const laws::FaceSprings& kind = links.kind_of(number).springs;
  const Vector2 direction = links.direction_of(number);
  const Real c = particles.rotation[0][at(link.first)], s = particles.rotation[1][at(link.first)];
  const Vector2 n(c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y());
  const Real count = kind.count(), squares = kind.square_sum();
  springs.push_back({link.first,
                     link.second,
                     {n.x(), n.y(), face.first_shift, -n.x(), -n.y(), -face.second_shift},
                     count * face.normal,
                     count * face.normal_damping});
  springs.push_back({link.first,
                     link.second,
                     {0, 0, face.half_face, 0, 0, -face.half_face},
                     squares * face.normal,
                     squares * face.normal_damping});
  springs.push_back({link.first,
                     link.second,
                     {n.y(), -n.x(), -face.first_reach, -n.y(), n.x(), -face.second_reach},
                     count * face.shear,
                     count * face.shear_damping});
}

/// Springs of an element that lies on supports with its free faces.
void add_contacts(const state::Particles<2>& particles, const state::Outlines& outlines, const ContactRules& rules, std::size_t i,
                  std::vector<Spring>& springs) {
  const bool circle = outlines.kind[i] == geometry::OutlineKind::circle;
  const Real mass = 1 / particles.inverse_mass[i];
  const int exposed = circle ? 2 : std::popcount(outlines.exposed[i]);
  if (exposed == 0) return;
  const Real share = std::min(Real{1}, Real{2} / exposed);
  const Real normal = 2 * share * rules.normal_stiffness * rules.thickness,
             shear = 2 * share * rules.shear_stiffness * rules.thickness;
  const Real damping = 2 * rules.damping_ratio * std::sqrt(normal * mass) * std::sqrt(share),
             shear_damping = damping * std::sqrt(shear / normal);
  const geometry::Outline outline = outlines.at(particles, i);
  const auto own = static_cast<Index>(i);
  for (int number = 0; number < geometry::face_count(outline); ++number) {
    if (circle ? number % 2 != 0 : !geometry::is_exposed(outline, number)) continue;
    const geometry::Face face = geometry::face_of(outline, number);
    const Vector2 arm = face.centre - outline.centre, n = face.normal, along(n.y(), -n.x());
    const Real half = circle ? 0 : face.half;
    springs.push_back({own, own, {n.x(), n.y(), arm.x() * n.y() - arm.y() * n.x(), 0, 0, 0}, normal, damping});
    springs.push_back({own, own, {0, 0, half, 0, 0, 0}, normal, damping});
    springs.push_back(
        {own, own, {along.x(), along.y(), arm.x() * along.y() - arm.y() * along.x(), 0, 0, 0}, shear, shear_damping});
  }
}

/// y = M^-1/2 (sum of springs) M^-1/2 x.
Real largest(const state::Particles<2>& particles, const std::vector<Spring>& springs, Real Spring::*strength) {
  const std::size_t n = 3 * particles.size();
  std::vector<Real> weight(n);
  for (std::size_t i = 0; i < n; ++i) weight[i] = std::sqrt(particles.inverse_inertia_of(i % 3)[i / 3]);
  return largest_eigenvalue(
      n,
      [&](std::span<const Real> x, std::span<Real> y) {
        std::ranges::fill(y, 0);
        for (const Spring& spring : springs) {
          const std::size_t a = 3 * at(spring.first), b = 3 * at(spring.second);
          Real change = 0;
          for (std::size_t k = 0; k < 3; ++k)
            change += spring.by[k] * weight[a + k] * x[a + k] + spring.by[k + 3] * weight[b + k] * x[b + k];
          change *= spring.*strength;
          for (std::size_t k = 0; k < 3; ++k) {
            y[a + k] += spring.by[k] * weight[a + k] * change;
            y[b + k] += spring.by[k + 3] * weight[b + k] * change;
          }
        }
      },
      1e-5);
}

}  // namespace

StableStep stable_step(const state::Particles<2>& particles, const state::Outlines& outlines, const FaceLinks& links,
                       const ContactRules& contact, bool may_touch) {
  std::vector<Spring> springs;
  StableStep result{std::numeric_limits<Real>::infinity(), 0, std::numeric_limits<Real>::infinity()};
  const auto note = [&](Real damping, Real stiffness) {
    if (stiffness > 0) result.paper = std::min(result.paper, 0.5 * damping / stiffness);
  };
  for (Index number = 0; number < links.count(); ++number) {
    if (links.is_padding(number)) continue;
    add_link(particles, links, number, springs);
    const laws::Facet<Real> face = links.springs_of(number);
    note(std::sqrt(2.0) * face.normal_damping, face.normal);
  }
  for (std::size_t i = 0; may_touch && i < outlines.size(); ++i)
    if (outlines.block[i] >= 0) {
      add_contacts(particles, outlines, contact, i, springs);
      note(2 * contact.damping_ratio *
               std::sqrt(1 / (particles.inverse_mass[i] * 2 * contact.normal_stiffness * contact.thickness)),
           1);
    }
  const Real square = largest(particles, springs, &Spring::stiffness), damping = largest(particles, springs, &Spring::damping);
  result.largest_frequency = std::sqrt(square);
  if (square > 0) result.limit = 4 / (damping + std::sqrt(damping * damping + 4 * square));
  if (!std::isfinite(result.paper)) result.paper = 0;
  return result;
}

}  // namespace sazare::methods::rectangles
