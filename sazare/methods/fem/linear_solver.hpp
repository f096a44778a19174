#pragma once

/// Solves for the free degrees of freedom with a sparse direct factorization of Eigen.

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
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
  /// What is unknown, by number of a nodal column.
  struct Unknowns {
    std::vector<char> is_free;
    std::vector<std::size_t> leader;  ///< whose value a freedom takes, its own number where it is nobody's; empty: no ties
    /// The rows of nodes from the first of these numbers up to the second change their sign: where that makes the matrix
    /// symmetric, as with water in the pores, it has a factorization without pivots, being positive definite in the other rows
    /// and negative definite in these. Vanderbei, SIAM J. Optim. 5 (1995) 100-113.
    std::size_t turned_from = 0, turned_to = 0;
  };

  /// A matrix that is not symmetric needs the slower factorization.
  LinearSolver(const NodePattern& pattern, const Unknowns& unknowns, bool symmetric);

  /// Factorizes the matrix of blocks on the pattern; returns false where it is singular.
  bool factorize(const std::vector<Real>& blocks);

  /// `right` and the result are nodal columns; what is not free is not looked at, and 0 in the result. Freedoms that are tied
  /// have one equation, the sum of theirs, and one result.
  NodalColumn solve(const NodalColumn& right) const;

  /// Where the symmetric factorization met a freedom without stiffness of its own, once those before it are eliminated.
  const std::optional<Freedom>& singular() const { return singular_; }

  /// How many numbers are unknown, and whether a number of a nodal column is one, or is tied to one.
  std::size_t freedoms() const { return free_.size(); }
  bool is_unknown(std::size_t number) const { return number_[number] >= 0; }

private:
  using Matrix = Eigen::SparseMatrix<Real>;

  /// A number of the blocks that is added to an entry of the matrix.
  struct Part {
    int column = 0, row = 0;
    std::size_t from = 0;
  };

  std::vector<Part> find_parts(const NodePattern& pattern) const;
  bool look_for_singular_freedom();
  /// -1 in rows that change their sign.
  Real sign(std::size_t freedom) const { return freedom / D < turned_from_ || freedom / D >= turned_to_ ? 1 : -1; }

  bool symmetric_;
  std::size_t turned_from_, turned_to_;
  std::vector<int> number_;         ///< of the unknown, by number of a nodal column; -1 where there is none
  std::vector<std::size_t> free_;   ///< numbers of a nodal column, by unknown: leaders
  std::vector<std::size_t> from_;   ///< number among the blocks, by part
  std::vector<std::size_t> entry_;  ///< of the matrix, by part
  Matrix matrix_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> cholesky_;
  Eigen::SparseLU<Matrix> lu_;
  std::optional<Freedom> singular_;
};

extern template class LinearSolver<2>;
extern template class LinearSolver<3>;

}  // namespace sazare::methods::fem
