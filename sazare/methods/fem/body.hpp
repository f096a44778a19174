#pragma once

/// A body of finite elements: masses, forces, tangents and energies of a state of displacements.

#include "sazare/laws/rayleigh_damping.hpp"
#include "sazare/methods/fem/joint_pores.hpp"
#include "sazare/methods/fem/joints.hpp"
#include "sazare/methods/fem/members/members.hpp"
#include "sazare/methods/fem/pores.hpp"
#include "sazare/methods/fem/solids.hpp"

namespace sazare::methods::fem {

/// What a body is made of.
struct BodyDescription {
  geometry::ElementMesh mesh;  ///< cut along the joints
  std::vector<SolidMaterial> materials;
  std::vector<Index> material;  ///< by element
  std::vector<JointSet> joints;
  std::vector<MemberSet> members{};
  Integration integration = Integration::full;
  MassMatrix mass = MassMatrix::consistent;
};

/// What the points of integration remember.
struct Memory {
  std::vector<Real> solids;  ///< plastic strains, slips and what else their laws remember
  std::vector<Real> joints;  ///< slips
  std::vector<Real> members;  ///< plastic elongations and rotations
};

template <int D>
class Body {
public:
  /// Throws UserError where an element has no volume.
  explicit Body(BodyDescription description);
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const geometry::ElementMesh& mesh() const { return description_.mesh; }
  const BodyDescription& description() const { return description_; }
  const NodePattern& pattern() const { return pattern_; }
  const BlockMatrix<D>& mass() const { return mass_; }
  /// Of the nodes of the mesh, then of the pressure nodes of the pores, then of the rotations of beams.
  std::size_t freedoms() const { return pattern_.nodes() * D; }
  /// The same vector at all nodes of the mesh, 0 at all others.
  NodalColumn at_all_nodes(const Vector<D>& value) const;
  Real total_mass() const;

  /// Nothing yields and there are no joints: forces are the stiffness times the displacements.
  bool is_linear() const { return yielding_.size() + joints_.size() + members_.yielding() == 0; }
  bool is_symmetric() const;

  /// Elastic stiffness of all elements and members, without joints.
  BlockMatrix<D> elastic_stiffness() const;

  /// Dashpots, and a1 h M + a2 h K, with h the damping ratio of each element's material; K is the elastic one, also where the
  /// material yields.
  BlockMatrix<D> damping_matrix(const laws::RayleighDamping& damping) const;

  Memory memory_at_rest() const;

  /// What shear has done to the ground before, such as under its own weight, is no half cycle.
  void begin_cycles(const NodalColumn& displacement, Memory& memory) const;

  /// Forces of the water at rest in the pores on the nodes, which are those of its pressure against the effective stress [N].
  NodalColumn pore_force() const;

  /// Mean pressure of the water at rest in the pores of every element [Pa].
  std::vector<Real> pore_pressures() const;

  /// Internal forces of displacements, and the memory that they leave. `tangent`, where asked for, is made anew where it has
  /// changed; then the result is true.
  bool evaluate(const NodalColumn& displacement, const Memory& before, Memory& after, NodalColumn& force,
                BlockMatrix<D>* tangent);

  /// The next `evaluate` makes its tangent anew: after a return to an earlier state.
  void forget_tangent() { has_tangent_ = false; }

  struct Energies {
    Real elastic = 0;   ///< stored [J]
    Real plastic = 0;   ///< dissipated by plastic flow between the two states [J]
    Real friction = 0;  ///< dissipated by joints [J]
    Real members = 0;   ///< dissipated by members that yield [J]
  };
  Energies energies(const NodalColumn& displacement_before, const NodalColumn& displacement, const Memory& before,
                    const Memory& after) const;

  /// Stress, plastic slip and largest shear strain of every element.
  std::vector<SolidMean<D>> means(const NodalColumn& displacement, const Memory& memory) const;

  /// Stress at the points of integration of every element [Pa].
  std::vector<std::vector<Voigt<D>>> point_stresses(const NodalColumn& displacement, const Memory& memory) const;

  const Joints<D>& joints() const { return joints_; }
  const Pores<D>& pores() const { return pores_; }
  const JointPores<D>& joint_pores() const { return joint_pores_; }
  const Members<D>& members() const { return members_; }

private:
  /// Calls visit(element, point, pressure) for the points of integration of saturated ground.
  template <class Visit>
  void visit_pores(Visit visit) const;

  NodeGroups all_groups() const;
  NodeGroups changing_groups() const;

  BodyDescription description_;
  YieldingSolids<D> yielding_;
  Joints<D> joints_;
  Pores<D> pores_;
  JointPores<D> joint_pores_;
  Members<D> members_;
  NodePattern pattern_;
  BlockMatrix<D> mass_;
  BlockMatrix<D> linear_;  ///< stiffness of the elements and members that never yield
  NodalColumn prestress_;  ///< of members that never yield [N]
  GroupBuffer<D> buffer_;  ///< yielding elements, then joints, then yielding members
  bool has_tangent_ = false;
};

extern template class Body<2>;
extern template class Body<3>;

}  // namespace sazare::methods::fem
