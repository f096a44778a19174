#pragma once

/// Water in joints beside saturated ground: the excess pressure p of the ground pushes both faces apart, and the water that fills
/// an opening comes from the ground,
///
///     -Q p  on the faces,    Q^T u'  in the pressures' rows,    Q  integral of N_p n over the jump of the displacement
///
/// so that the springs and the friction of the joint are those of the effective stress, and no work is lost between the two. Such
/// interface elements with one pressure: Ng and Small, Comput. Geotech. 20 (1997). Where both sides have pressures the joint
/// has their mean; no water flows across it.

#include "sazare/methods/fem/joints.hpp"
#include "sazare/methods/fem/pores.hpp"

namespace sazare::methods::fem {

template <int D>
class JointPores {
public:
  JointPores(const geometry::ElementMesh& mesh, const Joints<D>& joints, const Pores<D>& pores);

  /// Faces of joints with saturated ground beside them whose excess pressure is an unknown.
  std::size_t size() const { return face_.size(); }
  /// Nodes of the first face, of the second one, then pressure nodes.
  std::span<const Index> nodes(std::size_t number) const { return groups_.nodes(number); }

  /// -Q and its transpose [N s/m].
  void add_coupling(BlockMatrix<D>& matrix) const;

private:
  struct Face {
    const geometry::InterfaceFace* face = nullptr;
    Real share = 1;  ///< of each side with pressures
  };

  const geometry::ElementMesh* mesh_;
  std::vector<Face> face_;
  NodeGroups groups_;
};

extern template class JointPores<2>;
extern template class JointPores<3>;

}  // namespace sazare::methods::fem
