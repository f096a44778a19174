#pragma once

/// Small assemblies of elements for tests and measurements.

#include <memory>

#include "sazare/methods/rectangles/packing.hpp"
#include "sazare/methods/rectangles/rectangle_forces.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::test {

using geometry::OutlineKind;
using geometry::Vector2;

/// What is put together, element by element and then support by support.
class Scene {
public:
  Real density = 2000, thickness = 1;
  methods::rectangles::ContactRules contact;
  methods::rectangles::BaseFriction base_friction;
  particles::ParticleSupports<2> supports;
  std::vector<methods::rectangles::FaceKind> kinds;

  /// An element; the number is its place among all.
  Index add(OutlineKind kind, const Vector2& centre, Real half_width, Real half_height, Real angle = 0, Index block = 0);

  /// Squares of one kind of link, columns x rows, from a lower corner; the first is at that corner, rows follow.
  Index add_lattice(int columns, int rows, Real radius, const Vector2& corner, Index kind, Index block = 0);

  /// Elements and facets of an irregular packing; the first element is the nucleus that came first.
  Index add_packing(const methods::rectangles::Packing& packing, Index kind, Index block = 0);

  void link(Index first, Index second, int axis, Index kind, Real slip = 0) {
    parts_.links.push_back({first, second, axis, kind, slip});
  }

  /// Supports stand still; add them last.
  Index add_wall(const Vector2& from, const Vector2& to);
  Index add_support(OutlineKind kind, const Vector2& centre, Real half_width, Real half_height);

  state::Particles<2>& particles() { return particles_; }

  /// Not started. `forces` is where its forces are to be found, as long as it lives.
  std::unique_ptr<particles::UniformStepper<2>> make(Real step);
  methods::rectangles::RectangleForces* forces = nullptr;

private:
  struct Element {
    Vector2 centre;
    Real angle;
    bool is_support;
  };
  void complete();

  std::vector<Element> elements_;
  methods::rectangles::RectangleForces::Parts parts_;
  state::Particles<2> particles_;
  bool complete_ = false;
};

/// Springs of squares: K_n and K_s of a face in all, damping ratio, layout and number.
methods::rectangles::FaceKind square_faces(Real radius, Real normal, Real shear, int count = 3,
                                           laws::FaceFormula formula = laws::FaceFormula::small, Real damping_ratio = 0,
                                           Real mass = 1);

/// Springs of facets: stiffnesses [Pa], number, strengths over area [Pa].
methods::rectangles::FaceKind facets_of(Real normal, Real shear, int count = 3, Real strength = 1e300, Real damping_ratio = 0,
                                        Real thickness = 1);

}  // namespace sazare::test
