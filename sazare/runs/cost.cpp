#include "sazare/runs/cost.hpp"

#include <fmt/format.h>

#include "sazare/cases/explanation.hpp"
#include "sazare/runs/progress.hpp"

namespace sazare::runs {
namespace {

constexpr Real bytes_of_number = 14;     // in a table
constexpr Real bytes_of_snapshot = 2e4;  // besides its bodies

std::string size_text(Real bytes) {
  const bool is_large = bytes >= 1e9;
  return fmt::format("{} {}", cases::short_number(bytes / (is_large ? 1e9 : 1e6), 2), is_large ? "GB" : "MB");
}

}  // namespace

std::string cost_text(const Cost& cost, const RunClocks& clocks) {
  const auto rows = static_cast<Real>(clocks.rows), snapshots = rows / static_cast<Real>(clocks.rows_per_snapshot) + 1;
  const Real bytes = rows * cost.columns * bytes_of_number + snapshots * (bytes_of_snapshot + cost.bodies * cost.bytes_of_body);
  return cases::line("cost", fmt::format("about {} on one core at {} million a second; about {} of files",
                                         duration_text(cost.work / cost.work_per_second),
                                         cases::short_number(1e-6 * cost.work_per_second, 2), size_text(bytes)));
}

}  // namespace sazare::runs
