#include "sazare/methods/mps/run/side_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/mps/case/fields.hpp"
#include "sazare/methods/mps/run/supports.hpp"

namespace sazare::runs {

namespace {

using cases::SideKind;
using methods::mps::Site;

constexpr int reach_of_broken_ground = 2;  // particles: gathered_ground.hpp, 2.4 spacings

/// What the ground is at an elevation.
struct Layer {
  Index material = 0, region = 0;
  std::set<std::size_t> boundaries;  ///< through it, but for free-field ones

  bool operator==(const Layer& other) const { return material == other.material && boundaries == other.boundaries; }
};

/// A free-field side, and its layers by the vertical number of their particles.
template <int D>
struct LevelSide {
  std::size_t boundary = 0, axis = 0;
  int direction = 1, outermost = 0;
  std::map<int, Layer> layers;

  /// How many particles lie between the side and a site.
  int depth(const Site<D>& site) const { return outermost - direction * site[axis]; }
};

template <int D>
class SideMaker {
public:
  SideMaker(const cases::CaseFile& file, const MpsParts<D>& ground)
      : file_(file), mps_(file.as<cases::MpsCase>()), ground_(ground), members_(members_of<D>(mps_, ground.filling)) {
    reach_ = static_cast<int>(std::ceil(mps_.particles.influence)) - 1;
    if (std::ranges::any_of(mps_.materials, &cases::Ground::yields)) reach_ = std::max(reach_, reach_of_broken_ground);
    boundaries_.resize(ground.filling.sites.size());
    for (std::size_t i = 0; i < members_.size(); ++i)
      for (const Index particle : members_[i])
        if (mps_.boundaries[i].kind != SideKind::free_field) boundaries_[at(particle)].insert(i);
  }

  SideParts<D> make() {
    for (std::size_t i = 0; i < mps_.boundaries.size(); ++i)
      if (mps_.boundaries[i].kind == SideKind::free_field) sides_.push_back(look_at(i));
    for (const LevelSide<D>& side : sides_) parts_.columns.push_back(column_of(side));
    make_copies();
    join_dashpots();
    return std::move(parts_);
  }

private:
  static constexpr std::size_t up = D - 1;
  using Sides = std::array<int, D - 1>;  ///< by horizontal axis: a side, or -1

  /// The links of a particle within `reach_` of the side see that it is cut in half, and those of a particle twice as far see
  /// their pressure; what these see themselves reaches twice as far again.
  int corrected() const { return 2 * reach_; }
  int thickness() const { return 4 * reach_; }
  int width() const { return 2 * reach_ + 1; }

  Layer layer_of(std::size_t particle) const {
    return {ground_.material[particle], ground_.filling.region[particle], boundaries_[particle]};
  }

  LevelSide<D> look_at(std::size_t boundary) const {
    LevelSide<D> side;
    side.boundary = boundary;
    std::tie(side.axis, side.direction) = outward<D>(mps_.boundaries[boundary].side);
    const auto& sites = ground_.filling.sites;
    side.outermost = side.direction * sites[at(members_[boundary].front())][side.axis];
    std::array<int, D> low, high;
    low.fill(std::numeric_limits<int>::max());
    high.fill(std::numeric_limits<int>::min());
    for (const Site<D>& site : sites)
      for (std::size_t axis = 0; axis < D; ++axis) {
        low[axis] = std::min(low[axis], site[axis]);
        high[axis] = std::max(high[axis], site[axis]);
      }
    if (high[side.axis] - low[side.axis] + 1 < 2 * thickness())
      refuse(file_, key(boundary),
             fmt::format("no column can stand beside {}: the body is {} particles wide", name(boundary),
                         high[side.axis] - low[side.axis] + 1),
             fmt::format("free-field sides require {} particles along the axis {}", 2 * thickness(), "xyz"[side.axis]));
    std::map<int, int> counts;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (side.depth(sites[i]) >= thickness()) continue;
      ++counts[sites[i][up]];
      check(side, i, side.layers.try_emplace(sites[i][up], layer_of(i)).first->second);
    }
    int whole = thickness();
    for (std::size_t axis = 0; axis < up; ++axis)
      if (axis != side.axis) whole *= high[axis] - low[axis] + 1;
    for (const auto& [row, count] : counts)
      if (count != whole)
        refuse_uneven(boundary, fmt::format("at {} = {} m there are {} of {} particles", "xyz"[up],
                                            cases::short_number(elevation(row), 5), count, whole));
    return side;
  }

