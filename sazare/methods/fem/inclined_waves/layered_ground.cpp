#include "sazare/methods/fem/inclined_waves/layered_ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sazare::methods::fem {
namespace {

using Waves = Eigen::Matrix<Complex, 6, 3>;  // velocities and tractions on a level plane of P, SV and SH

constexpr Complex i_unit{0, 1};

/// Lame's constants of a stress that follows strains and their rates.
struct Moduli {
  Complex lame, shear;
};

/// Stress of a wave with this velocity and these slownesses, over exp(i w (t - p x - q z)).
ComplexMatrix stress_of(const Moduli& moduli, const ComplexVector& velocity, Real p, Complex q) {
  ComplexVector slowness;
  slowness << p, 0, q;
  const ComplexMatrix gradient = velocity * slowness.transpose();
  return -(moduli.lame * gradient.trace() * ComplexMatrix::Identity() + moduli.shear * (gradient + gradient.transpose()));
}

}  // namespace

Real ElasticLayer::p_velocity() const { return std::sqrt((lame + 2 * shear_modulus) / density); }
Real ElasticLayer::s_velocity() const { return std::sqrt(shear_modulus / density); }

/// A layer at one frequency.
struct LayeredGround::Medium {
  Medium(const ElasticLayer& layer, Real p, Complex w) : moduli{layer.lame, layer.shear_modulus}, slowness(p) {
    const Complex rate = Real{1} + i_unit * w * layer.stiffness_time;
    moduli.lame *= rate;
    moduli.shear *= rate;
    const Complex density = layer.density * (Real{1} - i_unit * layer.mass_rate / w);
    const Complex p_wave = (moduli.lame + Real{2} * moduli.shear) / density, s_wave = moduli.shear / density;
    velocity = {std::sqrt(p_wave), std::sqrt(s_wave)};
    vertical = {root(Real{1} / p_wave - p * p, w), root(Real{1} / s_wave - p * p, w)};
  }

  /// The slowness of a wave that does not grow upwards.
  static Complex root(Complex square, Complex w) {
    const Complex one = std::sqrt(square);
    return std::imag(w * one) > 0 ? -one : one;
  }

  ComplexVector slownesses() const { return ComplexVector(vertical[0], vertical[1], vertical[1]); }

  /// Directions of motion of P, SV and SH, upwards (sign 1) or downwards (-1).
  ComplexMatrix directions(Real sign) const {
    ComplexMatrix columns = ComplexMatrix::Zero();
    columns.col(0) << slowness * velocity[0], 0, sign * vertical[0] * velocity[0];
    columns.col(1) << vertical[1] * velocity[1], 0, -sign * slowness * velocity[1];
    columns(1, 2) = 1;
    return columns;
  }

  /// Tractions are taken over `impedance`, so that all numbers are of one size.
  Waves waves(Real sign, Real impedance) const {
    Waves waves;
    const ComplexMatrix motion = directions(sign);
    for (int wave = 0; wave < 3; ++wave) {
      waves.col(wave).head<3>() = motion.col(wave);
      waves.col(wave).tail<3>() = stress_of(moduli, motion.col(wave), slowness, sign * slownesses()[wave]).col(2) / impedance;
    }
    return waves;
  }

  /// What is left of each wave after a way up or down.
  ComplexVector carried(Real way, Complex w) const { return (-i_unit * w * way * slownesses()).array().exp().matrix(); }

  Moduli moduli;
  Real slowness;
  std::array<Complex, 2> velocity, vertical;  // of P and S waves
};

LayeredGround::LayeredGround(std::vector<ElasticLayer> layers, WaveKind kind, Real angle)
    : layers_(std::move(layers)), kind_(kind) {
  const ElasticLayer& lowest = layers_.front();
  slowness_ = std::sin(angle) / (kind == WaveKind::p ? lowest.p_velocity() : lowest.s_velocity());
}

std::vector<LayeredGround::Amplitudes> LayeredGround::amplitudes(Complex w) const {
  ElasticLayer below = layers_.front();
  below.mass_rate = below.stiffness_time = 0;
  const Real impedance = below.density * below.s_velocity();
  std::vector<Medium> media;
  for (const ElasticLayer& layer : layers_) media.emplace_back(layer, slowness_, w);

  const std::size_t count = layers_.size();
  std::vector<ComplexMatrix> reflected(count), transmitted(count);
  ComplexMatrix reflection;
  {
    const Waves up = media.back().waves(1, impedance), down = media.back().waves(-1, impedance);
    reflection = -down.bottomRows<3>().partialPivLu().solve(up.bottomRows<3>());
  }
  for (std::size_t layer = count; layer-- > 0;) {
    const Medium& own = media[layer];
    const Medium under = layer > 0 ? media[layer - 1] : Medium(below, slowness_, w);
    const ComplexMatrix carried = own.carried(layers_[layer].thickness, w).asDiagonal();
    reflected[layer] = reflection * carried;
    Eigen::Matrix<Complex, 6, 6> continuity;
    continuity << own.waves(1, impedance) + own.waves(-1, impedance) * (carried * reflected[layer]), -under.waves(-1, impedance);
    const Waves both = continuity.partialPivLu().solve(under.waves(1, impedance));
    transmitted[layer] = both.topRows<3>();
    reflection = both.bottomRows<3>();
  }

  std::vector<Amplitudes> amplitudes(count);
  ComplexVector rising = ComplexVector::Unit(static_cast<int>(kind_));
  for (std::size_t layer = 0; layer < count; ++layer) {
    amplitudes[layer].up = transmitted[layer] * rising;
    amplitudes[layer].down = reflected[layer] * amplitudes[layer].up;
    rising = media[layer].carried(layers_[layer].thickness, w).cwiseProduct(amplitudes[layer].up);
  }
  return amplitudes;
}

WaveField LayeredGround::field(const std::vector<Amplitudes>& amplitudes, Complex w, Real height) const {
  std::size_t layer = 0;
  while (layer + 1 < layers_.size() && height > layers_[layer].thickness) height -= layers_[layer++].thickness;
  const Medium medium(layers_[layer], slowness_, w);
  WaveField field;
  const auto add = [&](Real sign, Real way, const ComplexVector& amplitude) {
    const ComplexVector here = medium.carried(way, w).cwiseProduct(amplitude);
    const ComplexMatrix motion = medium.directions(sign) * here.asDiagonal();
    field.velocity += motion.rowwise().sum();
    for (int wave = 0; wave < 3; ++wave)
      field.stress += stress_of(medium.moduli, motion.col(wave), slowness_, sign * medium.slownesses()[wave]);
  };
  add(1, height, amplitudes[layer].up);
  add(-1, layers_[layer].thickness - height, amplitudes[layer].down);
  return field;
}

Real critical_angle(const std::vector<ElasticLayer>& layers, WaveKind kind) {
  const auto speed = [&](const ElasticLayer& layer, bool p_wave) { return p_wave ? layer.p_velocity() : layer.s_velocity(); };
  Real fastest = 0;
  for (const ElasticLayer& layer : layers) fastest = std::max(fastest, speed(layer, kind != WaveKind::sh));
  const Real sine = speed(layers.front(), kind == WaveKind::p) / fastest;
  return sine < 1 ? std::asin(sine) : std::numbers::pi / 2;
}

}  // namespace sazare::methods::fem
