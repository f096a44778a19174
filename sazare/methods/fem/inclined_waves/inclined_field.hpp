#pragma once

/// A wave that comes in at an angle, at the free-field sides and the viscous base of a body.
///
/// Both feel, by area,
///
///     t = s n + rho V_P (v_w - v)_n + rho V_S (v_w - v)_t
///
/// with the stress s and the velocity v_w of the wave in level layers without end, besides what they carry at rest. At a side the
/// layers are its own. At the base, where waves come back from all of them, they are those of all sides in shares that fall with
/// the distance to each, so that level ground moves as layers without end do, and a side of another height finds its own motion.
/// The record is that of the wave at the corner of the base that it reaches first.

#include <vector>

#include "sazare/methods/fem/body.hpp"
#include "sazare/methods/fem/inclined_waves/wave_histories.hpp"
#include "sazare/methods/fem/supports.hpp"

namespace sazare::methods::fem {

struct SideMotion;

/// The layers of a free-field side.
template <int D>
std::vector<ElasticLayer> elastic_layers(const FreeFieldSide<D>& side, const laws::RayleighDamping& damping);

template <int D>
class InclinedField {
public:
  InclinedField(const Body<D>& body, const Supports<D>& supports, Real step, const laws::RayleighDamping& damping);
  ~InclinedField();

  /// Adds what the sides feel at a time, as of columns.
  void add_to(SideMotion& motion, Real time) const;
  /// The forces of the base, where dashpots would stand still [N].
  void add_incoming(NodalColumn& force, Real time) const;
  /// Their sums on a side, and on a viscous boundary [N].
  Vector<D> force_of_side(std::size_t side, Real time) const;
  Vector<D> force_of_boundary(std::size_t boundary, Real time) const;

private:
  class Surface;

  std::size_t freedoms_;
  std::vector<Surface> sides_, boundaries_;
  std::vector<WaveHistories<D>> grounds_;  ///< beside each side
};

extern template class InclinedField<2>;
extern template class InclinedField<3>;

}  // namespace sazare::methods::fem