  void check(const LevelSide<D>& side, std::size_t particle, const Layer& layer) const {
    const Layer own = layer_of(particle);
    if (own == layer) return;
    const auto& materials = mps_.materials;
    refuse_uneven(side.boundary, own.material != layer.material
                                     ? fmt::format("at {} = {} m there are both \"{}\" and \"{}\"", "xyz"[up],
                                                   cases::short_number(elevation(ground_.filling.sites[particle][up]), 5),
                                                   materials[at(layer.material)].name, materials[at(own.material)].name)
                                     : fmt::format("at {} = {} m a boundary has some of the particles and not all", "xyz"[up],
                                                   cases::short_number(elevation(ground_.filling.sites[particle][up]), 5)));
  }

  [[noreturn]] void refuse_uneven(std::size_t boundary, const std::string& what) const {
    refuse(file_, key(boundary), fmt::format("no column of layers fits the ground beside {}: {}", name(boundary), what),
           fmt::format("let ground, layers and other boundaries be level for {} particles beside the side, {} m", thickness(),
                       cases::short_number(thickness() * mps_.particles.spacing, 5)));
  }

  Real elevation(int row) const { return ground_.filling.origin[up] + (row + 0.5) * mps_.particles.spacing; }
  std::string name(std::size_t boundary) const {
    return fmt::format("side \"{}\"",
                       cases::EnumWords<cases::Side>::words[static_cast<std::size_t>(mps_.boundaries[boundary].side)]);
  }
  static std::string key(std::size_t boundary) { return fmt::format("boundaries.{}.side", boundary); }

  /// Layers of a side that are as wide as told, with what holds them. Rows stand one after the other.
  MpsParts<D> layers(const LevelSide<D>& side, const std::array<int, D - 1>& widths, Site<D> period) const {
    Filling<D> filling;
    filling.spacing = ground_.filling.spacing;
    filling.origin[up] = ground_.filling.origin[up];
    int stacks = 1;
    for (const int one : widths) stacks *= one;
    for (int stack = 0; stack < stacks; ++stack)
      for (const auto& [row, layer] : side.layers) {
        Site<D> site;
        site[up] = row;
        site[0] = stack % widths[0];
        if constexpr (D == 3) site[1] = stack / widths[0];
        filling.sites.push_back(site);
        filling.region.push_back(layer.region);
      }
    period[up] = ground_.period[up];
    return lay_out<D>(mps_, std::move(filling), period);
  }

  /// Boundaries that go through layers; a side itself through the outermost of its particles.
  Members members_at(const LevelSide<D>& layers_of, const std::vector<Site<D>>& sites, const Sides& at_sides) const {
    Members members(mps_.boundaries.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      for (const std::size_t boundary : layers_of.layers.at(sites[i][up]).boundaries)
        members[boundary].push_back(static_cast<Index>(i));
      for (std::size_t axis = 0; axis < up; ++axis)
        if (const int side = at_sides[axis]; side >= 0 && sites[i][axis] == place(sides_[at(side)], 0))
          members[sides_[at(side)].boundary].push_back(static_cast<Index>(i));
    }
    return members;
  }

  MpsParts<D> column_of(const LevelSide<D>& side) const {
    std::array<int, D - 1> widths;
    widths.fill(width());
    Site<D> period{};
    period.fill(width());
    MpsParts<D> column = layers(side, widths, period);
    Sides none;
    none.fill(-1);
    add_supports<D>(mps_, members_at(side, column.filling.sites, none), column);
    column.supports.base = ground_.supports.base;
    return column;
  }

  /// Where a particle at a depth stands in a copy, along the axis of the side.
  int place(const LevelSide<D>& side, int depth) const { return side.direction < 0 ? depth : thickness() - 1 - depth; }

  void make_copies() {
    std::map<Sides, std::vector<Index>> groups;
    const auto& sites = ground_.filling.sites;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      Sides near;
      near.fill(-1);
      for (std::size_t side = 0; side < sides_.size(); ++side)
        if (sides_[side].depth(sites[i]) < corrected()) near[sides_[side].axis] = static_cast<int>(side);
      if (std::ranges::any_of(near, [](int side) { return side >= 0; })) groups[near].push_back(static_cast<Index>(i));
    }
    for (const auto& [near, members] : groups) parts_.copies.push_back(copy_of(near, members));
  }

