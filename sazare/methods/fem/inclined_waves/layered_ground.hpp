#pragma once

/// Plane waves in level elastic layers on a half space without end, at one frequency.
///
/// The wave comes from the half space. All motion goes as exp(i w (t - p x)) along its horizontal direction x, with one slowness
/// p in all layers (Snell's law). In a layer it is the sum of three waves that go up and three that go down, P, SV and SH:
///
///     v(z) = sum of a d exp(-+ i w q z)     q = sqrt(1/V^2 - p^2)
///
/// a, d    amplitude and direction of motion of each wave
/// q       slowness along z, which points up
/// V       velocity of P or S waves [m/s]
///
/// What comes down from all that lies above is a matrix R times what goes up. R is that of the free surface at the top of the
/// uppermost layer, and follows from layer to layer downwards by the continuity of velocities and tractions; then amplitudes
/// follow upwards. No term grows with the thickness of a layer. Kennett, Seismic Wave Propagation in Stratified Media (1983),
/// chapters 5 and 6; Aki and Richards, Quantitative Seismology (2002), chapter 5.

#include <array>
#include <complex>
#include <vector>

#include "sazare/methods/fem/inclined_waves/incident_wave.hpp"

namespace sazare::methods::fem {

using Complex = std::complex<Real>;
using ComplexVector = Eigen::Matrix<Complex, 3, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, 3, 3>;

/// Elastic ground with the Rayleigh damping of its material.
struct ElasticLayer {
  Real thickness = 0;       ///< [m]
  Real density = 0;         ///< [kg/m3]
  Real lame = 0;            ///< Lame's first constant [Pa]
  Real shear_modulus = 0;   ///< [Pa]
  Real mass_rate = 0;       ///< damping in proportion to the mass [1/s]
  Real stiffness_time = 0;  ///< damping in proportion to the stiffness [s]

  Real p_velocity() const;  ///< [m/s]
  Real s_velocity() const;  ///< [m/s]
};

/// Motion and stress of a wave, over the velocity of the incident one. Along x the wave travels, z points up.
struct WaveField {
  ComplexVector velocity = ComplexVector::Zero();
  ComplexMatrix stress = ComplexMatrix::Zero();  ///< [Pa s/m]
};

class LayeredGround {
public:
  /// Layers from the bottom up. The half space is that of the lowest layer, without damping. The angle of the wave is from the
  /// vertical, above 0 where it travels towards x [rad].
  LayeredGround(std::vector<ElasticLayer> layers, WaveKind kind, Real angle);

  Real slowness() const { return slowness_; }  ///< p [s/m]

  /// Amplitudes of the waves in a layer: those that go up at its bottom, those that go down at its top.
  struct Amplitudes {
    ComplexVector up = ComplexVector::Zero(), down = ComplexVector::Zero();
  };
  /// In all layers, from the bottom up, at an angular frequency [rad/s] whose imaginary part is at most 0.
  std::vector<Amplitudes> amplitudes(Complex frequency) const;

  /// At a height above the bottom of the lowest layer, within it or in a layer above [m].
  WaveField field(const std::vector<Amplitudes>& amplitudes, Complex frequency, Real height) const;

private:
  struct Medium;

  std::vector<ElasticLayer> layers_;
  WaveKind kind_;
  Real slowness_ = 0;
};

/// The largest angle from the vertical of a wave for which no wave of that slowness runs along the layers instead of through them
/// [rad]: the critical angle, a right angle where there is none.
Real critical_angle(const std::vector<ElasticLayer>& layers, WaveKind kind);

}  // namespace sazare::methods::fem
