#include "sazare/geometry/facets/points.hpp"

#include <algorithm>
#include <limits>

namespace sazare::geometry {

namespace {

constexpr Real nothing = 1e-12;  // a count that is left by rounding

}  // namespace

/// The spot of the part on which a nearest point lies; -1 beyond reach.
int FacetPoints::spot(const View& view, Part part, Index number, Index facet, const Vector3& place) {
  for (std::size_t n = 0; n < spots_.size(); ++n)
    if (spots_[n].part == part && spots_[n].number == number) return static_cast<int>(n);
  const Real distance = (view.centre - place).norm();
  if (!(distance < view.reach) || !(distance > 0)) return -1;
  spots_.push_back({part, number, {facet, place, (view.centre - place) / distance, distance, 0, 0, Vector3::Zero()}});
  return static_cast<int>(spots_.size()) - 1;
}

/// What counts on one side alone, from a height above a place on as a whole: 3 u^2 - 2 u^3 of it at the part u of that height.
void FacetPoints::add_apart(const View& view, Real apart, const Vector3& from, const Vector3& inward, Real ramp, int spot,
                            Real times) {
  if (spot < 0) return;
  FacetPoint& at = spots_[static_cast<std::size_t>(spot)].at;
  const Real part = (view.centre - from).dot(inward) / ramp;
  if (part >= 1) at.count += times * apart;
  if (part <= 0 || part >= 1) return;
  at.count += times * apart * part * part * (3 - 2 * part);
  at.slope += (times * apart * 6 * part * (1 - part) / ramp) * inward;
}

bool FacetPoints::has(std::span<const Seen> seen, Index number) {
  return std::ranges::any_of(seen, [&](const Seen& one) { return one.number == number; });
}

int FacetPoints::spot_of_facet(Index facet) const {
  const auto found = std::ranges::find(facets_, facet, &Seen::number);
  return found == facets_.end() ? -1 : found->spot;
}

/// A point that counts more than nothing has all of it as its share, but for what edges beside it that count less take off.
void FacetPoints::share_out(const View& view) {
  for (Spot& spot : spots_) spot.at.share = std::max(spot.at.count, Real{0});
  for (std::size_t n = 0; n < spots_.size(); ++n) {
    const Spot& from = spots_[n];
    if (!(from.at.count < -nothing)) continue;
    const auto is_here = [&](const Seen& edge) { return edge.spot == static_cast<int>(n); };
    const auto edges = static_cast<Real>(std::ranges::count_if(edges_, is_here));
    // What counts beside an edge may belong to a facet further away, where the one at the edge ends before it.
    const auto beside = [&](Index facet) {
      const int own = spot_of_facet(facet);
      if (own < 0 || spots_[static_cast<std::size_t>(own)].at.count > nothing) return own;
      const Vector3& there = spots_[static_cast<std::size_t>(own)].at.place;
      int found = own;
      Real least = std::numeric_limits<Real>::infinity();
      for (std::size_t m = 0; m < spots_.size(); ++m) {
        const FacetPoint& at = spots_[m].at;
        const Real away = (at.place - there).squaredNorm();
        if (!(at.count > nothing) || !((at.place - from.at.place).dot(there - from.at.place) > 0) || away >= least) continue;
        least = away;
        found = static_cast<int>(m);
      }
      return found;
    };
    for (const Seen& edge : edges_) {
      if (!is_here(edge)) continue;
      const auto& facets = view.complex->edges()[static_cast<std::size_t>(edge.number)].facets;
      take_off(view, from, -from.at.count / edges, beside(facets[0]), beside(facets[1]));
    }
  }
}

/// n = a n_1 + b n_2 in the plane of the three normals, a and b being how much of the force at `from` each takes over.
void FacetPoints::take_off(const View& view, const Spot& from, Real count, int one, int other) {
  const auto counts = [&](int spot) { return spot >= 0 && spots_[static_cast<std::size_t>(spot)].at.count > nothing; };
  const auto take = [&](int spot, Real part) {
    FacetPoint& at = spots_[static_cast<std::size_t>(spot)].at;
    const Real depth = view.radius - at.distance, ratio = depth > 0 ? (view.radius - from.at.distance) / depth : Real{1};
    at.share = std::max(at.share - count * std::clamp(part, Real{0}, Real{1}) * std::clamp(ratio, Real{0}, Real{1}), Real{0});
  };
  if (!counts(one)) std::swap(one, other);
  if (!counts(one)) return;
  const Vector3 &normal = from.at.normal, &first = spots_[static_cast<std::size_t>(one)].at.normal;
  if (!counts(other) || one == other) {
    take(one, normal.dot(first));
    return;
  }
  const Vector3& second = spots_[static_cast<std::size_t>(other)].at.normal;
  const Vector3 across = first.cross(second);
  const Real square = across.squaredNorm();
  if (!(square > nothing * nothing)) {
    take(one, 0.5);
    take(other, 0.5);
    return;
  }
  take(one, normal.cross(second).dot(across) / square);
  take(other, first.cross(normal).dot(across) / square);
}

void FacetPoints::conclude(const View& view) {
  for (const Spot& spot : spots_) {
    const bool pulls = spot.at.count < -nothing || !spot.at.slope.isZero(0);  // not across a gap
    if ((spot.at.count > nothing || pulls) && (!pulls || spot.at.distance < view.radius)) points_.push_back(spot.at);
  }
  std::ranges::stable_sort(points_, {}, &FacetPoint::distance);
}

}  // namespace sazare::geometry
