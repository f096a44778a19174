#include "sazare/methods/hybrid/agreement.hpp"

#include <Eigen/QR>

#include <algorithm>

namespace sazare::methods::hybrid {

namespace {

constexpr Real least_share = 1e-9;  // of the largest change: those that add less are left out

Eigen::VectorXd column(const std::vector<Real>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Adds the newest column and drops the oldest where there are as many columns as rows: these describe a linear coupling fully.
void keep(Eigen::MatrixXd& columns, const Eigen::VectorXd& newest) {
  const Eigen::Index kept = std::min(columns.cols(), newest.size() - 1);
  const Eigen::MatrixXd old = columns.rightCols(kept);
  columns.resize(newest.size(), kept + 1);
  if (kept > 0) columns.leftCols(kept) = old;  // at first there are none, not even empty ones of this height
  columns.rightCols(1) = newest;
}

}  // namespace

std::vector<Real> Agreement::next(const std::vector<Real>& tried, const std::vector<Real>& found) {
  const Eigen::VectorXd x = column(tried), gap = column(found) - x;
  Eigen::VectorXd better = x + gap;
  if (tries_.cols() > 0) {
    const Eigen::MatrixXd changes = gaps_.colwise() - gap, moves = tries_.colwise() - x;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(changes);
    solver.setThreshold(least_share);
    better -= (moves + changes) * solver.solve(gap);
  }
  keep(tries_, x);
  keep(gaps_, gap);
  return {better.data(), better.data() + better.size()};
}

}  // namespace sazare::methods::hybrid
