#pragma once

/// Partial slip of a Hertz contact: its friction as that of bands of springs, each with a slider of its own.
///
///     T = sum over the bands of slider(G w, c w/a, mu N p)        p = P(y_o/a) - P(y_i/a)     P(s) = s (3 - s^2)/2
///
/// G a  stiffness of the whole contact [N/m]               a    radius of the contact [m]
/// w    width of a band, y_o - y_i [m]                     y    distance from the middle of the contact [m]
/// c    dashpot of the whole contact [N s/m]               P    share of the normal force within y
///
/// A contact of elastic spheres acts as a row of springs that do not know each other: one at y has the stiffness G dy, bears
/// 3/2 (1 - (y/a)^2) N dy/a of the normal force, and slips at mu times that ([PopovHess2014]; a sum of flat punches of all radii,
/// [Jaeger2005]). For a constant N this is Mindlin's curve T/(mu N) = 1 - (1 - 2/3 G a x/(mu N))^(3/2) with the loops of Mindlin
/// and Deresiewicz, and for an N that changes it is what their theory leads to, since springs are where they are: what the
/// contact grows by comes without stretch, what it loses takes its stretch with it.
///
/// The bands lie in space like the springs. From the middle outwards each begins q times as far away as the one before; the
/// outermost ends with the contact. Where that grows beyond q times its beginning, it is cut there and the two innermost become
/// one, with the mean stretch; where the contact shrinks below its beginning, it is gone and the innermost is cut in two. So the
/// bands span the same shares of any contact. What is averaged loses energy, as does what leaves: like single sliders, bands
/// yield no work on any path.
///
/// Each band remembers z = sqrt(G w) x, as a slider does; x is its mean stretch [m].

#include <array>
#include <cmath>

#include "sazare/core/vector_of.hpp"
#include "sazare/laws/slider.hpp"

namespace sazare::laws {

template <class Number>
struct SlipBands {
  static constexpr std::size_t count = 8;
  static constexpr Real growth = 1.2;  ///< q

