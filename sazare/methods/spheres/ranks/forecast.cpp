#include "sazare/methods/spheres/ranks/forecast.hpp"

#include <algorithm>
#include <vector>

namespace sazare::methods::spheres {

namespace {

/// A sphere that a rank shows to another one.
struct Shown {
  int from = 0, to = 0;
  Index sphere = 0;
  auto operator<=>(const Shown&) const = default;
};

}  // namespace

SharingForecast forecast(const SphereLevels& levels, bool with_turns, int ranks) {
  std::vector<std::size_t> spheres;
  for (std::size_t level = 0; level < levels.count(); ++level) spheres.push_back(levels.pairs(level).pairs().first.size() - 1);
  const std::vector<int> owners = owners_by_level(spheres, ranks);
  const auto owner = [&](std::size_t tile) { return owners[tile]; };
  std::vector<std::int64_t> own(static_cast<std::size_t>(ranks), 0), bytes(own), shown_by(own);
  std::vector<Shown> shown;
  for (std::size_t level = 0; level < levels.count(); ++level) {
    const LoadTable& loads = levels.loads(level);
    for (std::size_t tile = 0; tile < loads.tiles(); ++tile) {
      const int from = owner(tile);
      if (level == 0) own[static_cast<std::size_t>(from)] += static_cast<std::int64_t>(loads.end_of(tile) - loads.begin_of(tile));
      for (const Index ghost : loads.ghosts(tile)) {
        const int home = owner(static_cast<std::size_t>(ghost) / neighbors::tile_size);
        if (home == from) continue;
        bytes[static_cast<std::size_t>(from)] += static_cast<std::int64_t>(Border::bytes_of_load) << level;
        shown.push_back({home, from, ghost});
      }
    }
  }
  std::ranges::sort(shown);
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  const auto bytes_of_sphere = static_cast<std::int64_t>(Border::bytes_of_motion + (with_turns ? Border::bytes_of_turn : 0));
  for (const Shown& one : shown) {
    ++shown_by[static_cast<std::size_t>(one.from)];
    bytes[static_cast<std::size_t>(one.from)] += bytes_of_sphere << levels.active_level(static_cast<std::size_t>(one.sphere));
  }
  return {std::ranges::min(own), std::ranges::max(own), std::ranges::max(shown_by), std::ranges::max(bytes)};
}

}  // namespace sazare::methods::spheres
