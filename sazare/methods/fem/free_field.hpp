#pragma once

/// The columns beside the sides of a body in motion, and what the sides feel of them.
///
/// A side feels the tractions of its column and dashpots between its own velocity and the column's, by area:
///
///     t = (s - s_0) n + rho V_P (v_c - v)_n + rho V_S (v_c - v)_t
///
/// s, v_c   stress and velocity of the column at the same elevation, with the stress of Rayleigh damping; s_0 is that at rest
/// n, t     normal of the side, outwards, and directions along it
///
/// What it carries at rest, s_0 n where the body is level as well, is found with the body's own equilibrium. Columns do not feel
/// the body. Zienkiewicz, Bicanic and Shen, in Advances in Computational Nonlinear Mechanics (1989) 109-138; Nielsen, 2006 ABAQUS
/// Users' Conference 359-376; FLAC3D, Dynamic Analysis, free-field boundaries.
///
/// Where a wave comes in at an angle there are no columns: the wave in level elastic layers stands in their place.

#include <memory>

#include "sazare/methods/fem/inclined_waves/inclined_field.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {

/// The columns of all sides of a body; each is a body of its own with a stepper of its own.
template <int D>
class FreeField {
public:
  FreeField(const Body<D>& body, const Supports<D>& supports, const FemRules& rules);
  ~FreeField();

  bool is_empty() const { return columns_.empty() && !inclined_; }
  /// Of a wave that comes in at an angle; null where there is none.
  const InclinedField<D>* inclined() const { return inclined_.get(); }
  /// Of the dashpots between body and columns [N s/m].
  const BlockMatrix<D>& impedance() const { return impedance_; }

  void relax();
  void start();
  void advance();

  /// On the nodes of all sides, 0 on all others, at the time to which the columns have gone.
  SideMotion motion(Real time) const;
  /// The force of a side beyond what it carries at rest, on a body with these velocities at that time [N].
  Vector<D> force(std::size_t side, const NodalColumn& velocity, Real time) const;

  std::vector<FemState<D>> states() const;
  void restore(const std::vector<FemState<D>>& states);
  void columns(Archive& archive);

private:
  class Column;

  std::vector<std::vector<ViscousFace>> faces_;  ///< of each side
  BlockMatrix<D> impedance_;
  std::unique_ptr<InclinedField<D>> inclined_;
  std::vector<std::unique_ptr<Column>> columns_;
};

extern template class FreeField<2>;
extern template class FreeField<3>;

}  // namespace sazare::methods::fem