  typename SideParts<D>::Copy copy_of(const Sides& near, const std::vector<Index>& particles) const {
    typename SideParts<D>::Copy copy;
    copy.column = at(*std::ranges::find_if(near, [](int side) { return side >= 0; }));
    const LevelSide<D>& first = sides_[copy.column];
    std::array<int, D - 1> widths;
    Site<D> period{};
    for (std::size_t axis = 0; axis < up; ++axis) {
      widths[axis] = near[axis] >= 0 ? thickness() : width();
      period[axis] = near[axis] >= 0 ? 0 : width();
    }
    copy.parts = layers(first, widths, period);
    add_supports<D>(mps_, members_at(first, copy.parts.filling.sites, near), copy.parts);
    std::map<Site<D>, Index> found;
    for (const Site<D>& site : copy.parts.filling.sites) {
      copy.follows.push_back(row_of(first, site[up]));
      found[site] = static_cast<Index>(found.size());
    }
    for (const Index particle : particles) {
      const Site<D>& own = ground_.filling.sites[at(particle)];
      Site<D> site{};
      site[up] = own[up];
      for (std::size_t axis = 0; axis < up; ++axis)
        if (near[axis] >= 0) site[axis] = place(sides_[at(near[axis])], sides_[at(near[axis])].depth(own));
      copy.pairs.push_back({found.at(site), particle});
    }
    return copy;
  }

  /// The particle of a column at an elevation, in its first stack.
  static Index row_of(const LevelSide<D>& side, int row) {
    return static_cast<Index>(std::distance(side.layers.begin(), side.layers.find(row)));
  }

  void join_dashpots() {
    const auto& dashpots = ground_.supports.dashpots;
    for (std::size_t i = 0; i < dashpots.size(); ++i) {
      if (!dashpots[i].is_beside_column) continue;
      const Site<D>& site = ground_.filling.sites[at(dashpots[i].particle)];
      const auto side = std::ranges::find_if(sides_, [&](const LevelSide<D>& one) { return one.depth(site) == 0; });
      parts_.dashpots.push_back({i, static_cast<std::size_t>(side - sides_.begin()), row_of(*side, site[up])});
    }
  }

  const cases::CaseFile& file_;
  const cases::MpsCase& mps_;
  const MpsParts<D>& ground_;
  Members members_;
  std::vector<std::set<std::size_t>> boundaries_;  ///< by particle
  int reach_ = 0;                                  ///< of a particle's links, in particles
  std::vector<LevelSide<D>> sides_;
  SideParts<D> parts_;
};

}  // namespace

template <int D>
methods::mps::StableStep SideParts<D>::predict(methods::mps::StableStep ground) const {
  for (const MpsParts<D>& column : columns) {
    const methods::mps::StableStep own = column.predict();
    ground = {.verlet = std::min(ground.verlet, own.verlet),
              .euler = std::min(ground.euler, own.euler),
              .euler_lagged = std::min(ground.euler_lagged, own.euler_lagged),
              .frequency = std::max(ground.frequency, own.frequency)};
  }
  return ground;
}

template <int D>
methods::mps::SideGround<D> SideParts<D>::stand(const cases::MpsCase& mps, Real step) const {
  methods::mps::SideGround<D> beside;
  for (const MpsParts<D>& column : columns) beside.columns.push_back(column.stepper(mps, step, column.forces(mps, step)));
  for (const Copy& copy : copies)
    beside.copies.push_back({copy.column, copy.parts.particles, copy.parts.forces(mps, step), copy.follows, copy.pairs});
  beside.dashpots = dashpots;
  return beside;
}

template <int D>
SideParts<D> make_side_parts(const cases::CaseFile& file, const MpsParts<D>& ground) {
  return SideMaker<D>(file, ground).make();
}

template struct SideParts<2>;
template struct SideParts<3>;
template SideParts<2> make_side_parts<2>(const cases::CaseFile&, const MpsParts<2>&);
template SideParts<3> make_side_parts<3>(const cases::CaseFile&, const MpsParts<3>&);

}  // namespace sazare::runs
