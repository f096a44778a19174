#include "sazare/methods/blocks/run/check/waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sazare/cases/explanation.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::runs {

namespace {

constexpr Real left_out = 0.05;  // of the faces at either end

struct Speeds {
  Real p = 0, s = 0;  // m/s
};

std::string speed_text(Real value) { return cases::short_number(value, 3); }

Speeds speeds_of(const laws::ElasticModuli& body, Real density) {
  return {std::sqrt(body.confined() / density), std::sqrt(body.shear() / density)};
}

/// The body all of whose faces are like this one.
laws::ElasticModuli moduli_at(const BlocksModel& model, Index joint) {
  const auto& record = model.joints->record(joint);
  const auto& bodies = model.simulation->bodies();
  const Vector3 normal = state::start_rotation(bodies, record.master) * record.normal;
  const Real distance = normal.dot(bodies.start[at(record.slave)] - bodies.start[at(record.master)]);
  const auto springs = model.joints->elastic(joint);
  return laws::elastic_moduli({springs.normal_stiffness * distance, springs.shear_stiffness * distance});
}

std::string range(std::vector<Real>& values) {
  std::ranges::sort(values);
  const auto skipped = static_cast<std::size_t>(left_out * static_cast<Real>(values.size()));
  return fmt::format("{} to {}", speed_text(values[skipped]), speed_text(values[values.size() - 1 - skipped]));
}

/// Where the joints of a material with itself have a stiffness per area.
std::string spread(const BlocksModel& model, Index material, const cases::Material& of) {
  std::vector<Real> p, s;
  for (Index joint = 0; joint < model.joints->count(); ++joint) {
    const auto& link = model.joints->record(joint);
    if (model.material[at(link.master)] != material || model.material[at(link.slave)] != material) continue;
    const auto springs = model.joints->elastic(joint);
    if (!laws::is_fitted(springs.shear_stiffness / springs.normal_stiffness)) return "";
    const Speeds here = speeds_of(moduli_at(model, joint), of.density);
    p.push_back(here.p);
    s.push_back(here.s);
  }
  if (p.empty()) return "";
  return fmt::format("P {} m/s, S {} m/s, depending on the size of elements (without the outer {} % of the faces)", range(p),
                     range(s), 100 * left_out);
}

/// The slowest S waves of a material [m/s], and the longest edge of its elements [m]; 0 where springs stand for no body.
std::pair<Real, Real> slowest_and_longest(const cases::BlocksCase& blocks, const BlocksModel& model, Index material) {
  Real slowest = std::numeric_limits<Real>::infinity(), longest = 0;
  const cases::Material& of = blocks.materials[at(material)];
  for (Index joint = 0; joint < model.joints->count(); ++joint) {
    const auto& link = model.joints->record(joint);
    if (model.material[at(link.master)] != material || model.material[at(link.slave)] != material) continue;
    slowest = std::min(slowest, speeds_of(elastic_body_at(model, joint, of), of.density).s);
    longest = std::max(longest, longest_edge(model.mesh, link.master));
  }
  return {std::isfinite(slowest) ? slowest : 0, longest};
}

std::string shortest_wave_text(const cases::BlocksCase& blocks, const BlocksModel& model, Index material) {
  const auto [slowest, longest] = slowest_and_longest(blocks, model, material);
  if (!(slowest > 0 && longest > 0)) return "";
  return fmt::format("; S waves of {} Hz are ten times {} m long", cases::number(slowest / (10 * longest), 3),
                     cases::number(longest, 3));
}

}  // namespace

laws::ElasticModuli elastic_body_at(const BlocksModel& model, Index joint, const cases::Material& material) {
  if (material.has_moduli()) return material.moduli();
  const auto springs = model.joints->elastic(joint);
  if (!laws::is_fitted(springs.shear_stiffness / springs.normal_stiffness)) return {};
  return moduli_at(model, joint);
}

Real longest_edge(const geometry::TetraMesh& mesh, Index element) {
  const auto corners = geometry::corners_of(mesh, element);
  Real longest = 0;
  for (const Vector3& one : corners)
    for (const Vector3& other : corners) longest = std::max(longest, (one - other).norm());
  return longest;
}

std::string describe_waves(const cases::BlocksCase& blocks, const BlocksModel& model) {
  std::string text;
  for (std::size_t n = 0; n < blocks.materials.size(); ++n) {
    const cases::Material& material = blocks.materials[n];
    std::string speeds;
    if (material.has_moduli()) {
      const Speeds all = speeds_of(material.moduli(), material.density);
      speeds = fmt::format("P {} m/s, S {} m/s, in elements of any size", speed_text(all.p), speed_text(all.s));
    } else {
      speeds = spread(model, static_cast<Index>(n), material);
    }
    if (!speeds.empty()) speeds += shortest_wave_text(blocks, model, static_cast<Index>(n));
    if (!speeds.empty()) text += cases::line(text.empty() ? "waves" : "", fmt::format("{}: {}", material.name, speeds));
  }
  return text;
}

}  // namespace sazare::runs
