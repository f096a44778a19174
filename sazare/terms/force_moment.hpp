#pragma once

/// Force and moment on one body, in a register each.

#include "sazare/core/registers.hpp"
#include "sazare/core/rotation.hpp"

namespace sazare::terms {

/// Read four numbers at a time: what lies beyond those of a force or a moment is anything, and is never written.
template <int D>
struct ForceMoment {
  using Register = RegisterOf<4>::Reals;

  Register force{}, moment{};

  static ForceMoment load(const Real* force, const Real* moment) { return {four(force), four(moment)}; }
  static ForceMoment load(const float* force, const float* moment) {
    return {RegisterOf<4>::converted(force), RegisterOf<4>::converted(moment)};
  }

  /// Adds `factor` times another, whose force acts along `sign`.
  void add(const Register& factor, const Register& sign, const ForceMoment& other) {
    force = RegisterOf<4>::add_product(sign * factor, other.force, force);
    moment = RegisterOf<4>::add_product(factor, other.moment, moment);
  }

  /// To eight numbers, in the plane to four: force, moment, zeros.
  void store(Real* numbers) const {
    four(numbers) = head();
    if constexpr (D == 3) four(numbers + 4) = tail();
  }
  void add_to(Real* numbers) const {
    four(numbers) += head();
    if constexpr (D == 3) four(numbers + 4) += tail();
  }

private:
  using InMemory = RegisterOf<4>::InMemory;

  static InMemory& four(Real* numbers) { return *reinterpret_cast<InMemory*>(numbers); }
  static const InMemory& four(const Real* numbers) { return *reinterpret_cast<const InMemory*>(numbers); }

  // Side by side in registers: stores that overlap would be waited for by whoever loads them next.
  Register head() const {
    if constexpr (D == 3) return __builtin_shufflevector(force, moment, 0, 1, 2, 4);
    return __builtin_shufflevector(force, __builtin_shufflevector(moment, Register{}, 0, 4, 4, 4), 0, 1, 4, 5);
  }
  Register tail() const { return __builtin_shufflevector(moment, Register{}, 1, 2, 4, 4); }
};

}  // namespace sazare::terms
