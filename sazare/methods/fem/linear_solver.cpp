#include "sazare/methods/fem/linear_solver.hpp"

#include <cmath>

namespace sazare::methods::fem {
namespace {

constexpr Real singular_share = 1e-11;  // of a freedom's own stiffness before others are eliminated

}  // namespace

template <int D>
LinearSolver<D>::LinearSolver(const NodePattern& pattern, const std::vector<char>& is_free, bool symmetric,
                              std::size_t turned_from)
    : symmetric_(symmetric), turned_from_(turned_from) {
  std::vector<int> number(is_free.size(), -1);
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    if (!is_free[i]) continue;
    number[i] = static_cast<int>(free_.size());
    free_.push_back(i);
  }
  // Column by column with ascending rows: the pattern is symmetric, so a column's rows are the columns of its row.
  std::vector<int> start = {0}, row;
  for (const std::size_t freedom : free_) {
    const std::size_t node = freedom / D, axis = freedom % D;
    for (std::size_t b = pattern.row_begin(node); b < pattern.row_end(node); ++b) {
      const auto other = static_cast<std::size_t>(pattern.column(b));
      const std::size_t block = pattern.find(static_cast<Index>(other), static_cast<Index>(node));
      for (std::size_t k = 0; k < D; ++k) {
        const int place = number[other * D + k];
        if (place < 0 || (symmetric && place < number[freedom])) continue;
        row.push_back(place);
        from_.push_back(block * D * D + k * D + axis);
      }
    }
    start.push_back(static_cast<int>(row.size()));
  }
  const auto size = static_cast<Eigen::Index>(free_.size());
  const std::vector<Real> none(row.size(), 0);
  matrix_ = Eigen::Map<const Matrix>(size, size, static_cast<Eigen::Index>(row.size()), start.data(), row.data(), none.data());
  if (symmetric)
    cholesky_.analyzePattern(matrix_);
  else
    lu_.analyzePattern(matrix_);
}

template <int D>
bool LinearSolver<D>::factorize(const std::vector<Real>& blocks) {
  for (std::size_t i = 0; i < from_.size(); ++i)
    matrix_.valuePtr()[i] = sign(free_[static_cast<std::size_t>(matrix_.innerIndexPtr()[i])]) * blocks[from_[i]];
  if (free_.empty()) return true;
  if (!symmetric_) {
    lu_.factorize(matrix_);
    return lu_.info() == Eigen::Success;
  }
  cholesky_.factorize(matrix_);
  return cholesky_.info() == Eigen::Success ? !look_for_singular_freedom() : (look_for_singular_freedom(), false);
}

/// The pivots stand in the order of elimination.
template <int D>
bool LinearSolver<D>::look_for_singular_freedom() {
  singular_.reset();
  const Eigen::VectorXd pivots = cholesky_.vectorD();
  const auto& place = cholesky_.permutationP().indices();
  const Eigen::VectorXd own = matrix_.diagonal();
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    if (std::abs(pivots[place[i]]) > singular_share * std::abs(own[i])) continue;
    const std::size_t freedom = free_[static_cast<std::size_t>(i)];
    singular_ = Freedom{static_cast<Index>(freedom / D), static_cast<int>(freedom % D)};
    return true;
  }
  return false;
}

template <int D>
NodalColumn LinearSolver<D>::solve(const NodalColumn& right) const {
  Eigen::VectorXd b(static_cast<Eigen::Index>(free_.size()));
  for (std::size_t i = 0; i < free_.size(); ++i) b[static_cast<Eigen::Index>(i)] = sign(free_[i]) * right[free_[i]];
  NodalColumn result(right.size(), 0);
  if (free_.empty()) return result;
  const Eigen::VectorXd x = symmetric_ ? Eigen::VectorXd(cholesky_.solve(b)) : Eigen::VectorXd(lu_.solve(b));
  for (std::size_t i = 0; i < free_.size(); ++i) result[free_[i]] = x[static_cast<Eigen::Index>(i)];
  return result;
}

template class LinearSolver<2>;
template class LinearSolver<3>;

}  // namespace sazare::methods::fem
