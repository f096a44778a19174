#pragma once

/// What a wave that comes in at an angle does at elevations of level layers: histories of velocities, displacements and
/// tractions.
///
/// The motion is taken apart into its frequencies and put together again by fast Fourier transforms, at complex frequencies
/// w - i c. So what would come around from the end of the transform is less than a millionth of itself: e^(-c T) = 1e-6 for its
/// length T. Phinney, J. Geophys. Res. 70 (1965) 3237-3258.

#include "sazare/laws/ground_motion.hpp"
#include "sazare/methods/fem/inclined_waves/incident_wave.hpp"
#include "sazare/methods/fem/inclined_waves/layered_ground.hpp"

namespace sazare::methods::fem {

template <int D>
class WaveHistories {
public:
  enum class Quantity { velocity, displacement, traction };
  /// One history: of tractions, those on the plane across an axis.
  struct Wanted {
    Quantity quantity = Quantity::velocity;
    int across = 0;
    Real height = 0;  ///< above the bottom of the layers [m]
  };

  /// The histories that are wanted, in steps of time [s].
  WaveHistories(const LayeredGround& ground, const IncidentWave& wave, const laws::GroundMotion& motion, Real step,
                const std::vector<Wanted>& wanted);

  /// At a time since the wave has reached the bottom; 0 before [m/s, m or Pa]. Between steps by cubic polynomials.
  Vector<D> at(std::size_t history, Real time) const;

private:
  Real step_;
  std::size_t length_ = 0;
  std::vector<Real> values_;  ///< one after the other by history and axis
};

extern template class WaveHistories<2>;
extern template class WaveHistories<3>;

}  // namespace sazare::methods::fem
