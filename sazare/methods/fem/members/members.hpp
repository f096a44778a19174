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
///
/// Bars and springs may have limits of their force (laws/members/axial_limits.hpp), beams plastic hinges at their ends
/// (laws/members/end_hinges.hpp). Where two beams in line meet, or in the plane any two, only the weaker has a hinge, or the
/// first of equal ones: the moments of both are one, and hinges on both sides would leave the node between them free to turn.

#include <array>
#include <limits>
#include <optional>
#include <string>

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/laws/members/axial_limits.hpp"
#include "sazare/laws/members/end_hinges.hpp"
#include "sazare/methods/fem/solids.hpp"

namespace sazare::methods::fem {

enum class MemberKind { beam, bar, spring, dashpot };

/// Members with one name, along lines from node to node. In the plane all numbers are per metre across it.
struct MemberSet {
  std::string name;
  MemberKind kind = MemberKind::beam;
  Real youngs_modulus = 0;                                    ///< of beams and bars [Pa]
  Real area = 0;                                              ///< [m2]
  Real second_moment = 0;                                     ///< of beams [m4]
  Real density = 0;                                           ///< [kg/m3]
  Real damping_ratio = 0;                                     ///< of Rayleigh damping [-]
  Real prestress = 0;                                         ///< tension of a bar at the beginning [N]
  Real stiffness = 0;                                         ///< of a spring along its line [N/m]
  Real damping = 0;                                           ///< of a dashpot along its line [N s/m]
  Real yield_force = std::numeric_limits<Real>::infinity();   ///< of a bar or spring [N]
  std::optional<Real> compression_force{};                    ///< at which it gives way and forgets it [N]
  Real yield_moment = std::numeric_limits<Real>::infinity();  ///< of a beam [N m]
  std::vector<std::array<Index, 2>> lines{};
};

/// What a member bears, the largest along it; tension is positive.
struct MemberForces {
  Real least_axial = 0, largest_axial = 0;  ///< signed [N]
  Real shear = 0;                           ///< [N]
  Real moment = 0;                          ///< [N m]
  Real plastic_elongation = 0;              ///< of an element, the largest in size, signed [m]
  Real plastic_rotation = 0;                ///< of a hinge [rad]

  /// The largest force and moment over their limits; 0 where there is none.
  Real force_ratio(const MemberSet& set) const;
  Real moment_ratio(const MemberSet& set) const { return moment / set.yield_moment; }
};

/// The slope of a beam's axis by the rotation of a node; in the plane the rotation is the first component.
template <int D>
Eigen::Matrix<Real, D, D> slope_of_rotation(const Vector<D>& along) {
  Eigen::Matrix<Real, D, D> slope = Eigen::Matrix<Real, D, D>::Zero();
  if constexpr (D == 2)
    slope.col(0) = Vector<2>(-along.y(), along.x());
  else
    for (int axis = 0; axis < 3; ++axis) slope.col(axis) = Vector3(Vector3::Unit(axis).cross(along));
  return slope;
}

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

  /// Of the elements without limits, or of those with them, as they are when nothing has yielded.
  void add_stiffness(BlockMatrix<D>& matrix, bool of_yielding) const;
  void add_mass(BlockMatrix<D>& matrix) const;
  /// a1 h M + a2 h K, and dashpots.
  void add_damping(Real mass_rate, Real stiffness_time, BlockMatrix<D>& matrix) const;
  /// Forces of the tension at the beginning of the elements without limits, which do not depend on displacements [N].
  void add_prestress(NodalColumn& force) const;

  MemberForces forces(std::size_t set, const NodalColumn& displacement, const NodalColumn& velocity,
                      std::span<const Real> memory) const;

  /// Elements with limits, which are evaluated from step to step.
  std::size_t yielding() const { return yielding_.size(); }
  std::span<const Index> yielding_nodes(std::size_t number) const { return elements_[yielding_[number]].nodes; }
  std::size_t set_of_yielding(std::size_t number) const { return elements_[yielding_[number]].set; }

  /// Numbers of memory: the plastic elongation of a bar or spring, the plastic rotations of a beam's ends.
  std::size_t memory_size() const { return memory_size_; }

  /// Force and tangent of an element with limits, as `YieldingSolids` gives them for a solid one.
  void evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before, std::span<Real> after,
                std::span<Real> force, std::span<Real> tangent) const;

  struct Energies {
    Real elastic = 0;  ///< stored [J]
    Real plastic = 0;  ///< dissipated since the memory before, by the mean force of both states [J]
  };
  Energies energies(std::size_t number, const NodalColumn& displacement_before, const NodalColumn& displacement,
                    std::span<const Real> before, std::span<const Real> after) const;

  /// At both ends of an element with limits, as sizes: plastic elongation of a bar or spring [m], plastic rotation of a beam's
  /// hinge [rad].
  std::array<std::pair<Index, Real>, 2> plastic_by_node(std::size_t number, std::span<const Real> memory) const;
  bool has_yielded(std::size_t number, std::span<const Real> memory) const;

private:
  struct Element {
    std::size_t set = 0;
    std::vector<Index> nodes;
    Real length = 0;  ///< [m]
    Vector<D> along = Vector<D>::Zero();
    Eigen::MatrixXd stiffness, mass, damping;
    std::optional<laws::AxialLimits> limits{};
    laws::EndHinges hinges{};  ///< of a beam
    bool yields = false;
    std::size_t memory = 0;  ///< where that of the element begins
  };
  /// What an element with limits does beside its elastic stiffness.
  struct Response {
    Eigen::VectorXd force;  ///< on its freedoms [N], [N m]
    Eigen::MatrixXd tangent;
    Eigen::VectorXd plastic;    ///< memory
    Eigen::VectorXd conjugate;  ///< force of each number of the memory [N], [N m]
    Real energy = 0;            ///< stored [J]
  };

  Element make(std::size_t set, const std::array<Index, 2>& ends, const geometry::ElementMesh& mesh, MassMatrix mass) const;
  void make_beam(const MemberSet& of, Real length, MassMatrix mass, Element& element) const;
  Index rotation_of(Index node) const;
  void steady_spins();
  void place_hinges();
  void find_yielding();
  Eigen::VectorXd of_nodes(const Element& element, const NodalColumn& column) const;
  Eigen::MatrixXd slopes(const Element& element) const;
  Response respond(const Element& element, const Eigen::VectorXd& moved, std::span<const Real> memory) const;
  Response respond_beam(const Element& element, const Eigen::VectorXd& moved, std::span<const Real> memory) const;
  void tell_plastic(const Element& element, const Response& response, MemberForces& found) const;
  Response respond_bar(const Element& element, const Eigen::VectorXd& moved, std::span<const Real> memory) const;

  std::vector<MemberSet> sets_;
  Index first_rotation_;
  std::vector<Element> elements_;
  std::vector<Index> node_;            ///< by rotation, in ascending order
  std::vector<std::size_t> yielding_;  ///< elements
  std::size_t memory_size_ = 0;
};

extern template class Members<2>;
extern template class Members<3>;

}  // namespace sazare::methods::fem
