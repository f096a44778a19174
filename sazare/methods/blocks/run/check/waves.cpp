#include "sazare/methods/blocks/run/check/waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sazare/cases/explanation.hpp"

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

/// Wave velocities of a body all of whose faces are like this one.
Speeds speeds_at(const BlocksModel& model, Index joint, Real density) {
  const auto& record = model.joints->record(joint);
  const auto& bodies = model.simulation->bodies();
  const Vector3 normal = state::start_rotation(bodies, record.master) * record.normal;
  const Real distance = normal.dot(bodies.start[at(record.slave)] - bodies.start[at(record.master)]);
  const auto springs = model.joints->elastic(joint);
  return speeds_of(laws::elastic_moduli({springs.normal_stiffness * distance, springs.shear_stiffness * distance}), density);
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
    const Speeds here = speeds_at(model, joint, of.density);
    p.push_back(here.p);
    s.push_back(here.s);
  }
  if (p.empty()) return "";
  return fmt::format("P {} m/s, S {} m/s, depending on the size of elements (without the outer {} % of the faces)", range(p),
                     range(s), 100 * left_out);
}

}  // namespace

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
    if (!speeds.empty()) text += cases::line(text.empty() ? "waves" : "", fmt::format("{}: {}", material.name, speeds));
  }
  return text;
}

}  // namespace sazare::runs
