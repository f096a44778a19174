#include "sazare/runs/studies/limit_regression.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <map>

namespace sazare::runs {

namespace {

constexpr Real slack = 1 + 1e-9;

Real quadratic(const std::array<Real, 3>& b, Real x) { return (b[0] * x + b[1]) * x + b[2]; }

/// Coefficients of the polynomial of this degree, highest power first.
template <int Terms>
Eigen::Matrix<Real, Terms, 1> fit_polynomial(const std::vector<Real>& x, const std::vector<Real>& y) {
  Eigen::Matrix<Real, Eigen::Dynamic, Terms> powers(static_cast<Eigen::Index>(x.size()), Terms);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int term = 0; term < Terms; ++term) powers(static_cast<Eigen::Index>(i), term) = std::pow(x[i], Terms - 1 - term);
  return powers.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size())));
}

}  // namespace

const LimitFit paper_shear_fit{{}, {0.264375, 1.621563, 2.540176}, {0.04089, 0.262491, 0.438239}};
const LimitFit paper_pressure_fit{{}, {0.304301, 1.666102, 2.614558}, {0.046261, 0.263985, 0.392512}};

Real LimitFit::predict(const LimitPoint& point) const {
  const Real x = std::log10(point.damping);
  const Real first = std::pow(10, quadratic(b1, x)), second = std::pow(10, quadratic(b2, x));
  return first * std::pow(point.radius / point.velocity, second);
}

Real log_error(const LimitFit& fit, std::span<const LimitPoint> points, Real most) {
  Real sum = 0, count = 0;
  for (const LimitPoint& point : points) {
    if (point.damping > most * slack) continue;
    const Real ratio = std::log(fit.predict(point) / point.limit);
    sum += ratio * ratio;
    ++count;
  }
  return std::sqrt(sum / count);
}

LimitFit fit_limits(std::span<const LimitPoint> points, Real most) {
  std::map<Real, std::vector<const LimitPoint*>> groups;
  for (const LimitPoint& point : points) groups[point.damping].push_back(&point);
  LimitFit fit;
  std::vector<Real> x, log_a1, log_a2;
  for (const auto& [damping, members] : groups) {
    std::vector<Real> ratio, limit;
    for (const LimitPoint* point : members) {
      ratio.push_back(std::log10(point->radius / point->velocity));
      limit.push_back(std::log10(point->limit));
    }
    const auto line = fit_polynomial<2>(ratio, limit);
    fit.by_damping.push_back({damping, std::pow(10, line[1]), line[0]});
    if (damping > most * slack) continue;
    x.push_back(std::log10(damping));
    log_a1.push_back(line[1]);
    log_a2.push_back(std::log10(line[0]));
  }
  const auto first = fit_polynomial<3>(x, log_a1), second = fit_polynomial<3>(x, log_a2);
  for (int i = 0; i < 3; ++i) {
    fit.b1[static_cast<std::size_t>(i)] = first[i];
    fit.b2[static_cast<std::size_t>(i)] = second[i];
  }
  return fit;
}

}  // namespace sazare::runs
