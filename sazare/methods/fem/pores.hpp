#pragma once

/// Water in the pores of saturated ground that moves with it or flows through it: Biot's equations for the displacement u and the
/// excess pore pressure p, without the inertia of the flow relative to the ground,
///
///     M u'' + f(u) - Q p = f_ext                  Q  integral of m N_p over the strains: p carries what the effective stress does not
///     Q^T u' + S p' + H p = 0                     S  storage n / K_w      H  flow k / (rho_w g)
///
/// Zienkiewicz, Chang and Bettess, Geotechnique 30 (1980) 385-395. Where a pressure is wanted the body has one more node, whose first
/// component is the pressure's time integral; its velocity is the pressure. Then the equations are those of a body, with S as mass,
/// H as damping and Q as a damping without dissipation. Pressures are divided by an impedance, so that all rows are forces.
///
/// Quadratic elements have pressures at their corners (Taylor and Hood); linear ones at all nodes, with the projection of White and
/// Borja, Comput. Methods Appl. Mech. Eng. 197 (2008) 4353-4366, which keeps the pressure of ground without drainage from
/// oscillating from node to node.

#include "sazare/methods/fem/solids.hpp"

namespace sazare::methods::fem {

/// p = impedance x velocity of a pressure node [Pa s/m]: about that of water, which gives numbers of the size of the ground's.
inline constexpr Real pore_impedance = 1.5e6;

/// The linear element with the same corners, whose shape functions are those of the pressure.
geometry::ElementShape corner_shape(geometry::ElementShape shape);

/// The excess pressure of a pressure node [Pa].
template <int D>
Real pore_pressure(Index node, const NodalColumn& velocity) {
  return pore_impedance * velocity[at(node) * D];
}

template <int D>
class Pores {
public:
  Pores(const geometry::ElementMesh& mesh, const std::vector<SolidMaterial>& materials, const std::vector<Index>& material);

  /// Elements in which the excess pressure is an unknown.
  std::size_t size() const { return element_.size(); }
  Index element(std::size_t number) const { return element_[number]; }
  /// Nodes of an element, then its pressure nodes.
  std::span<const Index> nodes(std::size_t number) const { return groups_.nodes(number); }

  /// Pressure nodes are numbered on from the nodes of the mesh.
  std::size_t pressure_nodes() const { return node_.size(); }
  Index pressure_node(std::size_t pressure) const { return static_cast<Index>(mesh_->nodes.size() + pressure); }
  /// The node of the mesh at a pressure node.
  Index node_of(std::size_t pressure) const { return node_[pressure]; }
  /// Pressure of the water at rest at a pressure node [Pa].
  Real pressure_at_rest(std::size_t pressure) const { return at_rest_[pressure]; }
  /// Whether the excess pressure is 0 there: at or above the water table, or beside saturated ground that is drained.
  bool is_drained(std::size_t pressure) const { return drained_[pressure] != 0; }

  /// S, of each element with its projection [kg].
  void add_storage(BlockMatrix<D>& matrix) const;
  /// H [N s/m].
  void add_seepage(BlockMatrix<D>& matrix) const;
  /// -Q and its transpose [N s/m].
  void add_coupling(BlockMatrix<D>& matrix) const;

  /// Mean excess pressure at the corners of an element, from the velocities of the nodes [Pa].
  Real mean(std::size_t number, const NodalColumn& velocity) const;

  /// Excess pressures at points of an element [Pa].
  std::vector<Real> at_points(std::size_t number, std::span<const QuadraturePoint> points, const NodalColumn& velocity) const;
  /// Pressure nodes whose shares give the pressure at a node of the mesh; none where it is no unknown.
  std::vector<std::pair<Index, Real>> shares_at(Index node) const;

private:
  const SolidMaterial& material_of(std::size_t number) const { return (*materials_)[at((*material_)[at(element_[number])])]; }
  std::span<const Index> pressures_of(std::size_t number) const;
  /// Pressure shape functions at the nodes of an element: (corners, nodes).
  static Eigen::MatrixXd corner_values(geometry::ElementShape shape);
  void find_drained();
  template <class Visit>
  void visit_points(std::size_t number, std::span<const QuadraturePoint> points, Visit visit) const;
  void add(std::size_t number, const Eigen::MatrixXd& by_pressure, BlockMatrix<D>& matrix) const;

  const geometry::ElementMesh* mesh_;
  const std::vector<SolidMaterial>* materials_;
  const std::vector<Index>* material_;
  std::vector<Index> element_;
  std::vector<Index> node_;     ///< by pressure
  std::vector<Real> at_rest_;   ///< by pressure [Pa]
  std::vector<char> drained_;   ///< by pressure
  NodeGroups groups_;
};

extern template class Pores<2>;
extern template class Pores<3>;

}  // namespace sazare::methods::fem
