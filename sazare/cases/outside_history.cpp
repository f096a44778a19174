#include "sazare/cases/outside_history.hpp"

#include <fmt/format.h>

namespace sazare::cases {
namespace {

void add_to(laws::Record& record, Real step, std::span<const Real> values) {
  record.step = step;
  for (const Real value : values) record.add(value);
}

void add_to(laws::PressureTable& table, Real step, std::span<const Real> values) {
  for (const Real value : values) {
    table.time.push_back(static_cast<Real>(table.time.size()) * step);
    table.pressure.push_back(value);
  }
}

}  // namespace

void OutsideHistory::add(Real step, std::span<const Real> values) const {
  std::visit([&](const auto& filled) { add_to(*filled, step, values); }, samples);
}

std::vector<OutsideHistory> outside_motions(std::span<const Motion> motions) {
  std::vector<OutsideHistory> found;
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (motions[i].type == MotionShape::function)
      found.push_back({motions[i].name, fmt::format("motions.{}.type", i), "motion", 0, motions[i].samples});
  return found;
}

}  // namespace sazare::cases
