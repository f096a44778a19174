#pragma once

/// Beams, bars, springs and dashpots between nodes of a body, in small displacements.
///
/// A beam is that of Euler and Bernoulli: cubic deflections w, whose slope at a node is the node's rotation, and a linear stretch
/// e,
///
///     U = integral of (EA e'^2 + EI |w''|^2 + GJ phi'^2) dx/2     T = integral of (rho A |u|^2 + 2 rho I phi^2) dx/2
///
/// with the rotation phi about its axis in space, where its section is round: the same second moment I in every direction, GJ = 2
/// G I with G = E/2.6. Rotations of a node are the components of one more node of the body: about z in the plane, about x, y and
/// z in space. Beams that meet at a node are clamped to each other; the ground at a node does not turn it. Przemieniecki, Theory
/// of Matrix Structural Analysis (1968), sections 5.6 and 11.

#include <array>
#include <string>

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/methods/fem/solids.hpp"

namespace sazare::methods::fem {

enum class MemberKind { beam, bar, spring, dashpot };

/// Members with one name, along lines from node to node. In the plane all numbers are per metre across it.
struct MemberSet {
  std::string name;
  MemberKind kind = MemberKind::beam;
  Real youngs_modulus = 0;  ///< of beams and bars [Pa]
  Real area = 0;            ///< [m2]
  Real second_moment = 0;   ///< of beams [m4]
  Real density = 0;         ///< [kg/m3]
  Real damping_ratio = 0;   ///< of Rayleigh damping [-]
  Real prestress = 0;       ///< tension of a bar at the beginning [N]
  Real stiffness = 0;       ///< of a spring along its line [N/m]
  Real damping = 0;         ///< of a dashpot along its line [N s/m]
  std::vector<std::array<Index, 2>> lines{};
};

/// What a member bears, the largest along it; tension is positive.
struct MemberForces {
  Real least_axial = 0, largest_axial = 0;  ///< signed [N]
  Real shear = 0;                           ///< [N]
  Real moment = 0;                          ///< [N m]
};

template <int D>
class Members {
public:
  /// `first_rotation` is the number of the first node of a rotation in the body. Throws UserError where a line has no length.
  Members(const geometry::ElementMesh& mesh, std::vector<MemberSet> sets, MassMatrix mass, Index first_rotation);

  const std::vector<MemberSet>& sets() const { return sets_; }
  std::size_t size() const { return elements_.size(); }
  /// Ends of an element, then the nodes of their rotations where it is a beam.
  std::span<const Index> nodes(std::size_t number) const { return elements_[number].nodes; }

  std::size_t rotation_nodes() const { return node_.size(); }
  Index rotation_node(std::size_t rotation) const { return first_rotation_ + static_cast<Index>(rotation); }
  /// The node of the mesh that a rotation belongs to.
  Index node_of(std::size_t rotation) const { return node_[rotation]; }

  void add_stiffness(BlockMatrix<D>& matrix) const;
  void add_mass(BlockMatrix<D>& matrix) const;
  /// a1 h M + a2 h K, and dashpots.
  void add_damping(Real mass_rate, Real stiffness_time, BlockMatrix<D>& matrix) const;
  /// Forces of the tension at the beginning, which do not depend on displacements [N].
  void add_prestress(NodalColumn& force) const;

  MemberForces forces(std::size_t set, const NodalColumn& displacement, const NodalColumn& velocity) const;

private:
  struct Element {
    std::size_t set = 0;
    std::vector<Index> nodes;
    Vector<D> along = Vector<D>::Zero();
    Eigen::MatrixXd stiffness, mass, damping;
  };

  Element make(std::size_t set, const std::array<Index, 2>& ends, const geometry::ElementMesh& mesh, MassMatrix mass) const;
  void make_beam(const MemberSet& of, Real length, MassMatrix mass, Element& element) const;
  Index rotation_of(Index node) const;
  void steady_spins();

  std::vector<MemberSet> sets_;
  Index first_rotation_;
  std::vector<Element> elements_;
  std::vector<Index> node_;  ///< by rotation, in ascending order
};

extern template class Members<2>;
extern template class Members<3>;

}  // namespace sazare::methods::fem
