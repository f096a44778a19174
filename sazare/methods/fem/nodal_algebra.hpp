#pragma once

/// Sums and products of columns of numbers of nodes.

#include <algorithm>
#include <cmath>

#include "sazare/methods/fem/node_pattern.hpp"

namespace sazare::methods::fem {

/// Number of a degree of freedom: node by node, its axes in order.
template <int D>
std::size_t number(Index node, int axis) {
  return at(node) * D + static_cast<std::size_t>(axis);
}

inline Real dot(const NodalColumn& a, const NodalColumn& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

inline bool is_zero(const NodalColumn& a) {
  return std::ranges::all_of(a, [](Real value) { return value == 0; });
}

inline Real norm(const NodalColumn& a) { return std::sqrt(dot(a, a)); }

template <int D>
NodalColumn product(const BlockMatrix<D>& matrix, const NodalColumn& x) {
  NodalColumn result(x.size(), 0);
  matrix.multiply(x, 1, result);
  return result;
}

/// Adds numbers by node and axis of a few nodes.
template <int D>
void add_at(const std::vector<Index>& nodes, const Eigen::VectorXd& values, NodalColumn& to) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < D; ++axis) to[number<D>(nodes[i], axis)] += values[static_cast<Eigen::Index>(i) * D + axis];
}

template <int D>
Vector<D> sum_by_axis(const NodalColumn& column) {
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t i = 0; i < column.size(); ++i) sum[static_cast<int>(i % D)] += column[i];
  return sum;
}

/// to += factor from
inline void add(NodalColumn& to, Real factor, const NodalColumn& from) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * from[i];
}

}  // namespace sazare::methods::fem
