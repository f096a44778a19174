#pragma once

/// Vectors that are added up without rounding, and how exact sums stand in a checkpoint.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/exact_sum.hpp"

namespace sazare {

/// A sum of vectors that does not depend on the order of what is added, nor on how it is shared out.
struct ExactVector {
  std::array<ExactSum, 3> axes{};

  ExactVector& operator+=(const Vector3& more) {
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis] += more[static_cast<Eigen::Index>(axis)];
    return *this;
  }
  ExactVector& operator+=(const ExactVector& more) {
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis] += more.axes[axis];
    return *this;
  }

  Vector3 value() const { return {axes[0].value(), axes[1].value(), axes[2].value()}; }
};

/// Numbers that add up to a sum exactly, the largest first: always the same ones, whatever was added. Of what is no number, one.
inline std::vector<Real> exact_parts(ExactSum sum) {
  std::vector<Real> parts;
  for (Real part = sum.value(); part != 0; part = sum.value()) {
    parts.push_back(part);
    if (std::isnan(part)) break;
    sum -= part;
  }
  return parts;
}

/// A column that holds all of an exact sum.
inline void exact_column(Archive& archive, const std::string& name, ExactSum& sum) {
  std::vector<Real> parts = exact_parts(sum);
  archive(name, parts);
  if (!archive.reading()) return;
  sum = {};
  for (const Real part : parts) sum += part;
}

}  // namespace sazare
