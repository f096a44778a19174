#include "sazare/geometry/ball_members.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sazare::geometry {

namespace {

using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr Real least_cell = 0.01;     // of the ball's own volume: a ball that others hide has some mass
constexpr Real least_share = 0.1;     // of the cell's volume
constexpr Real least_inertia = 0.05;  // of that of full balls

/// Where a line parallel to z meets a ball: the middle and the squared half length.
struct Chord {
  std::size_t ball;
  Real middle, square;
};

/// How much of a line lies in the cell of one of the balls it meets. Powers differ by a straight line along it, so that every
/// other ball cuts one end off.
Real length_in_cell(const Chord& own, std::span<const Chord> all) {
  Real low = own.middle - std::sqrt(own.square), high = own.middle + std::sqrt(own.square);
  for (const Chord& other : all) {
    if (other.ball == own.ball) continue;
    // The other one is nearer where 2 z (other.middle - own.middle) > difference.
    const Real difference = (other.middle * other.middle - own.middle * own.middle) + (own.square - other.square);
    const Real apart = 2 * (other.middle - own.middle);
    if (apart > 0) high = std::min(high, difference / apart);
    if (apart < 0) low = std::max(low, difference / apart);
    if (apart == 0 && (difference < 0 || (difference == 0 && other.ball < own.ball))) return 0;
  }
  return std::max(high - low, Real{0});
}

/// The shortest y with rows y = wanted, or as nearly as can be. Of combinations of rows that hardly differ from nothing, as
/// against `scale`, none is asked for.
Vector shortest(const Matrix& rows, const Vector& wanted, Real scale) {
  constexpr Real nothing = 1e-10;
  const Eigen::SelfAdjointEigenSolver<Matrix> gram(rows * rows.transpose());
  Vector along = gram.eigenvectors().transpose() * wanted;
  for (Eigen::Index n = 0; n < along.size(); ++n) {
    const Real square = gram.eigenvalues()[n];
    along[n] = square > nothing * scale ? along[n] / square : 0;
  }
  return rows.transpose() * (gram.eigenvectors() * along);
}

/// Second moments of a body of these principal inertias about its axes: integrals of x^2, y^2, z^2.
Vector3 second_moments(const Vector3& inertia) { return Vector3::Constant(0.5 * inertia.sum()) - inertia; }

/// Volume and first moments of balls by their shares, and five second moments that inertias of the balls do not change.
struct Moments {
  Matrix first{4, 0}, second{5, 0};
  Vector wanted_first{4}, wanted_second{5};

  Moments(std::span<const Ball> balls, Real length, Real volume, const Vector3& inertia) {
    const auto count = static_cast<Eigen::Index>(balls.size());
    first.resize(4, count);
    second.resize(5, count);
    for (Eigen::Index n = 0; n < count; ++n) {
      const Vector3 x = balls[static_cast<std::size_t>(n)].centre / length;
      first.col(n) << 1, x;
      second.col(n) << x.x() * x.y(), x.y() * x.z(), x.z() * x.x(), x.x() * x.x() - x.y() * x.y(),
          x.x() * x.x() + x.y() * x.y() - 2 * x.z() * x.z();
    }
    const Vector3 of = second_moments(inertia) / (length * length);
    wanted_first << volume, 0, 0, 0;
    wanted_second << 0, 0, 0, of.x() - of.y(), of.x() + of.y() - 2 * of.z();
  }
};

/// Volumes near those of the cells that have the moments wanted; the second ones as far as volumes stay positive.
Vector balanced(const Moments& moments, const Vector& cells) {
  // The change is measured over the square root of the cell, so that small balls change little.
  const Vector roots = cells.cwiseSqrt();
  const Matrix first = moments.first * roots.asDiagonal(), second = moments.second * roots.asDiagonal();
  const Real scale = first.squaredNorm(), second_scale = second.squaredNorm();
  const Vector change = shortest(first, moments.wanted_first - moments.first * cells, scale);
  Matrix free = second;  // what the second moments ask for without touching the first ones
  for (Eigen::Index row = 0; row < free.rows(); ++row)
    free.row(row) -= shortest(first, first * second.row(row).transpose(), scale).transpose();
  const Vector more = shortest(free, moments.wanted_second - moments.second * cells - second * change, second_scale);
  const Vector base = cells + roots.cwiseProduct(change), further = roots.cwiseProduct(more);
  Real share = 1;
  for (Eigen::Index n = 0; n < cells.size(); ++n)
    if (const Real least = least_share * cells[n]; base[n] + further[n] < least)
      share = std::min(share, std::max((base[n] - least) / -further[n], Real{0}));
  return base + share * further;
}

}  // namespace

