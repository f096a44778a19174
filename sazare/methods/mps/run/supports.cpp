#include "sazare/methods/mps/run/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/motion_of_case.hpp"
#include "sazare/methods/mps/case/fields.hpp"

namespace sazare::runs {

namespace {

using cases::Side;
using cases::SideKind;
using methods::mps::Site;

/// Particles of a side, among those of its region.
template <int D>
std::vector<Index> particles_at(const cases::MpsCase& mps, const cases::SideBoundary& boundary, const Filling<D>& filling) {
  const auto& sites = filling.sites;
  const auto [axis, direction] = outward<D>(boundary.side);
  const auto belongs = [&](std::size_t i) {
    return boundary.region.empty() || mps.regions[static_cast<std::size_t>(filling.region[i])].name == boundary.region;
  };
  int outermost = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (belongs(i)) outermost = std::max(outermost, direction * sites[i][axis]);
  std::set<Site<D>> taken;
  if (boundary.extent == cases::SideExtent::surface) taken.insert(sites.begin(), sites.end());
  std::vector<Index> found;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!belongs(i)) continue;
    Site<D> beyond = sites[i];
    beyond[axis] += direction;
    const bool is_outside =
        boundary.extent == cases::SideExtent::surface ? !taken.contains(beyond) : direction * sites[i][axis] == outermost;
    if (boundary.side == Side::all || is_outside) found.push_back(static_cast<Index>(i));
  }
  return found;
}

/// How many particles a boundary has, and where.
template <int D>
std::string words_of_side(std::string_view name, std::string_view kind, const std::vector<Index>& found,
                          const Filling<D>& filling) {
  std::string text = fmt::format("{}: {}, {} particles", name, kind, found.size());
  for (int axis = 0; axis < D && !found.empty(); ++axis) {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const Index particle : found) {
      const Real place = filling.place(static_cast<std::size_t>(particle))[axis];
      low = std::min(low, place);
      high = std::max(high, place);
    }
    text += fmt::format(", {} {}", "xyz"[axis], cases::short_number(low, 4));
    if (high > low) text += fmt::format(" to {}", cases::short_number(high, 4));
  }
  return text + (found.empty() ? "" : " m");
}

/// The boundaries of a case in the order in which they apply: dashpots act along what nothing else holds, those of a base first.
std::vector<std::size_t> order_of(const cases::MpsCase& mps) {
  const auto rank = [&](std::size_t i) {
    const SideKind kind = mps.boundaries[i].kind;
    return kind == SideKind::free_field ? 2 : kind == SideKind::viscous ? 1 : 0;
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < mps.boundaries.size(); ++i) order.push_back(i);
  std::ranges::stable_sort(order, {}, rank);
  return order;
}

template <int D>
class SupportMaker {
public:
  SupportMaker(const cases::MpsCase& mps, MpsParts<D>& parts)
      : mps_(mps), material_(parts.material), particles_(parts.particles), links_(parts.links), supports_(parts.supports) {
    for (const cases::Motion& motion : mps_.motions) supports_.motions.push_back(cases::motion_of_case(motion));
    for (int axis = 0; axis < D; ++axis) supports_.gravity[axis] = mps_.gravity.acceleration[axis];
  }

  void make(const Members& members) {
    for (const std::size_t number : order_of(mps_)) {
      for (const Index particle : members[number])
        for (std::size_t axis = 0; axis < D; ++axis) add(mps_.boundaries[number], particle, axis);
      if (mps_.boundaries[number].kind != SideKind::roller) cut_in_half(members[number]);
    }
    if (mps_.damping.relative_to_base) supports_.find_base();
  }

private:
  /// The boundary goes through the centres of its particles: half of their volume lies beyond it.
  void cut_in_half(const std::vector<Index>& particles) {
    links_.halve_among(particles);
    for (const Index particle : particles) {
      const auto i = static_cast<std::size_t>(particle);
      particles_.inverse_mass[i] *= 2;
      particles_.inverse_inertia[i] *= 2;
      particles_.lame[i] *= 2;  // half of the volume, and twice the strain that half of its links tell
    }
  }

