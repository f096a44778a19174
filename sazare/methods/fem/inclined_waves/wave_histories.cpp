#include "sazare/methods/fem/inclined_waves/wave_histories.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace sazare::methods::fem {
namespace {

constexpr Real left_at_end = 1e-6;  // of what comes around from the end of the transform

/// The axes of a body in the frame of a wave: rows are x, y and z of the wave, and columns the axes of the body.
template <int D>
Eigen::Matrix<Real, 3, D> frame(Real azimuth) {
  Eigen::Matrix<Real, 3, D> axes = Eigen::Matrix<Real, 3, D>::Zero();
  axes(2, D - 1) = 1;
  axes(0, 0) = 1;
  if constexpr (D == 3) {
    axes.template topLeftCorner<1, 2>() << std::cos(azimuth), std::sin(azimuth);
    axes.template block<1, 2>(1, 0) << -std::sin(azimuth), std::cos(azimuth);
  }
  return axes;
}

/// A Fourier transform of histories that fade by e^(-c t) on their way.
class FadingTransform {
public:
  FadingTransform(std::size_t length, Real step) : length_(length), step_(step) {
    transform_.SetFlag(Eigen::FFT<Real>::HalfSpectrum);
    fade_ = -std::log(left_at_end) / (static_cast<Real>(length) * step);
  }

  std::size_t frequencies() const { return length_ / 2 + 1; }
  Complex frequency(std::size_t number) const {
    return {2 * std::numbers::pi * static_cast<Real>(number) / (static_cast<Real>(length_) * step_), -fade_};
  }
  Real fading(std::size_t sample) const { return std::exp(-fade_ * static_cast<Real>(sample) * step_); }

  std::vector<Complex> forward(std::vector<Real> history) {
    for (std::size_t i = 0; i < length_; ++i) history[i] *= fading(i);
    std::vector<Complex> spectrum;
    transform_.fwd(spectrum, history);
    return spectrum;
  }

  void backward(const std::vector<Complex>& spectrum, Real* history) {
    std::vector<Real> faded;
    transform_.inv(faded, spectrum, static_cast<Eigen::Index>(length_));
    for (std::size_t i = 0; i < length_; ++i) history[i] = faded[i] / fading(i);
  }

private:
  Eigen::FFT<Real> transform_;
  std::size_t length_;
  Real step_, fade_ = 0;
};

}  // namespace

template <int D>
WaveHistories<D>::WaveHistories(const LayeredGround& ground, const IncidentWave& wave, const laws::GroundMotion& motion,
                                Real step, const std::vector<Wanted>& wanted)
    : step_(step) {
  constexpr std::size_t beyond = 4;  // samples that the polynomials look at
  length_ = std::bit_ceil(static_cast<std::size_t>(std::ceil(wave.until / step)) + beyond);
  FadingTransform transform(length_, step);
  std::vector<Real> history(length_);
  for (std::size_t i = 0; i < length_; ++i) history[i] = motion.at(static_cast<Real>(i) * step).velocity;
  const std::vector<Complex> incident = transform.forward(history);
  std::vector<std::vector<LayeredGround::Amplitudes>> amplitudes;
  for (std::size_t k = 0; k < transform.frequencies(); ++k) amplitudes.push_back(ground.amplitudes(transform.frequency(k)));

  const auto axes = frame<D>(wave.azimuth);
  values_.resize(wanted.size() * D * length_);
  std::array<std::vector<Complex>, D> spectrum;
  for (auto& one : spectrum) one.resize(transform.frequencies());
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    for (std::size_t k = 0; k < transform.frequencies(); ++k) {
      const Complex w = transform.frequency(k);
      const WaveField field = ground.field(amplitudes[k], w, wanted[n].height);
      Eigen::Matrix<Complex, D, 1> value;
      if (wanted[n].quantity == Quantity::traction)
        value = axes.transpose() * (field.stress * axes.col(wanted[n].across));
      else
        value = axes.transpose() * field.velocity;
      if (wanted[n].quantity == Quantity::displacement) value /= Complex{0, 1} * w;
      for (int axis = 0; axis < D; ++axis) spectrum[static_cast<std::size_t>(axis)][k] = incident[k] * value[axis];
    }
    for (std::size_t axis = 0; axis < D; ++axis) transform.backward(spectrum[axis], &values_[(n * D + axis) * length_]);
  }
}

template <int D>
Vector<D> WaveHistories<D>::at(std::size_t history, Real time) const {
  Vector<D> value = Vector<D>::Zero();
  if (time <= 0) return value;
  const Real place = std::min(time / step_, static_cast<Real>(length_ - 3));
  const auto before = static_cast<std::ptrdiff_t>(place);
  const Real t = place - static_cast<Real>(before);
  const std::array shares{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                          (t + 1) * t * (t - 1) / 6};
  for (int axis = 0; axis < D; ++axis) {
    const Real* const samples = &values_[(history * D + static_cast<std::size_t>(axis)) * length_];
    for (std::ptrdiff_t k = 0; k < 4; ++k)
      if (before + k >= 1) value[axis] += shares[static_cast<std::size_t>(k)] * samples[before + k - 1];
  }
  return value;
}

template class WaveHistories<2>;
template class WaveHistories<3>;

}  // namespace sazare::methods::fem
