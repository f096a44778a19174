#pragma once

/// Joint elements without thickness between two faces of the mesh.

#include "sazare/geometry/interface_split.hpp"
#include "sazare/laws/coulomb_interface.hpp"
#include "sazare/methods/fem/node_pattern.hpp"
#include "sazare/methods/fem/shape_functions.hpp"

namespace sazare::methods::fem {

/// Faces with the same law.
struct JointSet {
  std::string name;
  laws::CoulombInterface law;
  std::vector<geometry::InterfaceFace> faces;
};

template <int D>
class Joints {
public:
  Joints(const geometry::ElementMesh& mesh, std::vector<JointSet> sets);

  std::size_t size() const { return joint_.size(); }
  const std::vector<JointSet>& sets() const { return sets_; }

  /// Nodes of the first face, then of the second one.
  std::vector<Index> nodes(std::size_t number) const;

  /// Numbers of memory: the slip of every point.
  std::size_t memory_size() const { return point_.size() * D; }

  /// Force and tangent of a joint, as `YieldingSolids` gives them for an element. Returns whether a point is open or slips.
  bool evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before, std::span<Real> after,
                std::span<Real> force, std::span<Real> tangent) const;

  struct Energies {
    Real elastic = 0;   ///< stored [J]
    Real friction = 0;  ///< dissipated by slip since the memory before [J]
  };
  Energies energies(std::size_t number, const NodalColumn& displacement_before, const NodalColumn& displacement,
                    std::span<const Real> before, std::span<const Real> after) const;

  /// What the joints of a set do, over their area.
  struct Summary {
    Real open_fraction = 0;                  ///< [-]
    Real sliding_fraction = 0;                  ///< [-]
    Real largest_slip = 0;                ///< [m]
    Vector<D> force = Vector<D>::Zero();  ///< of the first faces on the second ones [N]
  };
  Summary summary(std::size_t set, const NodalColumn& displacement, std::span<const Real> memory) const;

private:
  struct Joint {
    std::size_t set = 0, face = 0, first_point = 0, points = 0;
  };
  struct Point {
    NodeValues values;
    Vector<D> normal = Vector<D>::Zero();
    Real weight = 0;  ///< [m2; m in 2-D]
  };

  Vector<D> opening(const Joint& joint, const Point& point, const NodalColumn& displacement) const;
  laws::InterfaceResponse<D> response(const Joint& joint, std::size_t point, const NodalColumn& displacement,
                                      std::span<const Real> memory) const;

  std::vector<JointSet> sets_;
  std::vector<Joint> joint_;
  std::vector<Point> point_;
};

extern template class Joints<2>;
extern template class Joints<3>;

}  // namespace sazare::methods::fem