std::vector<Real> cell_volumes(std::span<const Ball> balls, int lines) {
  Vector3 lower = balls.front().centre, upper = lower;
  for (const Ball& ball : balls) {
    lower = lower.cwiseMin(ball.centre - Vector3::Constant(ball.radius));
    upper = upper.cwiseMax(ball.centre + Vector3::Constant(ball.radius));
  }
  const Real width = std::max(upper.x() - lower.x(), upper.y() - lower.y()) / lines;
  std::vector<Real> volumes(balls.size(), 0);
  std::vector<Chord> chords;
  for (Real x = lower.x() + 0.5 * width; x < upper.x(); x += width)
    for (Real y = lower.y() + 0.5 * width; y < upper.y(); y += width) {
      chords.clear();
      for (std::size_t n = 0; n < balls.size(); ++n) {
        const Real dx = x - balls[n].centre.x(), dy = y - balls[n].centre.y(),
                   square = balls[n].radius * balls[n].radius - dx * dx - dy * dy;
        if (square > 0) chords.push_back({n, balls[n].centre.z(), square});
      }
      for (const Chord& chord : chords) volumes[chord.ball] += width * width * length_in_cell(chord, chords);
    }
  return volumes;
}

MassShares share_mass(std::span<const Ball> balls, Real volume, const Vector3& inertia) {
  const std::vector<Real> volumes = cell_volumes(balls);
  Vector cells(static_cast<Eigen::Index>(balls.size()));
  Real length = 0;
  for (std::size_t n = 0; n < balls.size(); ++n) {
    const Real own = 4 * std::numbers::pi / 3 * std::pow(balls[n].radius, 3);
    cells[static_cast<Eigen::Index>(n)] = std::max(volumes[n], least_cell * own);
    length = std::max(length, balls[n].centre.norm() + balls[n].radius);
  }
  cells *= volume / cells.sum();
  const Vector shared = balanced(Moments(balls, length, volume, inertia), cells);
  MassShares shares;
  if (!(shared.minCoeff() > 0)) return shares;
  Matrix3 second = Matrix3::Zero();
  Real full = 0;
  for (std::size_t n = 0; n < balls.size(); ++n) {
    const Real part = shared[static_cast<Eigen::Index>(n)];
    second += part * balls[n].centre * balls[n].centre.transpose();
    full += 0.4 * part * balls[n].radius * balls[n].radius;
  }
  const Real own = std::max((inertia.sum() - 2 * second.trace()) / 3, least_inertia * full);
  for (std::size_t n = 0; n < balls.size(); ++n) {
    const Real part = shared[static_cast<Eigen::Index>(n)];
    shares.of.push_back({part, own * 0.4 * part * balls[n].radius * balls[n].radius / full});
  }
  const Matrix3 together = (second.trace() + own) * Matrix3::Identity() - second;
  shares.error = (together - Matrix3(inertia.asDiagonal())).norm() / inertia.norm();
  return shares;
}

std::vector<std::pair<Index, Index>> neighbouring_balls(std::span<const Ball> balls, Real reach) {
  constexpr Real rounding = 1e-9;
  std::vector<std::vector<std::size_t>> touching(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = 0; j < balls.size(); ++j) {
      const Real radii = balls[i].radius + balls[j].radius;
      if (i != j && (balls[i].centre - balls[j].centre).norm() <= (1 + reach + rounding) * radii) touching[i].push_back(j);
    }
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (const std::size_t j : touching[i]) {
      if (j < i) continue;
      const Real square = (balls[j].centre - balls[i].centre).squaredNorm();
      const bool parted = std::ranges::any_of(touching[i], [&](std::size_t k) {
        const Vector3 &between = balls[k].centre, first = balls[i].centre - between, second = balls[j].centre - between;
        return k != j && first.dot(second) < rounding * square && std::ranges::binary_search(touching[k], j);
      });
      if (!parted) pairs.emplace_back(static_cast<Index>(i), static_cast<Index>(j));
    }
  return pairs;
}

std::vector<bool> joined_to_first(std::size_t balls, std::span<const std::pair<Index, Index>> pairs) {
  std::vector<std::size_t> set(balls);
  for (std::size_t n = 0; n < balls; ++n) set[n] = n;
  const auto root = [&](std::size_t n) {
    while (set[n] != n) n = set[n] = set[set[n]];
    return n;
  };
  for (const auto& [first, second] : pairs) {
    const std::size_t one = root(static_cast<std::size_t>(first)), other = root(static_cast<std::size_t>(second));
    set[std::max(one, other)] = std::min(one, other);
  }
  std::vector<bool> joined(balls);
  for (std::size_t n = 0; n < balls; ++n) joined[n] = root(n) == 0;
  return joined;
}

bool hang_together(std::size_t balls, std::span<const std::pair<Index, Index>> pairs) {
  return std::ranges::count(joined_to_first(balls, pairs), false) == 0;
}

}  // namespace sazare::geometry