  std::array<VectorOf<Number>, count> stretch = [] {  ///< z, the outermost band first [sqrt(J)]
    std::array<VectorOf<Number>, count> none;
    none.fill(zero_vector<Number>());
    return none;
  }();
  Number width{};  ///< a when it was last evaluated [m]; 0: begins
  Number inner{};  ///< where the outermost band begins [m]
};

/// Calls `visit` with each number of the bands and the same one of others, which may be of another type.
template <class One, class Other, class Visit>
void visit_numbers(One& one, Other& other, Visit&& visit) {
  for (std::size_t band = 0; band < one.count; ++band)
    for (int axis = 0; axis < 3; ++axis) visit(one.stretch[band][axis], other.stretch[band][axis]);
  visit(one.width, other.width);
  visit(one.inner, other.inner);
}

namespace bands {

inline constexpr std::size_t count = SlipBands<Real>::count, innermost = count - 1;
inline constexpr Real growth = SlipBands<Real>::growth;

inline constexpr Real negligible = 1e-12;  ///< width of a band over that of its contact

/// q to the number of bands: a contact whose width changes more than this in a step begins anew.
inline constexpr Real span = [] {
  Real product = 1;
  for (std::size_t band = 0; band < count; ++band) product *= growth;
  return product;
}();

/// Where a band begins and how wide it is, over where the outermost band begins; for all bands but that one.
struct Extent {
  Real inner = 0, width = 0, root_of_width = 0;
};
inline const std::array<Extent, count> extents = [] {
  std::array<Extent, count> all{};
  Real outer = 1;
  for (std::size_t band = 1; band < count; ++band) {
    const Real inner = band == innermost ? 0 : outer / growth;
    all[band] = {inner, outer - inner, std::sqrt(outer - inner)};
    outer = inner;
  }
  return all;
}();

/// Roots of the shares that two parts of a band have which is cut at 1/q of its end.
inline const Real outer_part = std::sqrt(1 - 1 / growth), inner_part = std::sqrt(1 / growth);

/// The stretch of a band whose width changes from one to another: what comes in has none, what goes takes its own with it.
/// Widths below `least` count as that.
template <class Number>
void set_width(VectorOf<Number>& stretch, const Number& before, const Number& now, const Number& least) {
  const Number small = maximum(minimum(before, now), least), large = maximum(maximum(before, now), least);
  stretch = root_of_quotient(small, large) * stretch;
}

/// Contacts that begin, and those of which nothing is left as it was.
template <class Number>
[[gnu::noinline]] void begin_anew(SlipBands<Number>& all, const Number& width) {
  all.inner = select(width > span * all.inner, Number{}, all.inner);
  all.inner = select(all.inner > span * width, Number{}, all.inner);
  const auto goes_on = all.inner > Number{};
  for (auto& stretch : all.stretch) stretch = select(goes_on, stretch, zero_vector<Number>());
  all.width = select(goes_on, all.width, width);
  all.inner = select(goes_on, all.inner, Number((1 / growth) * width));
}

/// Contacts whose outermost band has become too wide.
template <class Number>
[[gnu::noinline]] void cut_outermost(SlipBands<Number>& all, const Number& width) {
  const Number end = growth * all.inner;
  const auto grows = width > end;
  auto stretch = all.stretch;
  set_width(stretch.front(), Number(all.width - all.inner), Number(end - all.inner), Number(negligible * end));
  stretch[innermost] =
      Number(Number{} + outer_part) * stretch[innermost - 1] + Number(Number{} + inner_part) * stretch[innermost];
  for (std::size_t band = innermost - 1; band > 0; --band) stretch[band] = stretch[band - 1];
  stretch.front() = zero_vector<Number>();
  for (std::size_t band = 0; band < count; ++band) all.stretch[band] = select(grows, stretch[band], all.stretch[band]);
  all.inner = select(grows, end, all.inner);
  all.width = select(grows, end, all.width);
}

/// Contacts that have lost their outermost band.
template <class Number>
[[gnu::noinline]] void drop_outermost(SlipBands<Number>& all, const Number& width) {
  const auto shrinks = all.inner > width;
  auto stretch = all.stretch;
  for (std::size_t band = 0; band < innermost; ++band) stretch[band] = stretch[band + 1];
  stretch[innermost] = Number(Number{} + inner_part) * stretch[innermost];
  stretch[innermost - 1] = Number(Number{} + outer_part) * stretch[innermost - 1];
  for (std::size_t band = 0; band < count; ++band) all.stretch[band] = select(shrinks, stretch[band], all.stretch[band]);
  all.width = select(shrinks, all.inner, all.width);
  all.inner = select(shrinks, Number((1 / growth) * all.inner), all.inner);
}

/// Takes the bands to a contact of another width.
template <class Number>
void fit(SlipBands<Number>& all, const Number& width) {
  if (any_above(width, Number(span * all.inner)) || any_above(all.inner, Number(span * width))) begin_anew(all, width);
  for (std::size_t n = 0; n < count && any_above(width, Number(growth * all.inner)); ++n) cut_outermost(all, width);
  for (std::size_t n = 0; n < count && any_above(all.inner, width); ++n) drop_outermost(all, width);
  set_width(all.stretch.front(), Number(all.width - all.inner), Number(width - all.inner), Number(negligible * width));
  all.width = width;
}

/// P of the share of the radius that is within.
template <class Number>
Number load_within(const Number& share) {
  return share * (1.5 - 0.5 * share * share);
}

}  // namespace bands

template <class Number>
struct BandsForce {
  VectorOf<Number> force = zero_vector<Number>();  ///< T [N]
  Number energy{};                                 ///< of all springs [J]
};

template <class Number>
Number energy_of(const BandsForce<Number>& slid) {
  return slid.energy;
}

/// `stiffness` is G [Pa], `damping` c and `limit` mu N of the whole contact.
template <class Number>
BandsForce<Number> slide(const Number& stiffness, const Number& width, const Number& damping, const Number& limit,
                         const VectorOf<Number>& velocity, const Number& step, SlipBands<Number>& all) {
  bands::fit(all, width);
  const Number per_width = 1.0 / width, share = all.inner * per_width, drag = damping * per_width,
               root = square_root(Number(stiffness * all.inner));
  BandsForce<Number> sum;
  const auto add = [&](std::size_t band, const Number& root_of_stiffness, const Number& band_width, const Number& load) {
    const auto slid =
        slide(root_of_stiffness, Number(drag * band_width), Number(limit * load), velocity, step, all.stretch[band]);
    sum.force = sum.force + slid.force;
    sum.energy = sum.energy + energy_of(slid);
  };
  const Number outermost = maximum(Number(width - all.inner), Number{});
  Number within = bands::load_within(share);
  add(0, square_root(Number(stiffness * outermost)), outermost, Number(1.0 - within));
  for (std::size_t band = 1; band < bands::count; ++band) {
    const bands::Extent& extent = bands::extents[band];
    const Number load = within;
    within = bands::load_within(Number(extent.inner * share));
    add(band, Number(extent.root_of_width * root), Number(extent.width * all.inner), Number(load - within));
  }
  return sum;
}

}  // namespace sazare::laws
