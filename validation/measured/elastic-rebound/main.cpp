#include <fmt/format.h>

#include <span>
#include <utility>

#include "validation/common/oblique_impact.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Angle to the normal [deg] and what was measured.
using Measured = std::pair<Real, Real>;

constexpr Measured restitutions[] = {{2.0275, 0.7938},  {3.9282, 0.7450},  {9.6304, 0.6728},  {20.0845, 0.5964},
                                     {30.2218, 0.6883}, {39.3031, 0.7719}, {49.5459, 0.8469}, {59.8416, 0.9019}};
constexpr Measured angles[] = {{2.2945, 1.7630},   {4.2922, 2.9577},   {9.9429, 6.6917},   {20.5594, 12.3645},
                               {30.3767, 21.7809}, {39.6233, 32.5455}, {49.7831, 45.1051}, {60.0571, 57.3652}};
constexpr Measured spins[] = {{6.0025, 135.5703},  {10.9840, 264.5493}, {21.1931, 577.0096}, {31.0947, 612.6481},
                              {39.0283, 595.4843}, {50.2214, 452.9444}, {60.2460, 381.3185}};

validation::Rebound ours(Real angle) {
  const validation::ObliqueImpact impact{.ball = {3.8e11, 0.23},
                                         .wall = {7e10, 0.25},
                                         .density = 4000,
                                         .radius = 0.0025,
                                         .friction = 0.092,
                                         .restitution = 0.98,
                                         .speed = 3.9,
                                         .angle = angle};
  return rebound(impact, laws::ContactModel::mindlin_deresiewicz);
}

void print_rows(const char* name, std::span<const Measured> all, Real validation::Rebound::*quantity) {
  for (const auto& [angle, measured] : all)
    validation::print_row(fmt::format("{}-{:.0f}", name, angle).c_str(), ours(angle).*quantity, measured);
}

}  // namespace

int main() {
  print_rows("tangential", restitutions, &validation::Rebound::tangential);
  print_rows("angle", angles, &validation::Rebound::angle);
  print_rows("spin", spins, &validation::Rebound::spin);
}
