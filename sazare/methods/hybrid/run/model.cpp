#include "sazare/methods/hybrid/run/model.hpp"

#include <algorithm>
#include <array>

#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/methods/hybrid/run/continuum.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

methods::hybrid::CouplingRules coupling_rules(const cases::HybridCase& hybrid) {
  using methods::hybrid::CouplingScheme;
  constexpr std::array schemes = {CouplingScheme::automatic, CouplingScheme::lagged, CouplingScheme::impulse,
                                  CouplingScheme::iterative};  // as HybridScheme lists them
  const CouplingScheme scheme = schemes[static_cast<std::size_t>(hybrid.coupling.scheme)];
  return {scheme, surface_width(hybrid), hybrid.coupling.tolerance, hybrid.coupling.passes};
}

Real surface_width(const cases::HybridCase& hybrid) {
  if (hybrid.bodies->holds<cases::MpsCase>()) return 1;  // all of it is per metre
  const auto* rectangles = std::any_cast<cases::RectanglesCase>(&hybrid.bodies->content);
  return rectangles != nullptr ? rectangles->elements.thickness : hybrid.surface.width;
}

Index surface_material(const cases::HybridCase& hybrid) {
  const auto& materials = hybrid.bodies->as<cases::SpheresCase>().materials;
  return static_cast<Index>(std::ranges::find(materials, hybrid.surface.material, &cases::SphereMaterial::name) -
                            materials.begin());
}

geometry::LinearSurface coupled_surface(const cases::CaseFile& file, const geometry::ElementMesh& mesh) {
  return outer_surface(file, "surface.group", file.as<cases::HybridCase>().surface.group, mesh);
}

}  // namespace sazare::runs
