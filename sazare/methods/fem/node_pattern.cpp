#include "sazare/methods/fem/node_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::fem {
namespace {

constexpr std::size_t serial_below = 2000;

}  // namespace

void NodeGroups::add(std::span<const Index> nodes) {
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  start_.push_back(nodes_.size());
}

NodePattern::NodePattern(std::size_t nodes, const NodeGroups& groups) {
  std::vector<std::vector<Index>> neighbors(nodes);
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (const Index node : groups.nodes(group)) {
      auto& list = neighbors[at(node)];
      list.insert(list.end(), groups.nodes(group).begin(), groups.nodes(group).end());
    }
  row_.push_back(0);
  for (std::size_t node = 0; node < nodes; ++node) {
    auto& list = neighbors[node];
    list.push_back(static_cast<Index>(node));
    std::ranges::sort(list);
    const auto repeated = std::ranges::unique(list);
    list.erase(repeated.begin(), repeated.end());
    column_.insert(column_.end(), list.begin(), list.end());
    row_.push_back(column_.size());
    list = {};
  }
}

std::size_t NodePattern::find(Index row, Index column) const {
  const auto begin = column_.begin() + static_cast<std::ptrdiff_t>(row_[at(row)]);
  const auto end = column_.begin() + static_cast<std::ptrdiff_t>(row_[at(row) + 1]);
  return static_cast<std::size_t>(std::lower_bound(begin, end, column) - column_.begin());
}

template <int D>
void BlockMatrix<D>::add(std::span<const Index> nodes, const Eigen::Ref<const Eigen::MatrixXd>& matrix, Real factor) {
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      Real* values = block(pattern_->find(nodes[a], nodes[b]));
      for (int i = 0; i < D; ++i)
        for (int k = 0; k < D; ++k)
          values[i * D + k] += factor * matrix(static_cast<Eigen::Index>(a) * D + i, static_cast<Eigen::Index>(b) * D + k);
    }
}

template <int D>
NodalColumn BlockMatrix<D>::magnitude_of_product(const NodalColumn& x) const {
  BlockMatrix magnitude(*pattern_);
  for (std::size_t i = 0; i < values_.size(); ++i) magnitude.values_[i] = std::abs(values_[i]);
  NodalColumn sizes(x.size()), result(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i) sizes[i] = std::abs(x[i]);
  magnitude.multiply(sizes, 1, result);
  return result;
}

template <int D>
void BlockMatrix<D>::multiply(const NodalColumn& x, Real factor, NodalColumn& result) const {
  parallel::parallel_for(pattern_->nodes(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      std::array<Real, D> sum{};
      for (std::size_t b = pattern_->row_begin(node); b < pattern_->row_end(node); ++b) {
        const Real* values = block(b);
        const Real* from = x.data() + at(pattern_->column(b)) * D;
        for (std::size_t i = 0; i < D; ++i)
          for (std::size_t k = 0; k < D; ++k) sum[i] += values[i * D + k] * from[k];
      }
      for (std::size_t i = 0; i < D; ++i) result[node * D + i] += factor * sum[i];
    }
  });
}

template <int D>
GroupBuffer<D>::GroupBuffer(const NodePattern& pattern, const NodeGroups& groups)
    : force_start_{0}, matrix_start_{0}, block_start_{0} {
  std::vector<std::vector<Member>> members(pattern.nodes());
  for (std::size_t group = 0; group < groups.size(); ++group) {
    const auto nodes = groups.nodes(group);
    const std::size_t freedoms = nodes.size() * D;
    force_start_.push_back(force_start_.back() + freedoms);
    matrix_start_.push_back(matrix_start_.back() + freedoms * freedoms);
    block_start_.push_back(block_start_.back() + nodes.size() * nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      members[at(nodes[a])].push_back({group, a});
      for (const Index b : nodes) block_.push_back(pattern.find(nodes[a], b));
    }
  }
  member_start_.push_back(0);
  for (std::size_t node = 0; node < members.size(); ++node) {
    if (members[node].empty()) continue;
    nodes_.push_back(static_cast<Index>(node));
    members_.insert(members_.end(), members[node].begin(), members[node].end());
    member_start_.push_back(members_.size());
  }
  forces_.assign(force_start_.back(), 0);
  matrices_.assign(matrix_start_.back(), 0);
}

template <int D>
void GroupBuffer<D>::gather_forces(NodalColumn& result) const {
  parallel::parallel_for(nodes_.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t m = member_start_[n]; m < member_start_[n + 1]; ++m) {
        const Real* from = forces_.data() + force_start_[members_[m].group] + members_[m].place * D;
        for (std::size_t i = 0; i < D; ++i) result[at(nodes_[n]) * D + i] += from[i];
      }
  });
}

template <int D>
void GroupBuffer<D>::gather_matrices(BlockMatrix<D>& result) const {
  parallel::parallel_for(nodes_.size(), serial_below / 10, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t m = member_start_[n]; m < member_start_[n + 1]; ++m) {
        const auto [group, place] = members_[m];
        const std::size_t freedoms = force_start_[group + 1] - force_start_[group], nodes = freedoms / D;
        const Real* from = matrices_.data() + matrix_start_[group] + place * D * freedoms;
        for (std::size_t b = 0; b < nodes; ++b) {
          Real* values = result.block(block_[block_start_[group] + place * nodes + b]);
          for (std::size_t i = 0; i < D; ++i)
            for (std::size_t k = 0; k < D; ++k) values[i * D + k] += from[i * freedoms + b * D + k];
        }
      }
  });
}

template class BlockMatrix<2>;
template class BlockMatrix<3>;
template class GroupBuffer<2>;
template class GroupBuffer<3>;

}  // namespace sazare::methods::fem
