/// Bonds that break, and bodies that part.

#include <algorithm>

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

/// Spheres whose bond has broken, at one of the levels just evaluated, may touch from the next step on; those of one piece when
/// it has parted.
void SphereStepper::part_broken(std::size_t coarsest) {
  std::vector<Index> torn;
  for (const Bonds::Broken& one : bonds_.take_broken(coarsest, ranks_.get())) {
    const auto& links = bonds_.links(one.level);
    const Index first = links.first[one.link], second = links.ends.second[one.link];
    const Index body = bodies_.empty() ? -1 : bodies_.of(spheres_.number[static_cast<std::size_t>(first)]);
    if (body >= 0 && body == bodies_.of(spheres_.number[static_cast<std::size_t>(second)])) torn.push_back(body);
    levels_.activate(spheres_, first, second, one.allowed_overlap);
  }
  std::ranges::sort(torn);
  torn.erase(std::unique(torn.begin(), torn.end()), torn.end());
  for (const Index body : torn) part_pieces(body);
}

/// Pairs that two pieces part from now on may touch: they push beyond the overlap they have.
void SphereStepper::part_pieces(Index body) {
  const auto range = bodies_.spheres(body);
  std::vector<Index> before;
  for (Index sphere = range.begin; sphere < range.end; ++sphere) before.push_back(bodies_.piece(sphere));
  const auto was_in = [&](Index sphere) { return before[static_cast<std::size_t>(sphere - range.begin)]; };
  bodies_.find_pieces(body, bonds_);
  for (Index sphere = range.begin; sphere < range.end; ++sphere) {
    const auto i = static_cast<std::size_t>(place_[static_cast<std::size_t>(sphere)]);
    const auto part_from = [&](Index j) {
      const Index other = spheres_.number[static_cast<std::size_t>(j)];
      if (bodies_.of(other) != body || was_in(sphere) != was_in(other) || bodies_.piece(sphere) == bodies_.piece(other)) return;
      const state::SpherePlace &one = spheres_.place[i], &next = spheres_.place[static_cast<std::size_t>(j)];
      const Real overlap = one.radius + next.radius - spheres_.box.nearest(next.centre() - one.centre()).norm();
      levels_.activate(spheres_, static_cast<Index>(i), j, overlap);
    };
    for (std::size_t level = 0; level <= levels_.active_level(i); ++level) {
      const auto& pairs = levels_.pairs(level).pairs();
      for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) part_from(pairs.other[p]);
    }
  }
}

}  // namespace sazare::methods::spheres
