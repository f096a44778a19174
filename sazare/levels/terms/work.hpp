#pragma once

/// Work that is known from impulses: an impulse times the mean motion of its body over the kick is exactly the work done.

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "sazare/levels/terms/force_moment.hpp"
#include "sazare/levels/terms/energy_balance.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::terms {

/// Where the work of a part of a force goes.
enum class Cause : std::uint8_t { load, joint_dashpot, contact_dashpot, friction, boundary };

inline constexpr std::size_t cause_count = 5;

/// Work on a body by cause [J].
using CauseWork = std::array<Real, cause_count>;

inline EnergyKind energy_kind_of(Cause cause) {
  switch (cause) {
    case Cause::load:
      return EnergyKind::work;
    case Cause::joint_dashpot:
      return EnergyKind::joint_dashpot;
    case Cause::contact_dashpot:
      return EnergyKind::contact_dashpot;
    case Cause::friction:
      return EnergyKind::friction;
    case Cause::boundary:
      break;
  }
  return EnergyKind::boundary;
}

/// Adds work on the bodies to the sum of its kind: that of loads is done on them, all other is taken from them.
inline void add_work(Cause cause, Real work, EnergySums& energies) {
  ExactSum& sum = energies[energy_kind_of(cause)];
  if (cause == Cause::load)
    sum += work;
  else
    sum -= work;
}

/// Adds the work on several bodies.
inline void add_work(std::span<const CauseWork> works, EnergySums& energies) {
  for (const CauseWork& work : works)
    for (std::size_t cause = 0; cause < cause_count; ++cause)
      if (work[cause] != 0) add_work(static_cast<Cause>(cause), work[cause], energies);  // most bodies know one or two causes
}

/// Bodies that are kicked together; what they gather stays in the first-level cache.
inline constexpr std::size_t chunk_size = 32;

/// Impulses by cause that the bodies of a chunk receive, until their mean motion is known.
template <int D>
class CauseImpulses {
public:
  void clear() { received_.fill(0); }

  void add(Cause cause, std::size_t place, const ForceMoment<D>& impulse) {
    const auto c = static_cast<std::size_t>(cause);
    Real* numbers = impulse_[c][place].numbers.data();
    if (received_[place] >> c & 1)
      impulse.add_to(numbers);
    else
      impulse.store(numbers);
    received_[place] = static_cast<std::uint8_t>(received_[place] | 1U << c);
  }

  /// Adds the work of all that one body has received.
  void add_work(std::size_t place, const state::MeanMotion<D>& mean, CauseWork& work) const {
    for (unsigned left = received_[place]; left != 0; left &= left - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(left));
      work[c] += impulse_[c][place].power(mean);
    }
  }

private:
  struct alignas(64) Record {
    std::array<Real, 8> numbers;  ///< force, then moment

    Real power(const state::MeanMotion<D>& mean) const {
      if constexpr (D == 3) {  // as whole records; what stands behind a motion is anything
        using Row = RegisterOf<8>;
        const auto row = [](const Real* from) -> Row::Reals { return *reinterpret_cast<const Row::InMemory*>(from); };
        static_assert(sizeof(state::MeanMotion<3>) == sizeof(Record));
        return Row::sum(row(numbers.data()) * first_of<6, 8>(row(mean.velocity.data())));
      } else {
        const Eigen::Map<const Vector<D>> linear(numbers.data());
        const Eigen::Map<const Angular<D>> angular(numbers.data() + D);
        return linear.dot(mean.velocity) + angular.dot(mean.spin);
      }
    }
  };

  std::array<std::array<Record, chunk_size>, cause_count> impulse_;
  std::array<std::uint8_t, chunk_size> received_{};
};

}  // namespace sazare::terms
