#include "sazare/methods/fem/linear_solver.hpp"

#include <algorithm>
#include <cmath>

namespace sazare::methods::fem {
namespace {

constexpr Real singular_share = 1e-11;  // of a freedom's own stiffness before others are eliminated

}  // namespace

template <int D>
LinearSolver<D>::LinearSolver(const NodePattern& pattern, const Unknowns& unknowns, bool symmetric)
    : symmetric_(symmetric),
      turned_from_(unknowns.turned_from),
      turned_to_(unknowns.turned_to),
      number_(unknowns.is_free.size(), -1) {
  const auto leader = [&](std::size_t i) { return unknowns.leader.empty() ? i : unknowns.leader[i]; };
  for (std::size_t i = 0; i < number_.size(); ++i) {
    if (!unknowns.is_free[i] || leader(i) != i) continue;
    number_[i] = static_cast<int>(free_.size());
    free_.push_back(i);
  }
  for (std::size_t i = 0; i < number_.size(); ++i) number_[i] = number_[leader(i)];
  std::vector<int> start(free_.size() + 1, 0), row;
  const std::vector<Part> parts = find_parts(pattern);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (p == 0 || parts[p].column != parts[p - 1].column || parts[p].row != parts[p - 1].row) {
      row.push_back(parts[p].row);
      ++start[static_cast<std::size_t>(parts[p].column) + 1];
    }
    from_.push_back(parts[p].from);
    entry_.push_back(row.size() - 1);
  }
  for (std::size_t column = 0; column < free_.size(); ++column) start[column + 1] += start[column];
  const auto size = static_cast<Eigen::Index>(free_.size());
  const std::vector<Real> none(row.size(), 0);
  matrix_ = Eigen::Map<const Matrix>(size, size, static_cast<Eigen::Index>(row.size()), start.data(), row.data(), none.data());
  if (symmetric)
    cholesky_.analyzePattern(matrix_);
  else
    lu_.analyzePattern(matrix_);
}

/// Column by column with ascending rows: the pattern is symmetric, so a column's rows are the columns of its row. Freedoms that
/// are tied come out of order.
template <int D>
std::vector<typename LinearSolver<D>::Part> LinearSolver<D>::find_parts(const NodePattern& pattern) const {
  std::vector<Part> parts;
  for (std::size_t freedom = 0; freedom < number_.size(); ++freedom) {
    if (number_[freedom] < 0) continue;
    const std::size_t node = freedom / D, axis = freedom % D;
    for (std::size_t b = pattern.row_begin(node); b < pattern.row_end(node); ++b) {
      const auto other = static_cast<std::size_t>(pattern.column(b));
      const std::size_t block = pattern.find(static_cast<Index>(other), static_cast<Index>(node));
      for (std::size_t k = 0; k < D; ++k) {
        const int row = number_[other * D + k];
        if (row < 0 || (symmetric_ && row < number_[freedom])) continue;
        parts.push_back({number_[freedom], row, block * D * D + k * D + axis});
      }
    }
  }
  const auto place = [](const Part& part) { return std::pair(part.column, part.row); };
  if (!std::ranges::is_sorted(parts, {}, place)) std::ranges::stable_sort(parts, {}, place);
  return parts;
}

template <int D>
bool LinearSolver<D>::factorize(const std::vector<Real>& blocks) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), Real{0});
  for (std::size_t part = 0; part < from_.size(); ++part) {
    const auto row = static_cast<std::size_t>(matrix_.innerIndexPtr()[entry_[part]]);
    matrix_.valuePtr()[entry_[part]] += sign(free_[row]) * blocks[from_[part]];
  }
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
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free_.size()));
  for (std::size_t i = 0; i < right.size(); ++i)
    if (number_[i] >= 0) b[number_[i]] += sign(i) * right[i];
  NodalColumn result(right.size(), 0);
  if (free_.empty()) return result;
  const Eigen::VectorXd x = symmetric_ ? Eigen::VectorXd(cholesky_.solve(b)) : Eigen::VectorXd(lu_.solve(b));
  for (std::size_t i = 0; i < right.size(); ++i)
    if (number_[i] >= 0) result[i] = x[number_[i]];
  return result;
}

template class LinearSolver<2>;
template class LinearSolver<3>;

}  // namespace sazare::methods::fem