  void add(const cases::SideBoundary& boundary, Index particle, std::size_t axis) {
    const std::size_t normal = outward<D>(boundary.side).first;
    const auto freedom = static_cast<int>(axis);
    const Index motion = motion_of(boundary.motion[axis]);
    const bool named = boundary.axes[0] || boundary.axes[1] || boundary.axes[2];
    const bool held = boundary.kind == SideKind::fixed ||
                      (boundary.kind == SideKind::roller && (named ? boundary.axes[axis] : axis == normal)) ||
                      (boundary.kind == SideKind::prescribed && motion < 0);
    if (taken_.contains({particle, freedom})) return;
    if (held) {
      supports_.held.push_back({particle, freedom});
    } else if (boundary.kind == SideKind::prescribed) {
      supports_.driven.push_back({particle, freedom, motion, 1});
    } else if (boundary.kind == SideKind::viscous || boundary.kind == SideKind::free_field) {
      const auto i = static_cast<std::size_t>(particle);
      const cases::Ground& ground = mps_.materials[static_cast<std::size_t>(material_[i])];
      // Impedance times the area of a particle, over half of its mass.
      const Real rate = 2 * (axis == normal ? ground.p_wave_velocity : ground.s_wave_velocity) / particles_.spacing;
      supports_.dashpots.push_back({particle, freedom, rate, motion, 1});
      supports_.dashpots.back().is_beside_column = boundary.kind == SideKind::free_field;
      supports_.dashpots.back().settles = boundary.kind == SideKind::free_field && axis != normal;
    } else {
      return;
    }
    taken_.insert({particle, freedom});
  }

  Index motion_of(const std::string& name) const {
    for (std::size_t i = 0; i < mps_.motions.size(); ++i)
      if (!name.empty() && mps_.motions[i].name == name) return static_cast<Index>(i);
    return -1;
  }

  const cases::MpsCase& mps_;
  const std::vector<Index>& material_;
  state::Particles<D>& particles_;
  methods::mps::LinkTable<D>& links_;
  particles::ParticleSupports<D>& supports_;
  std::set<std::pair<Index, int>> taken_;
};

}  // namespace

template <int D>
Members members_of(const cases::MpsCase& mps, const Filling<D>& filling) {
  Members members;
  for (const cases::SideBoundary& boundary : mps.boundaries) members.push_back(particles_at<D>(mps, boundary, filling));
  return members;
}

template <int D>
std::vector<std::string> words_of_sides(const cases::MpsCase& mps, const Members& members, const Filling<D>& filling) {
  std::vector<std::string> words;
  for (const std::size_t number : order_of(mps)) {
    const cases::SideBoundary& boundary = mps.boundaries[number];
    words.push_back(words_of_side<D>(cases::EnumWords<Side>::words[static_cast<std::size_t>(boundary.side)],
                                     cases::EnumWords<SideKind>::words[static_cast<std::size_t>(boundary.kind)], members[number],
                                     filling));
  }
  return words;
}

template <int D>
void add_supports(const cases::MpsCase& mps, const Members& members, MpsParts<D>& parts) {
  SupportMaker<D>(mps, parts).make(members);
}

template Members members_of<2>(const cases::MpsCase&, const Filling<2>&);
template Members members_of<3>(const cases::MpsCase&, const Filling<3>&);
template std::vector<std::string> words_of_sides<2>(const cases::MpsCase&, const Members&, const Filling<2>&);
template std::vector<std::string> words_of_sides<3>(const cases::MpsCase&, const Members&, const Filling<3>&);
template void add_supports<2>(const cases::MpsCase&, const Members&, MpsParts<2>&);
template void add_supports<3>(const cases::MpsCase&, const Members&, MpsParts<3>&);

}  // namespace sazare::runs
