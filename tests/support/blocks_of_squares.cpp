#include "tests/support/blocks_of_squares.hpp"

#include <cmath>

namespace sazare::test {

Index Scene::add(OutlineKind kind, const Vector2& centre, Real half_width, Real half_height, Real angle, Index block) {
  parts_.outlines.add(kind, half_width, half_height, block);
  elements_.push_back({centre, angle, block < 0});
  if (block < 0) ++parts_.supports;
  return static_cast<Index>(elements_.size()) - 1;
}

Index Scene::add_lattice(int columns, int rows, Real radius, const Vector2& corner, Index kind, Index block) {
  const auto begin = static_cast<Index>(elements_.size());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const Index own =
          add(OutlineKind::rectangle, corner + radius * Vector2(2 * column + 1, 2 * row + 1), radius, radius, 0, block);
      if (column > 0) link(own - 1, own, 0, kind);
      if (row > 0) link(own - columns, own, 1, kind);
    }
  return begin;
}

Index Scene::add_packing(const methods::rectangles::Packing& packing, Index kind, Index block) {
  const auto begin = static_cast<Index>(elements_.size());
  for (std::size_t i = 0; i < packing.centres.size(); ++i) {
    parts_.outlines.add_polygon(packing.corners[i], packing.outside[i], block);
    elements_.push_back({packing.centres[i], 0, false});
  }
  for (methods::rectangles::FacetLink facet : packing.facets) {
    facet.first += begin;
    facet.second += begin;
    facet.kind = kind;
    parts_.facets.push_back(facet);
  }
  return begin;
}

Index Scene::add_wall(const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  const Index own = add(OutlineKind::wall, 0.5 * (from + to), 0.5 * way.norm(), 0, std::atan2(way.y(), way.x()), -1);
  return own;
}

Index Scene::add_support(OutlineKind kind, const Vector2& centre, Real half_width, Real half_height) {
  return add(kind, centre, half_width, half_height, 0, -1);
}

void Scene::complete() {
  if (complete_) return;
  complete_ = true;
  particles_.resize(static_cast<Index>(elements_.size()));
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    particles_.start[0][i] = elements_[i].centre.x();
    particles_.start[1][i] = elements_[i].centre.y();
    particles_.angle[i] = elements_[i].angle;
    particles_.rotation[0][i] = std::cos(elements_[i].angle);
    particles_.rotation[1][i] = std::sin(elements_[i].angle);
    const Real mass = parts_.outlines.mass(i, density, thickness);
    particles_.inverse_mass[i] = elements_[i].is_support ? 0 : 1 / mass;
    particles_.inverse_inertia[i] = elements_[i].is_support ? 0 : 1 / (mass * parts_.outlines.gyration_square(i));
  }
}

std::unique_ptr<particles::UniformStepper<2>> Scene::make(Real step) {
  complete();
  contact.thickness = thickness;
  parts_.contact = contact;
  parts_.base_friction = base_friction;
  parts_.kinds = kinds;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (int freedom = 0; elements_[i].is_support && freedom < 3; ++freedom)
      supports.held.push_back({static_cast<Index>(i), freedom});
  auto made = std::make_unique<methods::rectangles::RectangleForces>(particles_, parts_, step);
  forces = made.get();
  return std::make_unique<particles::UniformStepper<2>>(particles_, std::move(made), supports,
                                                     particles::UniformRules{step, particles::Integrator::leapfrog, {}});
}

methods::rectangles::FaceKind square_faces(Real radius, Real normal, Real shear, int count, laws::FaceFormula formula,
                                           Real damping_ratio, Real mass) {
  laws::FaceSprings springs;
  springs.first_reach = springs.second_reach = springs.half_face = radius;
  springs.normal = normal / count;
  springs.shear = shear / count;
  springs.normal_damping = 2 * damping_ratio * std::sqrt(normal * mass / 2) / count;
  springs.shear_damping = springs.normal_damping * std::sqrt(shear / normal);
  springs.tension_limit = springs.cohesion_limit = 1e300;
  springs.places = laws::spring_places(laws::SpringPlaces::centres, count);
  return {springs, formula};
}

methods::rectangles::FaceKind facets_of(Real normal, Real shear, int count, Real strength, Real damping_ratio, Real thickness) {
  laws::FaceSprings springs;
  springs.normal = 2 * thickness * normal / count;
  springs.shear = 2 * thickness * shear / count;
  springs.normal_damping = 2 * damping_ratio * std::sqrt(2 * thickness * normal) / count;
  springs.shear_damping = springs.normal_damping * std::sqrt(shear / normal);
  springs.tension_limit = springs.cohesion_limit = 2 * thickness * strength / count;
  springs.places = laws::spring_places(laws::SpringPlaces::centres, count);
  return {springs, laws::FaceFormula::exact};
}

}  // namespace sazare::test
