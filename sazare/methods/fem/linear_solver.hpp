#pragma once

/// Solves for the free degrees of freedom with a sparse direct factorization of Eigen.

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <limits>
#include <optional>

#include "sazare/methods/fem/node_pattern.hpp"

namespace sazare::methods::fem {

/// A number of a nodal column: node and axis.
struct Freedom {
  Index node = 0;
  int axis = 0;
};

template <int D>
class LinearSolver {
public:
  /// `is_free` by number of a nodal column. A matrix that is not symmetric needs the slower factorization. The rows of nodes from
  /// `turned_from` on change their sign: where that makes the matrix symmetric, as with water in the pores, it has a
  /// factorization without pivots, being positive definite in the other rows and negative definite in these. Vanderbei, SIAM J.
  /// Optim. 5 (1995) 100-113.
  LinearSolver(const NodePattern& pattern, const std::vector<char>& is_free, bool symmetric,
               std::size_t turned_from = std::numeric_limits<std::size_t>::max());

  /// Factorizes the matrix of blocks on the pattern; returns false where it is singular.
  bool factorize(const std::vector<Real>& blocks);

  /// `right` and the result are nodal columns; what is not free is not looked at, and 0 in the result.
  NodalColumn solve(const NodalColumn& right) const;

  /// Where the symmetric factorization met a freedom without stiffness of its own, once those before it are eliminated.
  const std::optional<Freedom>& singular() const { return singular_; }

  std::size_t freedoms() const { return free_.size(); }

private:
  using Matrix = Eigen::SparseMatrix<Real>;

  bool look_for_singular_freedom();

  /// -1 in rows that change their sign.
  Real sign(std::size_t freedom) const { return freedom / D < turned_from_ ? 1 : -1; }

  bool symmetric_;
  std::size_t turned_from_;
  std::vector<std::size_t> free_;  ///< numbers of a nodal column
  std::vector<std::size_t> from_;  ///< number among the blocks, by entry of the matrix
  Matrix matrix_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> cholesky_;
  Eigen::SparseLU<Matrix> lu_;
  std::optional<Freedom> singular_;
};

extern template class LinearSolver<2>;
extern template class LinearSolver<3>;

}  // namespace sazare::methods::fem
