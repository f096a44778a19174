#include "sazare/methods/mps/run/loose_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/explanation.hpp"

namespace sazare::runs {
namespace {

/// Marks all particles that links join to this one.
template <int D>
void mark_joined(const methods::mps::LinkTable<D>& links, Index from, std::vector<char>& marked) {
  std::vector<Index> open{from};
  marked[at(from)] = 1;
  while (!open.empty()) {
    const Index particle = open.back();
    open.pop_back();
    for (std::size_t n = 0; n < links.directions.size(); ++n) {
      const Index next = links.directions[n].neighbor[at(particle)];
      if (!links.is_present(n, particle) || marked[at(next)] != 0) continue;
      marked[at(next)] = 1;
      open.push_back(next);
    }
  }
}

/// Where no boundary holds anything.
std::string warn_of_fall(const cases::CaseFile& file) {
  if (file.as<cases::MpsCase>().gravity.acceleration.isZero(0)) return {};
  return warning(file, "gravity.acceleration", "nothing holds the ground: it falls",
                 "add [[boundaries]], such as side = \"bottom\" with kind = \"fixed\"");
}

}  // namespace

template <int D>
std::string warn_of_loose_parts(const cases::CaseFile& file, const MpsParts<D>& parts) {
  std::vector<char> held(parts.particles.size(), 0);
  const auto mark = [&](const auto& supports) {
    for (const auto& support : supports)
      if (held[at(support.particle)] == 0) mark_joined<D>(parts.links, support.particle, held);
  };
  mark(parts.supports.held);
  mark(parts.supports.driven);
  mark(parts.supports.dashpots);
  const auto loose = std::ranges::count(held, 0);
  if (loose == 0) return {};
  if (loose == static_cast<std::ptrdiff_t>(held.size())) return warn_of_fall(file);
  const auto first = static_cast<std::size_t>(std::ranges::find(held, 0) - held.begin());
  Vector3 place = Vector3::Zero();
  for (std::size_t axis = 0; axis < D; ++axis) place[static_cast<Eigen::Index>(axis)] = parts.particles.start[axis][first];
  return warning(
      file, "regions",
      fmt::format("nothing holds {} of the {} particles, such as that at {} m: no link joins them to a boundary", loose,
                  held.size(), cases::vector_text(place)),
      fmt::format("they move freely and do not feel the motion of the base; close gaps between regions that are wider than "
                  "the influence radius of {} m",
                  cases::number(file.as<cases::MpsCase>().particles.influence * parts.particles.spacing)));
}

template std::string warn_of_loose_parts<2>(const cases::CaseFile&, const MpsParts<2>&);
template std::string warn_of_loose_parts<3>(const cases::CaseFile&, const MpsParts<3>&);

}  // namespace sazare::runs
