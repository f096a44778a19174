/// How much of a stable step the contacts take that spheres have now.

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

void SphereStepper::look_at_step() {
  if (looked_at_step_ == step_) return;
  looked_at_step_ = step_;
  const std::vector<Index> clump_of =
      body_.empty() ? std::vector<Index>{} : by_place([&](Index number) { return body_[static_cast<std::size_t>(number)]; });
  const methods::spheres::StepLoad now = methods::spheres::largest_step_load(
      {spheres_, clumps_, clump_of}, walls_.table(), [&](const auto& visit) { visit_contacts(visit); });
  if (now.load > step_load_.load) step_load_ = now;
}

/// All contacts that push; those with surfaces as they were last evaluated.
void SphereStepper::visit_contacts(const std::function<void(const methods::spheres::ContactPoint&)>& visit) const {
  for (std::size_t level = 0; level < levels_.count(); ++level) {
    const Real step = levels_.step(level);
    levels_.pairs(level).visit_contacts([&](Index one, Index other, Real initial_overlap) {
      const auto first = static_cast<std::size_t>(one), second = static_cast<std::size_t>(other);
      const auto &a = spheres_.place[first], &b = spheres_.place[second];
      const Vector3 apart = spheres_.box.nearest(b.centre() - a.centre());
      const Real distance = apart.norm(), overlap = a.radius + b.radius - distance - initial_overlap;
      if (overlap > 0) visit({first, second, {}, apart / distance, overlap, step});
    });
    walls_.visit_contacts(spheres_, level, [&](Index sphere, Index material, const Vector3& normal, Real overlap) {
      const auto first = static_cast<std::size_t>(sphere);
      visit({first, first, material, normal, overlap, step});
    });
  }
}

}  // namespace sazare::methods::spheres
