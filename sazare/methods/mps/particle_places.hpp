#pragma once

/// Places and velocities of particles as vectors, across periodic sides as well, and who is near whom since the last search.

#include <algorithm>
#include <array>
#include <cmath>

#include "sazare/neighbors/sphere_grid.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::methods::mps {

/// Length of the body along periodic axes [m]; 0 along the others.
using Periods = std::array<Real, 3>;

template <int D>
using PlaceColumns = std::array<state::Column, D>;

template <int D, class Columns>
Vector<D> vector_of(const Columns& columns, Index particle) {
  Vector<D> vector;
  for (std::size_t axis = 0; axis < D; ++axis) vector[static_cast<int>(axis)] = columns[axis][at(particle)];
  return vector;
}

template <int D>
Vector<D> velocity_of(const state::Particles<D>& particles, Index particle) {
  return vector_of<D>(particles.velocity, particle);
}

template <int D>
Vector3 in_space(const Vector<D>& vector) {
  Vector3 result = Vector3::Zero();
  result.head<D>() = vector;
  return result;
}

/// From the first particle to the nearest image of the second [m], displaced as `displacement` says.
template <int D>
Vector<D> apart(const Periods& period, const PlaceColumns<D>& start, const PlaceColumns<D>& displacement, Index first, Index second) {
  Vector<D> way = vector_of<D>(start, second) + vector_of<D>(displacement, second) -
                  (vector_of<D>(start, first) + vector_of<D>(displacement, first));
  for (int axis = 0; axis < D; ++axis)
    if (const Real length = period[static_cast<std::size_t>(axis)]; length > 0) way[axis] -= length * std::round(way[axis] / length);
  return way;
}

/// Whether a particle has moved farther than `most` [m] since the last search. What all have in common, as the first one tells it,
/// brings nobody nearer.
template <int D>
bool some_moved(const state::Particles<D>& particles, const PlaceColumns<D>& searched_at, Real most) {
  std::array<Real, D> common;
  for (std::size_t axis = 0; axis < D; ++axis) common[axis] = particles.displacement[axis][0] - searched_at[axis][0];
  Real farthest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Real square = 0;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const Real way = particles.displacement[axis][i] - searched_at[axis][i] - common[axis];
      square += way * way;
    }
    farthest = std::max(farthest, square);
  }
  return farthest > most * most;
}

/// Particles, and their images beyond periodic sides, by place.
template <int D>
class ParticleGrid {
public:
  ParticleGrid(const Periods& period, Real spacing) : period_(period), spacing_(spacing) {}

  /// Puts all particles where these displacements have them.
  void place(const PlaceColumns<D>& start, const PlaceColumns<D>& displacement, Index count) {
    for (Index i = 0; i < count; ++i)
      grid_.place(i, in_space<D>(vector_of<D>(start, i) + vector_of<D>(displacement, i)), 0.5 * spacing_);
  }

  /// Calls visit(particle) for all whose centre or the centre of whose image may lie within `reach` of a place, in no order to rely on,
  /// and for a particle with several images more than once.
  template <class Visit>
  void visit_near(const Vector<D>& place, Real reach, Visit&& visit) const {
    const auto look_at = [&](const Vector<D>& from) { grid_.visit_near(in_space<D>(from), reach - 0.5 * spacing_, visit); };
    look_at(place);
    for (int axis = 0; axis < D; ++axis)
      if (const Real length = period_[static_cast<std::size_t>(axis)]; length > 0)
        for (const int side : {-1, 1}) look_at(place + side * length * Vector<D>::Unit(axis));
  }

private:
  Periods period_;
  Real spacing_;
  neighbors::SphereGrid grid_;
};

}  // namespace sazare::methods::mps
