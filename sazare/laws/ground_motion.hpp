#pragma once

/// Motion of the ground as a function of time: displacement, velocity and acceleration that belong together, at rest before 0.
///
/// Displacements count from where things stand at t = 0, whatever value a history has there. Where a history of displacements
/// ends, what it moves stays where it then is; one of velocities or accelerations is 0 after its end.
///
/// Ricker wavelet [Yoshida2010], eq. (9), here of the acceleration; with b = (pi fc)^2, s = t - tp:
///
///     e(t) = (2 b s^2 - 1) exp(-b s^2)     fc  central frequency [Hz]     tp  time of the peak [s]
///
/// Its integrals -s exp(-b s^2) and exp(-b s^2)/(2 b) die out on both sides, so it leaves no drift; what the first one is at
/// t = 0 is the velocity with which the motion begins (1e-4 of the peak for fc tp = 1).
///
/// A record is linear between its samples, and is integrated exactly from rest. What a record of accelerations leaves as velocity
/// at its end, its drift, stays, unless a baseline is taken off (`take_off_baseline`).
///
/// A function that only the caller of the engine knows is a record too, whose samples are handed over while the run goes on.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct MotionState {
  Real displacement = 0;  ///< [m]
  Real velocity = 0;      ///< [m/s]
  Real acceleration = 0;  ///< [m/s2]
};

/// Which of the three a history gives.
enum class MotionQuantity { displacement, velocity, acceleration };

struct Ricker {
  Real frequency = 0;  ///< fc [Hz]
  Real peak_time = 0;  ///< tp [s]
};

/// The wavelet's second integral (`order` 0), first (1), itself (2), and its derivatives (3, 4).
inline Real ricker_order(const Ricker& wave, Real time, int order) {
  const Real b = std::numbers::pi * std::numbers::pi * wave.frequency * wave.frequency;
  const Real s = time - wave.peak_time, bell = std::exp(-b * s * s), z = b * s * s;
  switch (order) {
    case 0:
      return bell / (2 * b);
    case 1:
      return -s * bell;
    case 2:
      return (2 * z - 1) * bell;
    case 3:
      return b * s * (6 - 4 * z) * bell;
    default:
      return b * (6 - 24 * z + 8 * z * z) * bell;
  }
}

inline Real ricker(const Ricker& wave, Real time) { return ricker_order(wave, time, 2); }

/// Sine from t = 0 for a number of periods, which need not be whole.
struct Sine {
  Real frequency = 0;  ///< [Hz]
  Real cycles = 0;     ///< 0: without end
};

/// Equal steps of time, linear between them.
struct Record {
  Real step = 0;             ///< [s]
  std::vector<Real> value;   ///< of the motion's quantity
  std::vector<Real> first;   ///< its integral from 0 at each sample
  std::vector<Real> second;  ///< the integral of that

  static Record make(Real step, std::vector<Real> value) {
    Record record{step, std::move(value), {}, {}};
    record.integrate();
    return record;
  }

  void integrate() {
    const std::vector<Real> samples = std::move(value);
    value.clear();
    first.clear();
    second.clear();
    for (const Real sample : samples) add(sample);
  }

  /// One more sample, and the integrals to it.
  void add(Real sample) {
    const bool begins = value.empty();
    const Real before = begins ? 0 : value.back();
    const Real next = begins ? 0 : first.back() + 0.5 * step * (before + sample);
    const Real twice = begins ? 0 : second.back() + step * first.back() + step * step * (2 * before + sample) / 6;
    value.push_back(sample);
    first.push_back(next);
    second.push_back(twice);
  }

  Real duration() const { return value.empty() ? 0 : step * static_cast<Real>(value.size() - 1); }

  /// (second integral, integral, value, slope) at a time. After the last sample the value is `last`; it counts no more in the
  /// integrals.
  std::array<Real, 4> at(Real time, Real last = 0) const {
    if (value.size() < 2 || time <= 0) return {};
    const Real place = std::min(time / step, static_cast<Real>(value.size() - 1));
    const std::size_t i = std::min(static_cast<std::size_t>(place), value.size() - 2);
    const Real t = std::min(time, duration()) - step * static_cast<Real>(i);
    const Real slope = (value[i + 1] - value[i]) / step;
    const Real integral = first[i] + t * (value[i] + 0.5 * slope * t);
    const Real twice = second[i] + t * (first[i] + t * (0.5 * value[i] + slope * t / 6));
    const Real after = time - duration();
    if (after > 0) return {twice + integral * after, integral, last, 0};
    return {twice, integral, value[i] + slope * t, slope};
  }
};

