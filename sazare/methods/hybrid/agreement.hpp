#pragma once

/// Looks for a force that brings itself about: x = g(x), where g goes through a window with a force and finds the one that comes
/// of it. Each try is the one that would agree if g were linear in the last tries, as many as there are numbers (Anderson, J. ACM
/// 12 (1965) 547-560); so a linear coupling of n numbers needs n + 2 tries or fewer.

#include <Eigen/Core>

#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::methods::hybrid {

class Agreement {
public:
  /// What to try next, after `tried` has led to `found`.
  std::vector<Real> next(const std::vector<Real>& tried, const std::vector<Real>& found);

private:
  Eigen::MatrixXd tries_, gaps_;  ///< a column for each try: x, and g(x) - x
};

}  // namespace sazare::methods::hybrid
