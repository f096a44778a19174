#include <fmt/format.h>

#include "sazare/cases/explanation.hpp"
#include "sazare/methods/hybrid/case/continuum.hpp"
#include "sazare/methods/hybrid/case/fields.hpp"
#include "sazare/methods/hybrid/case/format.hpp"

namespace sazare::cases {

std::string explain(const HybridCase& hybrid) {
  const HybridSurface& of = hybrid.surface;
  const std::string surface =
      of.group + (of.material.empty() ? "" : fmt::format(", in contact as {}", of.material)) +
      (of.width > 0 ? fmt::format(", a slab of {} m", short_number(of.width)) : "") +
      (of.friction_coefficient ? fmt::format(", friction {}", short_number(*of.friction_coefficient)) : "");
  const HybridCoupling& coupling = hybrid.coupling;
  std::string scheme(word(coupling.scheme));
  if (coupling.scheme == HybridScheme::iterative)
    scheme += fmt::format(", tolerance {} of the force, at most {} passes", short_number(coupling.tolerance), coupling.passes);
  if (coupling.scheme == HybridScheme::automatic) scheme += fmt::format(", at most {} passes", coupling.passes);
  return hybrid.title + "\n" + line("surface", surface) +
         line("coupling", fmt::format("{}, windows of {} s", scheme, short_number(*continuum_of(hybrid).time.step)));
}

}  // namespace sazare::cases
