#pragma once

/// The motion of the base on which a body stands, axis by axis: the one motion that all supports along the axis follow. Where some
/// of them stand still, or follow another motion, the body has no one base along it.
///
/// Damping in proportion to the mass stands for losses within the body. Relative to the velocity v_b of the base it leaves a body
/// alone that moves as its base does:
///
///     f = -a1 h m (v - v_b)      a1  rate [1/s]     h  damping ratio [-]     m  mass [kg]

#include <array>

#include "sazare/core/time.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::laws {

class BaseMotion {
public:
  static constexpr Index none = -1;

  /// Takes in a support along an axis, by the number of its motion, or none.
  void add_support(int axis, Index motion) {
    Along& along = along_[static_cast<std::size_t>(axis)];
    if (along.is_supported && along.motion != motion) motion = none;
    along = {true, motion};
  }

  Index along(int axis) const { return along_[static_cast<std::size_t>(axis)].motion; }

private:
  struct Along {
    bool is_supported = false;
    Index motion = none;
  };
  std::array<Along, 3> along_{};
};

}  // namespace sazare::laws
