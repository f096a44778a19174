#include "sazare/cases/outside_histories.hpp"

#include <fmt/format.h>

#include <utility>

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

std::vector<OutsideHistory> histories_of(const BlocksCase& blocks) {
  std::vector<OutsideHistory> found;
  for (std::size_t i = 0; i < blocks.blasts.size(); ++i)
    if (const auto* function = std::get_if<PressureFunction>(&blocks.blasts[i].pressure))
      found.push_back({blocks.blasts[i].name, fmt::format("blasts.{}.function", i), "pressure of the blast",
                       blocks.blasts[i].delay, function->samples});
  return found;
}

template <class Case>
std::vector<OutsideHistory> histories_of(const Case& content) {
  std::vector<OutsideHistory> found;
  for (std::size_t i = 0; i < content.motions.size(); ++i)
    if (content.motions[i].type == MotionShape::function)
      found.push_back({content.motions[i].name, fmt::format("motions.{}.type", i), "motion", 0, content.motions[i].samples});
  return found;
}

/// Of both sides; what both name alike is one function.
std::vector<OutsideHistory> histories_of(const HybridCase& hybrid) {
  std::vector<OutsideHistory> found;
  for (const auto& [side, key] : {std::pair{hybrid.continuum, "sides.continuum"}, std::pair{hybrid.bodies, "sides.bodies"}})
    for (OutsideHistory& history : outside_histories(*side)) {
      history.key = key;
      found.push_back(std::move(history));
    }
  return found;
}

}  // namespace

void OutsideHistory::add(Real step, std::span<const Real> values) const {
  std::visit([&](const auto& filled) { add_to(*filled, step, values); }, samples);
}

std::vector<OutsideHistory> outside_histories(const CaseFile& file) {
  return std::visit([](const auto& content) { return histories_of(content); }, file.content);
}

void refuse_outside_histories(const CaseFile& file) {
  for (const OutsideHistory& history : outside_histories(file))
    refuse(file, history.key,
           fmt::format("the {} \"{}\" is a function, which a case file cannot hold", history.what, history.name),
           fmt::format("run the case from Python with functions={{\"{}\": ...}}, or give a table", history.name));
}

}  // namespace sazare::cases
