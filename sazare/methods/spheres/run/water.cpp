#include "sazare/methods/spheres/run/water.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/geometry/ball_members.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

namespace {

using cases::SpheresCase;
using laws::BodyInWater;

/// Of a sphere of this volume.
Real area_of(Real volume) { return std::numbers::pi * std::pow(0.75 * volume / std::numbers::pi, 2.0 / 3); }

const cases::SphereMaterial& material_of(const SpheresCase& spheres, const Placement& placement, std::size_t sphere) {
  return spheres.materials[static_cast<std::size_t>(placement.spheres.spin[sphere].material)];
}

/// Volumes of a clump's spheres that have its volume and its centre together; in proportion to their own where none have.
std::vector<Real> shares_of(const state::Clump& clump, std::span<const state::ClumpMember> members, const state::Spheres& spheres) {
  std::vector<geometry::Ball> balls;
  Real own = 0;
  for (const state::ClumpMember& member : members) {
    balls.push_back({member.place, spheres.place[static_cast<std::size_t>(member.sphere)].radius});
    own += std::pow(balls.back().radius, 3);
  }
  const geometry::MassShares shares = geometry::share_mass(balls, clump.volume, clump.volume / clump.mass * clump.inertia);
  std::vector<Real> volumes;
  for (std::size_t n = 0; n < balls.size(); ++n)
    volumes.push_back(shares.of.empty() ? clump.volume * std::pow(balls[n].radius, 3) / own : shares.of[n].volume);
  return volumes;
}

/// Whose volume and area the clumps' spheres have.
void share_out_clumps(const Placement& placement, std::vector<BodyInWater>& bodies) {
  for (std::size_t c = 0; c < placement.clumps.clumps.size(); ++c) {
    const state::Clump& clump = placement.clumps.clumps[c];
    const auto members = placement.clumps.members_of(c);
    const std::vector<Real> volumes = shares_of(clump, members, placement.spheres);
    for (std::size_t n = 0; n < members.size(); ++n) {
      BodyInWater& body = bodies[static_cast<std::size_t>(members[n].sphere)];
      body.volume = volumes[n];
      body.area = area_of(clump.volume) * volumes[n] / clump.volume;
    }
  }
}

/// Spheres of bonded bodies have their volumes as shares of the mass; their areas together are that of the whole.
void share_out_bonded(const Placement& placement, std::vector<BodyInWater>& bodies) {
  std::vector<Real> whole(static_cast<std::size_t>(placement.bonded_bodies), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (placement.bonded_body[i] >= 0) whole[static_cast<std::size_t>(placement.bonded_body[i])] += bodies[i].volume;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (placement.bonded_body[i] < 0) continue;
    const Real volume = whole[static_cast<std::size_t>(placement.bonded_body[i])];
    bodies[i].area = area_of(volume) * bodies[i].volume / volume;
  }
}

/// Drag at rest must not turn a velocity round within a step.
void check_drag(const cases::CaseFile& file, const Placement& placement, const laws::WaterField& water,
                std::span<const BodyInWater> bodies, Real step) {
  Real longest = step;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].drag_coefficient)
      longest = std::min(longest, placement.spheres.place[i].mass / laws::sphere_drag(bodies[i].area, 0, water));
  if (longest < step)
    refuse(file, "water.viscosity",
           fmt::format("the viscous drag of the smallest spheres needs steps of at most {} s, and the step is {} s",
                       cases::short_number(longest, 3), cases::short_number(step, 3)),
           "give a smaller time.step or time.stability_fraction, or check the viscosity (water has 1e-3 Pa s)");
}

}  // namespace

methods::spheres::WaterForces water_around(const cases::CaseFile& file, const Placement& placement, Real step) {
  const SpheresCase& spheres = file.as<SpheresCase>();
  if (!spheres.water.is_there()) return {};
  std::vector<BodyInWater> bodies;
  for (std::size_t i = 0; i < placement.spheres.size(); ++i) {
    const state::SpherePlace& place = placement.spheres.place[i];
    const cases::SphereGroup& group = spheres.spheres[static_cast<std::size_t>(placement.group[i])];
    BodyInWater body;
    body.radius = place.radius;
    body.volume = place.mass / material_of(spheres, placement, i).density;
    body.area = area_of(body.volume);
    body.inertia_coefficient = group.inertia_coefficient.value_or(spheres.water.inertia_coefficient);
    body.drag_coefficient = group.drag_coefficient ? group.drag_coefficient : spheres.water.drag_coefficient;
    bodies.push_back(body);
  }
  share_out_clumps(placement, bodies);
  if (placement.bonded_bodies > 0) share_out_bonded(placement, bodies);
  const laws::WaterField water = cases::water_field(spheres.water, spheres.gravity);
  check_drag(file, placement, water, bodies, step);
  return {water, std::move(bodies)};
}

}  // namespace sazare::runs
