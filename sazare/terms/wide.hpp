#pragma once

/// Force and moment on one body side by side, as wide as registers are.

#include <algorithm>
#include <array>
#include <cstddef>

#include "sazare/core/lanes.hpp"

namespace sazare::terms {

using InTwo = std::array<RegisterOf<4>::Reals, 2>;
using InOne = std::array<RegisterOf<8>::Reals, 1>;
using InPlane = std::array<RegisterOf<4>::Reals, 1>;

inline InOne join_registers(const InOne& first, const InOne& second) {
  constexpr RegisterOf<8>::Reals none{}, sign = {-1, -1, -1, 1, 1, 1, 0, 0};
  return {__builtin_shufflevector(second[0], none, 0, 1, 2, 3, 4, 5, 8, 8) +
          sign * __builtin_shufflevector(first[0], none, 3, 4, 5, 0, 1, 2, 8, 8)};
}
inline InTwo join_registers(const InTwo& first, const InTwo& second) {
  constexpr RegisterOf<4>::Reals none{}, sign = {-1, -1, -1, 1};
  return {second[0] + sign * __builtin_shufflevector(first[0], first[1], 3, 4, 5, 0),
          __builtin_shufflevector(second[1], none, 0, 1, 4, 4) + __builtin_shufflevector(first[0], none, 1, 2, 4, 4)};
}
inline InPlane join_registers(const InPlane& first, const InPlane& second) {
  constexpr RegisterOf<4>::Reals none{}, sign = {-1, -1, 1, 0};
  return {__builtin_shufflevector(second[0], none, 0, 1, 2, 4) + sign * __builtin_shufflevector(first[0], none, 1, 2, 0, 4)};
}

/// Eight numbers in space, four in the plane: those of a force and a moment, and what follows them. In one register, or in two
/// where a register holds four: a compiler that is to make eight of four does so number by number.
template <int D>
struct Wide {
  static constexpr int numbers = D == 3 ? 8 : 4;
  static constexpr int width = std::min(numbers, lane_count);
  static constexpr std::size_t registers = numbers / width;
  using Register = typename RegisterOf<width>::Reals;

  std::array<Register, registers> part{};

  static Register broadcast(Real value) { return RegisterOf<width>::broadcast(value); }

  static Wide load(const Real* from) {
    Wide loaded;
    for (std::size_t i = 0; i < registers; ++i)
      loaded.part[i] = *reinterpret_cast<const typename RegisterOf<width>::InMemory*>(from + i * width);
    return loaded;
  }
  static Wide load(const float* from) {
    Wide loaded;
    for (std::size_t i = 0; i < registers; ++i) loaded.part[i] = RegisterOf<width>::converted(from + i * width);
    return loaded;
  }
  void store(Real* to) const {
    for (std::size_t i = 0; i < registers; ++i)
      *reinterpret_cast<typename RegisterOf<width>::InMemory*>(to + i * width) = part[i];
  }
  void add_to(Real* sum) const { (load(sum) += *this).store(sum); }

  Wide& operator+=(const Wide& other) {
    for (std::size_t i = 0; i < registers; ++i) part[i] += other.part[i];
    return *this;
  }
  Wide& operator-=(const Wide& other) {
    for (std::size_t i = 0; i < registers; ++i) part[i] -= other.part[i];
    return *this;
  }
  friend Wide operator-(Wide a, const Wide& b) { return a -= b; }
  template <class Mask>
  friend Wide select(const Mask& mask, const Wide& yes, const Wide& no) {
    Wide chosen;
    for (std::size_t i = 0; i < registers; ++i) chosen.part[i] = mask ? yes.part[i] : no.part[i];
    return chosen;
  }
  friend Wide operator*(const Register& factor, const Wide& a) {
    Wide product;
    for (std::size_t i = 0; i < registers; ++i) product.part[i] = factor * a.part[i];
    return product;
  }
};

/// Force and moment on a body, then zeros: what it is as the second of its pairs (force, moment), and what it is as the first
/// (moment, then minus the force).
template <int D>
Wide<D> join(const Wide<D>& first, const Wide<D>& second) {
  return {join_registers(first.part, second.part)};
}

}  // namespace sazare::terms
