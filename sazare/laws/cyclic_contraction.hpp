#pragma once

/// Contraction of sand under cycles of shear, from which pore pressure grows where water cannot leave.
///
///     de = C1 g/2 exp(-C2 e/g)      for a half cycle of amplitude g above the threshold; 0 below it
///
///     e   volume lost so far [-]          g   amplitude of the shear strain, half the way from one reversal to the next [-]
///     C1  = 8.7 N^-1.25                   C2  = 0.4/C1               N  blow count (N1)60 of the standard penetration test
///
/// Byrne, Proc. 2nd Int. Conf. on Recent Advances in Geotechnical Earthquake Engineering (1991), 47-55, after the tests of Martin, Finn
/// and Seed, J. Geotech. Eng. Div. ASCE 101 (1975) 423-438. A way in the space of shear strains is sqrt(2 x deviator : deviator), which is the
/// engineering shear strain of simple shear. A half cycle has ended where the strain has gone from its farthest point a tenth of the
/// way that led there: shear may turn its direction, and ripples shorter than that do not count. On longer ones a half cycle is split
/// into ways whose lengths add up.

#include <cmath>
#include <span>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

class CyclicContraction {
public:
  CyclicContraction() = default;
  CyclicContraction(Real rate, Real decay, Real threshold) : rate_(rate), decay_(decay), threshold_(threshold) {}

  static Real rate_of(Real blow_count) { return 8.7 * std::pow(blow_count, -1.25); }
  static Real decay_of(Real rate) { return 0.4 / rate; }

  Real rate() const { return rate_; }            ///< C1 [-]
  Real decay() const { return decay_; }          ///< C2 [-]
  Real threshold() const { return threshold_; }  ///< [-]

  /// Volume that half a cycle takes, after so much before [-].
  Real half_cycle(Real amplitude, Real before) const {
    return amplitude > threshold_ ? 0.5 * rate_ * amplitude * std::exp(-decay_ * before / amplitude) : 0;
  }

private:
  Real rate_ = 0, decay_ = 0, threshold_ = 0;
};

/// What a point remembers of its cycles, in numbers of a law's memory: where they turned, where they are farthest from there, the
/// volume lost, and what of it the next step has to take.
template <int Size>
class CycleMemory {
public:
  static constexpr std::size_t numbers = 2 * Size + 2;
  using Strain = Eigen::Matrix<Real, Size, 1>;  ///< normal strains, then engineering shear strains

  explicit CycleMemory(std::span<const Real> memory)
      : turned_(memory.data()), farthest_(memory.data() + Size), lost_(memory[2 * Size]), pending_(memory[2 * Size + 1]) {}

  Real lost() const { return lost_; }
  Real pending() const { return pending_; }

  /// Goes on to a strain.
  void follow(const Strain& strain, const CyclicContraction& law) {
    const Strain now = deviator(strain);
    const Real way = distance(farthest_, turned_);
    pending_ = 0;
    if (distance(now, turned_) > (1 + 1e-9) * way) {
      farthest_ = now;
    } else if (distance(now, farthest_) > 0.1 * way) {
      pending_ = law.half_cycle(0.5 * way, lost_);
      lost_ += pending_;
      turned_ = farthest_;
      farthest_ = now;
    }
  }

  /// Cycles begin at a strain.
  void begin(const Strain& strain) {
    turned_ = farthest_ = deviator(strain);
    lost_ = pending_ = 0;
  }

  void write(std::span<Real> memory) const {
    Eigen::Map<Strain>(memory.data()) = turned_;
    Eigen::Map<Strain>(memory.data() + Size) = farthest_;
    memory[2 * Size] = lost_;
    memory[2 * Size + 1] = pending_;
  }

private:
  static Strain deviator(Strain strain) {
    strain.template head<3>().array() -= strain.template head<3>().mean();
    return strain;
  }
  static Real distance(const Strain& a, const Strain& b) {
    const Strain between = a - b;
    return std::sqrt(2 * between.template head<3>().squaredNorm() + between.template tail<Size - 3>().squaredNorm());
  }

  Strain turned_, farthest_;
  Real lost_, pending_;
};

}  // namespace sazare::laws
