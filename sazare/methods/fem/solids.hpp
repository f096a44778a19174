#pragma once

/// Elements of the body: what is integrated over them.

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/methods/fem/node_pattern.hpp"
#include "sazare/methods/fem/shape_functions.hpp"
#include "sazare/methods/fem/solid_law.hpp"

namespace sazare::methods::fem {

template <int D>
using Gradients = Eigen::Matrix<Real, Eigen::Dynamic, D, 0, most_nodes, D>;

/// A point of integration: its volume (in 2-D area) and the derivatives of the shape functions by the coordinates.
template <int D>
struct SolidPoint {
  Real weight = 0;  ///< [m3; m2 in 2-D]
  Gradients<D> gradients;
};

/// Throws UserError, naming the element, where it has no volume there or is turned inside out. A line is a piece of a column of
/// level layers, from below upwards, of 1 m2 (in 2-D 1 m).
template <int D>
SolidPoint<D> solid_point(const geometry::ElementMesh& mesh, const geometry::MeshElement& element, const QuadraturePoint& point);

/// Mean place of the nodes of an element or face [m].
Vector3 centre(const geometry::ElementMesh& mesh, const geometry::MeshElement& element);

/// Whole matrix of strains by displacements of an element's nodes: (stress_size, nodes x D).
template <int D>
using StrainMatrix = Eigen::Matrix<Real, stress_size<D>, Eigen::Dynamic, 0, stress_size<D>, most_nodes * D>;

template <int D>
StrainMatrix<D> strain_matrix(const Gradients<D>& gradients);

/// Displacements of an element's nodes, in its order.
template <int D>
using ElementColumn = Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, most_nodes * D, 1>;

template <int D>
ElementColumn<D> displacements_of(const geometry::MeshElement& element, const NodalColumn& displacement);

/// Elastic stiffness [N/m].
template <int D>
Eigen::MatrixXd element_stiffness(const geometry::ElementMesh& mesh, const geometry::MeshElement& element,
                                  const SolidMaterial& material, Integration integration);

enum class MassMatrix { consistent, lumped };

/// Mass [kg]. The lumped one is diagonal, in proportion to the consistent one's diagonal: all parts are positive. Hinton, Rock
/// and Zienkiewicz, Earthquake Eng. Struct. Dyn. 4 (1976) 245-249.
template <int D>
Eigen::MatrixXd element_mass(const geometry::ElementMesh& mesh, const geometry::MeshElement& element,
                             const SolidMaterial& material, MassMatrix kind);

/// Means over an element.
template <int D>
struct SolidMean {
  Voigt<D> stress = Voigt<D>::Zero();  ///< [Pa]
  Real slip = 0;                       ///< plastic shear strain [-]
  Real peak = 0;                       ///< largest shear strain so far, of soil that degrades with strain [-]
};

/// Elements whose stress must be found point by point, with their memory.
template <int D>
class YieldingSolids {
public:
  YieldingSolids(const geometry::ElementMesh& mesh, const std::vector<SolidMaterial>& materials,
                 const std::vector<Index>& material, Integration integration);

  std::size_t size() const { return element_.size(); }
  Index element(std::size_t number) const { return element_[number]; }

  /// Numbers of memory of all points, as their laws have them.
  std::size_t memory_size() const { return memory_size_; }

  /// Stress and memory of an element from the displacements and the memory before; its force and, where asked for, its tangent by
  /// rows.
  void evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before, std::span<Real> after,
                std::span<Real> force, std::span<Real> tangent) const;

  struct Energies {
    Real elastic = 0;  ///< stored [J]
    Real plastic = 0;  ///< dissipated by plastic flow since the memory before [J]
  };

  /// Energies of an element, between two states: the work of plastic flow is that of the mean stress.
  Energies energies(std::size_t number, const NodalColumn& displacement_before, const NodalColumn& displacement,
                    std::span<const Real> before, std::span<const Real> after) const;

  /// Cycles of shear begin at these displacements, where a law counts them.
  void begin_cycles(std::size_t number, const NodalColumn& displacement, std::span<Real> memory) const;

  SolidMean<D> mean(std::size_t number, const NodalColumn& displacement, std::span<const Real> memory) const;

  /// Stress at every point of integration [Pa].
  std::vector<Voigt<D>> stresses(std::size_t number, const NodalColumn& displacement, std::span<const Real> memory) const;

private:
  /// A point of integration, and where its memory stands.
  struct Point : SolidPoint<D> {
    std::size_t memory = 0;
  };

  const PointLaw<D>& law(std::size_t number) const { return law_[at(material_[number])]; }
  std::span<const Point> points(std::size_t number) const {
    return std::span(point_).subspan(first_point_[number], first_point_[number + 1] - first_point_[number]);
  }

  const geometry::ElementMesh* mesh_;
  std::vector<Index> element_;
  std::vector<std::size_t> first_point_;  ///< by element, and one beyond
  std::vector<Point> point_;
  std::vector<PointLaw<D>> law_;  ///< by material
  std::vector<Index> material_;   ///< by number
  std::size_t memory_size_ = 0;
};

extern template class YieldingSolids<2>;
extern template class YieldingSolids<3>;

}  // namespace sazare::methods::fem
