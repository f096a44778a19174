#include "validation/papers/pseudo-rectangle/figure-10/lattice.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <vector>

namespace sazare::validation {

namespace {

using Row = Eigen::Matrix<Real, 6, 1>;

struct Link {
  int first = 0, second = 0, axis = 0;
};

std::vector<Link> links_of(const LatticeBeam& beam) {
  std::vector<Link> links;
  for (int row = 0; row < beam.rows; ++row)
    for (int column = 0; column < beam.columns; ++column) {
      const int own = row * beam.columns + column;
      if (column + 1 < beam.columns) links.push_back({own, own + 1, 0});
      if (row + 1 < beam.rows) links.push_back({own, own + beam.columns, 1});
    }
  return links;
}

/// Closing of the normal spring at xi, and shear, of the motions (x, y, turn) of both elements.
std::array<Row, 2> rows_of(const Link& link, Real half, Real xi) {
  const Vector<2> n = link.axis == 0 ? Vector<2>(1, 0) : Vector<2>(0, 1), s(n.y(), -n.x());
  Row closing, shear;
  closing << n.x(), n.y(), half * xi, -n.x(), -n.y(), -half * xi;
  shear << s.x(), s.y(), -half, -s.x(), -s.y(), -half;
  return {closing, shear};
}

std::array<int, 6> freedoms_of(const Link& link) {
  return {3 * link.first, 3 * link.first + 1, 3 * link.first + 2, 3 * link.second, 3 * link.second + 1, 3 * link.second + 2};
}

std::vector<Real> places_of(const LatticeBeam& beam) {
  if (beam.ends) return {-1, 1};
  std::vector<Real> places;
  for (int i = 0; i < beam.springs; ++i) places.push_back((2.0 * i + 1 - beam.springs) / beam.springs);
  return places;
}

}  // namespace

Real load_at_first_break(const LatticeBeam& beam, Real strength) {
  const std::vector<Link> links = links_of(beam);
  const std::vector<Real> places = places_of(beam);
  const Real half = 0.5 * beam.size, area = beam.size * beam.thickness / static_cast<Real>(places.size());
  const Real normal = beam.normal_stiffness * area / beam.size, shear = beam.shear_stiffness * area / beam.size;
  const int n = 3 * beam.rows * beam.columns;
  std::vector<Eigen::Triplet<Real>> entries;
  for (const Link& link : links) {
    Eigen::Matrix<Real, 6, 6> own = Eigen::Matrix<Real, 6, 6>::Zero();
    for (const Real xi : places) {
      const auto [closing, sliding] = rows_of(link, half, xi);
      own += normal * closing * closing.transpose() + shear * sliding * sliding.transpose();
    }
    const auto at = freedoms_of(link);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        entries.emplace_back(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)], own(i, j));
  }
  // Supports as springs a million times as stiff as a face; the beam is held along itself at one place.
  const Real held = 1e6 * normal * static_cast<Real>(places.size());
  for (const int column : {beam.support, beam.columns - 1 - beam.support})
    entries.emplace_back(3 * column + 1, 3 * column + 1, held);
  entries.emplace_back(3 * beam.support, 3 * beam.support, held);
  Eigen::SparseMatrix<Real> stiffness(n, n);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
  for (const int column : {beam.load, beam.columns - 1 - beam.load})
    load[3 * ((beam.rows - 1) * beam.columns + column) + 1] = -0.5;
  const Eigen::VectorXd moved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>>(stiffness).solve(load);
  Real most = 0;
  for (const Link& link : links)
    for (const Real xi : places) {
      Row own;
      const auto at = freedoms_of(link);
      for (int i = 0; i < 6; ++i) own[i] = moved[at[static_cast<std::size_t>(i)]];
      most = std::max(most, -normal * rows_of(link, half, xi)[0].dot(own) / area);
    }
  return strength / most;
}

}  // namespace sazare::validation
