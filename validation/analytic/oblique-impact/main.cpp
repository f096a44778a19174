#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/common/oblique_impact.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using laws::ContactModel;
using validation::ObliqueImpact;

void print_row(const std::string& row, Real ours, Real expected) { validation::print_row(row.c_str(), ours, expected); }

/// Two solids alike, Poisson's ratio 0.3, so slowly that the overlap is nothing beside the radius.
ObliqueImpact at_psi(Real psi) {
  ObliqueImpact impact{.ball = {7e10, 0.3}, .wall = {7e10, 0.3}, .density = 2700, .radius = 0.0025, .friction = 0.1};
  const Real tangent = psi / impact.psi_scale(), speed = 0.01;  // along the normal, m/s
  impact.speed = speed * std::sqrt(1 + tangent * tangent);
  impact.angle = std::atan(tangent) * 180 / std::numbers::pi;
  return impact;
}

/// A ball of aluminium oxide on glass.
ObliqueImpact at_angle(Real angle) {
  return {.ball = {3.8e11, 0.23},
          .wall = {7e10, 0.25},
          .density = 4000,
          .radius = 0.0025,
          .friction = 0.092,
          .speed = 0.01,
          .angle = angle};
}

}  // namespace

int main() {
  for (const Real psi : {0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0}) {
    const ObliqueImpact impact = at_psi(psi);
    print_row(fmt::format("psi-{:.1f}", psi), rebound(impact, ContactModel::mindlin_deresiewicz).psi,
              rebound_of_theory(impact).psi);
  }
  for (const Real angle : {5, 10, 15, 20, 25, 30, 40, 60, 80}) {
    const ObliqueImpact impact = at_angle(angle);
    print_row(fmt::format("angle-{:.0f}", angle), rebound(impact, ContactModel::mindlin_deresiewicz).tangential,
              rebound_of_theory(impact).tangential);
  }
}
