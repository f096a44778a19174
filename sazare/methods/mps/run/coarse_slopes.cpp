#include "sazare/methods/mps/run/coarse_slopes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sazare/cases/format/number_text.hpp"

namespace sazare::runs {
namespace {

// A slope of 40 degrees rested at Bishop's factor of safety of 0.82 with 20 particles over its height, and at 0.96 with 40.
constexpr int enough = 40, no_slope = 2;

/// How many particles the top of the body rises by.
template <int D>
int relief(const Filling<D>& filling) {
  std::map<methods::mps::Site<D>, int> top;  // by column: the site with height 0
  for (const methods::mps::Site<D>& site : filling.sites) {
    methods::mps::Site<D> column = site;
    column[D - 1] = 0;
    const auto found = top.try_emplace(column, site[D - 1]).first;
    found->second = std::max(found->second, site[D - 1]);
  }
  const auto [low, high] = std::ranges::minmax_element(top, {}, [](const auto& column) { return column.second; });
  return top.empty() ? 0 : high->second - low->second;
}

}  // namespace

template <int D>
std::string warn_of_coarse_slopes(const cases::CaseFile& file, const Filling<D>& filling) {
  const auto& mps = file.as<cases::MpsCase>();
  const bool yields = std::ranges::any_of(mps.materials, [](const cases::Ground& ground) { return ground.yields; });
  if (!mps.gravity.settle || !yields) return {};
  const int particles = relief<D>(filling);
  if (particles <= no_slope || particles >= enough) return {};
  const Real height = particles * filling.spacing;
  return warning(
      file, "particles.spacing",
      fmt::format("the ground rises by {} m, {} particles: so few bear more than their strength says",
                  cases::short_number(height, 4), particles),
      fmt::format("a slope with 20 particles over its height rested at a factor of safety of 0.82, one with 40 at 0.96: to judge "
                  "whether it stands, take {} m or less",
                  cases::short_number(height / enough, 2)));
}

template std::string warn_of_coarse_slopes<2>(const cases::CaseFile&, const Filling<2>&);
template std::string warn_of_coarse_slopes<3>(const cases::CaseFile&, const Filling<3>&);

}  // namespace sazare::runs
