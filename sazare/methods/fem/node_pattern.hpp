#pragma once

/// Which nodes act on which, and matrices of D x D blocks on that pattern.

#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::methods::fem {

/// D numbers of every node, node by node.
using NodalColumn = std::vector<Real>;

/// Groups of nodes that act on each other: the elements, and the joints.
class NodeGroups {
public:
  void add(std::span<const Index> nodes);

  std::size_t size() const { return start_.size() - 1; }
  std::span<const Index> nodes(std::size_t group) const {
    return {nodes_.data() + start_[group], start_[group + 1] - start_[group]};
  }

private:
  std::vector<std::size_t> start_ = {0};
  std::vector<Index> nodes_;
};

/// Rows of blocks in the order of the nodes; within a row by ascending node. Symmetric.
class NodePattern {
public:
  NodePattern(std::size_t nodes, const NodeGroups& groups);

  std::size_t nodes() const { return row_.size() - 1; }
  std::size_t blocks() const { return column_.size(); }
  std::size_t row_begin(std::size_t node) const { return row_[node]; }
  std::size_t row_end(std::size_t node) const { return row_[node + 1]; }
  Index column(std::size_t block) const { return column_[block]; }
  /// The block of a row and a column that are in it.
  std::size_t find(Index row, Index column) const;

private:
  std::vector<std::size_t> row_;
  std::vector<Index> column_;
};

/// Numbers of D x D blocks by rows. Bits do not depend on the number of threads.
template <int D>
class BlockMatrix {
public:
  explicit BlockMatrix(const NodePattern& pattern) : pattern_(&pattern), values_(pattern.blocks() * D * D, 0) {}

  const NodePattern& pattern() const { return *pattern_; }
  std::vector<Real>& values() { return values_; }
  const std::vector<Real>& values() const { return values_; }
  Real* block(std::size_t number) { return values_.data() + number * D * D; }
  const Real* block(std::size_t number) const { return values_.data() + number * D * D; }

  /// Adds a dense matrix of a group, rows and columns by its nodes and axes.
  void add(std::span<const Index> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix, Real factor = 1);

  /// result += factor * this * x.
  void multiply(const NodalColumn& x, Real factor, NodalColumn& result) const;
  /// The same product with all numbers positive: what cancels in it is no larger.
  NodalColumn magnitude_of_product(const NodalColumn& x) const;

private:
  const NodePattern* pattern_;
  std::vector<Real> values_;
};

/// Dense matrices and forces of groups that change from step to step: each writes its own place, rows gather theirs in a fixed
/// order.
template <int D>
class GroupBuffer {
public:
  GroupBuffer(const NodePattern& pattern, const NodeGroups& groups);

  std::size_t groups() const { return matrix_start_.size() - 1; }
  std::span<Real> force(std::size_t group) {
    return {forces_.data() + force_start_[group], force_start_[group + 1] - force_start_[group]};
  }
  /// By rows.
  std::span<Real> matrix(std::size_t group) {
    return {matrices_.data() + matrix_start_[group], matrix_start_[group + 1] - matrix_start_[group]};
  }

  /// Adds all forces.
  void gather_forces(NodalColumn& result) const;
  /// Adds all matrices.
  void gather_matrices(BlockMatrix<D>& result) const;

private:
  struct Member {
    std::size_t group = 0;
    std::size_t place = 0;  ///< of the node in the group
  };

  std::vector<std::size_t> force_start_, matrix_start_, block_start_;
  std::vector<std::size_t> block_;  ///< of the pattern, by group, row and column
  std::vector<Index> nodes_;        ///< that are in groups
  std::vector<std::size_t> member_start_;
  std::vector<Member> members_;
  std::vector<Real> forces_, matrices_;
};

extern template class BlockMatrix<2>;
extern template class BlockMatrix<3>;
extern template class GroupBuffer<2>;
extern template class GroupBuffer<3>;

}  // namespace sazare::methods::fem
