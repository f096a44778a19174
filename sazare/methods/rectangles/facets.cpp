/// The facets of irregular packings among the links: their columns, and where elements find them.

#include <algorithm>
#include <cmath>
#include <map>

#include "sazare/methods/rectangles/face_links.hpp"

namespace sazare::methods::rectangles {

void FaceLinks::add_facets(const std::vector<FacetLink>& facets) {
  std::map<Index, std::vector<FacetLink>> sorted;
  for (const FacetLink& facet : facets) sorted[facet.kind].push_back(facet);
  for (auto& [kind, list] : sorted) {
    const std::size_t begin = links_.size();
    for (const FacetLink& facet : list) links_.push_back({facet.first, facet.second, FaceLink::own_direction, kind, 0});
    pad(kind, FaceLink::own_direction, begin);
    list.resize(links_.size() - begin, {.direction = Vector<2>(1, 0), .distance = 1});
    for (const FacetLink& facet : list) {
      const Real stiffness = facet.half_face / facet.distance;
      for (std::size_t axis = 0; axis < 2; ++axis) facets_.direction[axis].push_back(facet.direction[static_cast<int>(axis)]);
      facets_.first_reach.push_back(facet.first_reach);
      facets_.second_reach.push_back(facet.second_reach);
      facets_.first_shift.push_back(facet.first_shift);
      facets_.second_shift.push_back(facet.second_shift);
      facets_.half_face.push_back(facet.half_face);
      facets_.stiffness.push_back(stiffness);
      facets_.damping.push_back(std::sqrt(stiffness * facet.reduced_mass));
      facets_.faces.push_back({facet.first_face, facet.second_face});
    }
  }
}

int FaceLinks::first_face(Index number) const {
  return is_facet(at(number)) ? facets_.faces[at(number) - lattice_end_][0] : link(number).axis;
}

int FaceLinks::second_face(Index number) const {
  return is_facet(at(number)) ? facets_.faces[at(number) - lattice_end_][1] : link(number).axis + 2;
}

Vector<2> FaceLinks::direction_of(Index number) const {
  if (!is_facet(at(number))) return {link(number).axis == 0 ? 1.0 : 0.0, link(number).axis == 0 ? 0.0 : 1.0};
  return {facets_.direction[0][at(number) - lattice_end_], facets_.direction[1][at(number) - lattice_end_]};
}

/// Elements take up the forces of their facets in rows of lanes: first those in which they come first, then the others.
void FaceLinks::make_facet_table(std::size_t elements) {
  std::vector<std::array<std::vector<Index>, 2>> own(elements);
  for (std::size_t i = lattice_end_; i < links_.size(); ++i) {
    if (is_padding(static_cast<Index>(i))) continue;
    own[at(links_[i].first)][0].push_back(static_cast<Index>(i));
    own[at(links_[i].second)][1].push_back(static_cast<Index>(i));
  }
  for (std::size_t begin = 0; begin < elements; begin += lane_count) {
    FacetRows& rows = facet_rows_.emplace_back();
    rows.begin = facet_table_.size();
    for (const std::size_t side : {0, 1}) {
      std::size_t& count = side == 0 ? rows.first : rows.second;
      for (std::size_t lane = 0; lane < lane_count; ++lane) count = std::max(count, own[begin + lane][side].size());
      for (std::size_t row = 0; row < count; ++row)
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
          const std::vector<Index>& list = own[begin + lane][side];
          facet_table_.push_back(row < list.size() ? list[row] : this->count());
        }
    }
  }
}

}  // namespace sazare::methods::rectangles
