#include "sazare/methods/rectangles/packing.hpp"

#include <algorithm>

#include "sazare/geometry/plane/voronoi.hpp"

namespace sazare::methods::rectangles {

namespace {

using geometry::Vector2;
using geometry::VoronoiCell;

struct Side {
  Vector2 begin, end;
};

Side side_of(const VoronoiCell& cell, std::size_t number) {
  return {cell.corners[number], cell.corners[(number + 1) % cell.corners.size()]};
}

/// The facet on a side of the first cell; `second_face` is the other cell's side.
FacetLink facet_on(const Side& side, const Vector2& apart, const std::array<Vector2, 2>& centres) {
  FacetLink facet;
  facet.distance = apart.norm();
  const Vector2 n = apart / facet.distance, s(n.y(), -n.x()), middle = 0.5 * (side.begin + side.end);
  facet.direction = n;
  facet.first_reach = n.dot(middle - centres[0]);
  facet.second_reach = n.dot(centres[1] - middle);
  facet.first_shift = s.dot(middle - centres[0]);
  facet.second_shift = s.dot(middle - centres[1]);
  facet.half_face = 0.5 * (side.end - side.begin).norm();
  return facet;
}

}  // namespace

Packing pack(std::span<const Vector2> nuclei, std::span<const Vector2> outline, Real area_density) {
  const std::vector<VoronoiCell> cells = geometry::voronoi_cells(nuclei, outline);
  Packing packing;
  std::vector<Real> mass;
  for (const VoronoiCell& cell : cells) {
    const geometry::PolygonMeasures measures = geometry::measure(cell.corners);
    packing.centres.push_back(measures.centroid);
    mass.push_back(area_density * measures.area);
    geometry::Faces outside = 0;
    for (std::size_t side = 0; side < cell.beyond.size(); ++side)
      if (cell.beyond[side] == VoronoiCell::outside) outside |= geometry::Faces{1} << side;
    packing.outside.push_back(outside);
    auto& corners = packing.corners.emplace_back(cell.corners);
    for (Vector2& corner : corners) corner -= measures.centroid;
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t side = 0; side < cells[i].beyond.size(); ++side) {
      const Index beyond = cells[i].beyond[side];
      if (beyond == VoronoiCell::outside) continue;
      const auto j = static_cast<std::size_t>(beyond);
      const Vector2 apart = nuclei[j] - nuclei[i];
      if (apart.x() < 0 || (apart.x() == 0 && apart.y() < 0)) continue;  // half of an element's facets have it first
      const auto own = static_cast<Index>(i);
      const auto back = std::ranges::find(cells[j].beyond, own);
      if (back == cells[j].beyond.end()) continue;  // too short a side for one of the two
      FacetLink facet = facet_on(side_of(cells[i], side), apart, {packing.centres[i], packing.centres[j]});
      facet.first = own;
      facet.second = beyond;
      facet.first_face = static_cast<int>(side);
      facet.second_face = static_cast<int>(back - cells[j].beyond.begin());
      facet.reduced_mass = mass[i] * mass[j] / (mass[i] + mass[j]);
      packing.facets.push_back(facet);
    }
  return packing;
}

FacetStiffness facet_stiffness(Real youngs_modulus, Real poisson_ratio) {
  const Real mu = youngs_modulus / (2 * (1 + poisson_ratio)), lambda = 2 * mu * poisson_ratio / (1 - 2 * poisson_ratio);
  return {2 * (lambda + mu), 2 * (mu - lambda)};
}

}  // namespace sazare::methods::rectangles
