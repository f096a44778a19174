#include <algorithm>
#include <numbers>
#include <string>

#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real peak = 1.5e9, rise = 4e-6, decay_ratio = 4;  // over at 2e-5 s
constexpr Real hole_area = 6 * 0.025 * 0.2;                 // six sides, slab.geo
const Real impulse = peak * rise * (0.5 + 2 * decay_ratio / std::numbers::pi) * hole_area;

/// A slab that nothing holds, hit by a short pressure. From 2.2e-5 s on nothing from outside acts, while joints break and
/// blocks collide.
void print_drift(const std::string& name, const std::vector<std::string>& limiter, Real until) {
  std::vector<std::string> overrides = {"blasts.0.peak_pressure=1.5e9", "blasts.0.rise_time=4e-6", "blasts.0.decay_ratio=4",
                                        "constraints=[]"};
  overrides.insert(overrides.end(), limiter.begin(), limiter.end());
  auto model = validation::started_blast(overrides);
  validation::advance_to(model, 2.2e-5);
  const auto before = validation::momentum(*model.simulation);
  const Index broken = model.joints->broken_count();
  Real linear = 0, angular = 0;
  while (model.simulation->now().seconds() < until) {
    model.simulation->advance();
    const auto now = validation::momentum(*model.simulation);
    linear = std::max(linear, (now.linear - before.linear).norm() / impulse);
    angular = std::max(angular, (now.angular - before.angular).norm() / impulse);
  }
  const auto [lowest, highest] = validation::level_range(*model.simulation);
  validation::print_row((name + "-linear").c_str(), linear);
  validation::print_row((name + "-angular").c_str(), angular);
  validation::print_row((name + "-broken").c_str(), model.joints->broken_count() - broken);
  validation::print_row((name + "-levels").c_str(), highest - lowest);
}

}  // namespace

int main() {
  print_drift("stability", {}, 1e-4);
  print_drift("travel", {"time.limiter=\"travel\"", "time.base_step=2e-8", "time.travel_length=2e-7"}, 3e-5);
}