/// Takes off the straight line (`degree` 1) or the constant (0) in the values for which their integral, least squares over the
/// record and 0 at its beginning, has no trend left.
inline void take_off_baseline(Record& record, int degree) {
  // Fit the integral by c1 t + c2 t^2 (degree 0: c1 t).
  Real s2 = 0, s3 = 0, s4 = 0, b1 = 0, b2 = 0;
  for (std::size_t i = 0; i < record.value.size(); ++i) {
    const Real t = static_cast<Real>(i) / static_cast<Real>(record.value.size());
    s2 += t * t;
    s3 += t * t * t;
    s4 += t * t * t * t;
    b1 += t * record.first[i];
    b2 += t * t * record.first[i];
  }
  if (!(s2 > 0)) return;
  const Real scale = record.step * static_cast<Real>(record.value.size());
  const Real determinant = s2 * s4 - s3 * s3;
  const Real c1 = degree == 0 ? b1 / s2 : (b1 * s4 - b2 * s3) / determinant;
  const Real c2 = degree == 0 ? 0 : (b2 * s2 - b1 * s3) / determinant;
  for (std::size_t i = 0; i < record.value.size(); ++i) {
    const Real t = static_cast<Real>(i) / static_cast<Real>(record.value.size());
    record.value[i] -= (c1 + 2 * c2 * t) / scale;
  }
  record.integrate();
}

struct GroundMotion {
  enum class Shape { ricker, sine, record, function };

  Shape shape = Shape::ricker;
  MotionQuantity quantity = MotionQuantity::acceleration;  ///< what the shape describes
  Real amplitude = 1;                                      ///< factor, in the unit of the quantity (a number for a record)
  Ricker ricker_wave;
  Sine sine_wave;
  Record record;
  std::shared_ptr<const Record> samples;  ///< of a function: as many as are known, past the time of the run

  MotionState at(Real time) const {
    if (time < 0) return {};
    std::array<Real, 3> motion{};
    const int lowest = 2 - static_cast<int>(quantity);  // how often the displacement differentiates to the quantity, backwards
    for (int i = 0; i < 3; ++i) motion[static_cast<std::size_t>(i)] = amplitude * order(time, lowest + i);
    return {motion[0] - amplitude * beginning(lowest), motion[1], motion[2]};
  }

private:
  /// Whether the history stays at its last value.
  bool holds() const { return quantity == MotionQuantity::displacement; }

  /// The displacement that the formula or the samples have at t = 0; `lowest` is its order.
  Real beginning(int lowest) const {
    if (shape == Shape::ricker) return ricker_order(ricker_wave, 0, lowest);
    const Record* const sampled = samples_of();
    return holds() && sampled != nullptr && sampled->value.size() >= 2 ? sampled->value.front() : 0;
  }

  const Record* samples_of() const {
    return shape == Shape::record ? &record : shape == Shape::function ? samples.get() : nullptr;
  }

  /// Order 2 is the shape itself, 1 its integral, 3 its derivative.
  Real order(Real time, int order) const {
    if (shape == Shape::ricker) return ricker_order(ricker_wave, time, order);
    if (shape == Shape::sine) return sine_order(time, order);
    return order > 3 ? 0 : sampled_order(*samples_of(), time)[static_cast<std::size_t>(order)];
  }

  std::array<Real, 4> sampled_order(const Record& sampled, Real time) const {
    if (!holds() || sampled.value.size() < 2) return sampled.at(time);
    std::array<Real, 4> found = sampled.at(time, sampled.value.back());
    if (time <= 0) found[2] = sampled.value.front();
    return found;
  }

  Real sine_order(Real time, int order) const {
    if (time <= 0) return 0;
    const Real omega = 2 * std::numbers::pi * sine_wave.frequency;
    const Real length = sine_wave.cycles > 0 ? sine_wave.cycles / sine_wave.frequency : time;
    const Real t = std::min(time, length);
    switch (order) {
      case 0:
        return (t - std::sin(omega * t) / omega) / omega +
               (time > length ? (1 - std::cos(omega * t)) / omega * (time - length) : 0);
      case 1:
        return (1 - std::cos(omega * t)) / omega;
      case 2:
        return time > length && !holds() ? 0 : std::sin(omega * t);
      case 3:
        return time > length ? 0 : omega * std::cos(omega * t);
      default:
        return time > length ? 0 : -omega * omega * std::sin(omega * t);
    }
  }
};

}  // namespace sazare::laws
