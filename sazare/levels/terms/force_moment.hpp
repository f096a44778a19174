#pragma once

/// Force and moment in one register.

#include "sazare/core/registers.hpp"
#include "sazare/core/rotation.hpp"

namespace sazare::terms {

/// What lies in the register beyond the numbers of both is anything, and is never written.
template <int D>
struct ForceMoment {
  static constexpr int count = D + angular_dimension<D>;
  static constexpr int width = D == 3 ? 8 : 4;
  using Register = RegisterOf<width>;
  using Reals = typename Register::Reals;

  Reals numbers{};

  /// Reads as many doubles as the register has.
  static ForceMoment load(const Real* from) { return {in(from)}; }
  /// For what is needed more than once: compilers would read it again each time.
  static ForceMoment load_once(const Real* from) {
    ForceMoment loaded = load(from);
    keep(loaded.numbers);
    return loaded;
  }
  static ForceMoment load(const float* from) { return {Register::template converted<count>(from)}; }

  /// Adds `factor` times another.
  void add(const Reals& factor, const ForceMoment& other) { numbers = Register::add_product(factor, other.numbers, numbers); }

  /// To as many numbers as the register has: force, moment, zeros.
  void store(Real* to) const { in(to) = first_of<count, width>(numbers); }
  void add_to(Real* to) const { in(to) += first_of<count, width>(numbers); }

private:
  using InMemory = typename Register::InMemory;

  static InMemory& in(Real* numbers) { return *reinterpret_cast<InMemory*>(numbers); }
  static const InMemory& in(const Real* numbers) { return *reinterpret_cast<const InMemory*>(numbers); }
};

}  // namespace sazare::terms
