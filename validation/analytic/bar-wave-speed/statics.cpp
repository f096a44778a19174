#include "validation/analytic/bar-wave-speed/statics.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::validation {

namespace {

using Column = Eigen::VectorXd;
using Moves = Eigen::Matrix<Real, 3, 6>;

struct Block {
  Vector3 centre;
  Real volume = 0;
};

std::vector<Block> blocks_of(const geometry::TetraMesh& mesh) {
  std::vector<Block> blocks;
  for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh.tetrahedra.size()); ++e) {
    const auto corners = geometry::corners_of(mesh, e);
    blocks.push_back({geometry::centroid(corners), geometry::volume(corners)});
  }
  return blocks;
}

/// Displacement of a point from the six freedoms of its block.
Moves moves(const Vector3& arm) {
  Moves made;
  made.leftCols<3>().setIdentity();
  made.rightCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  return made;
}

/// Pairs of elements by their common triangle.
std::map<std::array<std::int32_t, 3>, std::vector<Index>> triangles(const geometry::TetraMesh& mesh) {
  std::map<std::array<std::int32_t, 3>, std::vector<Index>> found;
  for (std::size_t element = 0; element < mesh.tetrahedra.size(); ++element)
    for (const auto& face : geometry::tetrahedron_faces) {
      std::array<std::int32_t, 3> nodes{};
      for (std::size_t i = 0; i < 3; ++i) nodes[i] = mesh.tetrahedra[element][static_cast<std::size_t>(face[i])];
      std::ranges::sort(nodes);
      found[nodes].push_back(static_cast<Index>(element));
    }
  return found;
}

using Entries = std::vector<Eigen::Triplet<Real>>;

/// A spring at a point that two blocks share, or between one block and the ground.
void add_spring(Entries& entries, const std::vector<Block>& blocks, const std::vector<Index>& pair, const Vector3& point,
                const Matrix3& spring) {
  const auto moved = [&](Index block) { return moves(point - blocks[static_cast<std::size_t>(block)].centre); };
  for (const Index first : pair)
    for (const Index second : pair) {
      const Real sign = first == second ? 1 : -1;
      const Eigen::Matrix<Real, 6, 6> part = sign * moved(first).transpose() * spring * moved(second);
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) entries.emplace_back(6 * first + i, 6 * second + j, part(i, j));
    }
}

Eigen::SparseMatrix<Real> stiffness(const geometry::TetraMesh& mesh, const std::vector<Block>& blocks,
                                    const JointStiffness& joint, Sides sides) {
  Entries entries;
  for (const auto& [nodes, pair] : triangles(mesh)) {
    std::array<Vector3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = mesh.nodes[static_cast<std::size_t>(nodes[c])];
    const Vector3 area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const bool outside = pair.size() == 1, end = std::abs(area.x()) > 0.5 * area.norm();
    if (outside && (sides == Sides::free || end)) continue;
    const Matrix3 across = area.normalized() * area.normalized().transpose();
    const Matrix3 along = Matrix3::Identity() - across;
    const Matrix3 spring = joint.normal * across + (outside ? 0 : joint.shear) * along;
    for (const Vector3& corner : corners) add_spring(entries, blocks, pair, corner, area.norm() / 3 * spring);
  }
  const auto size = static_cast<Eigen::Index>(6 * blocks.size());
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, 1e-3);  // holds the free bar; 1e-9 of a joint
  Eigen::SparseMatrix<Real> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Slope of y over x by least squares through the mean.
Real fitted_slope(const std::vector<Real>& x, const std::vector<Real>& y) {
  Real mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / static_cast<Real>(x.size());
    mean_y += y[i] / static_cast<Real>(x.size());
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xy / xx;
}

/// -1 at the left end cube, 1 at the right one, 0 between.
int end_of(const Block& block) {
  if (block.centre.x() < cube_size) return -1;
  return block.centre.x() > bar_length - cube_size ? 1 : 0;
}

bool in_the_middle(const Block& block) { return block.centre.x() > 0.25 * bar_length && block.centre.x() < 0.75 * bar_length; }

Vector3 displacement(const Column& solution, std::size_t block) {
  return solution.segment<3>(static_cast<Eigen::Index>(6 * block));
}

}  // namespace

BarModuli static_moduli(const geometry::TetraMesh& mesh, const JointStiffness& joint, Sides sides) {
  const auto blocks = blocks_of(mesh);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> solver(stiffness(mesh, blocks, joint, sides));
  const auto size = static_cast<Eigen::Index>(6 * blocks.size());
  Column pull = Column::Zero(size), twist = Column::Zero(size);
  Real end_volume = 0, end_moment = 0;
  for (const Block& block : blocks) {
    if (end_of(block) <= 0) continue;
    end_volume += block.volume;
    end_moment += block.volume * block.centre.tail<2>().squaredNorm();
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    pull[at] = end_of(blocks[i]) * blocks[i].volume / end_volume;
    const Vector3 around = Vector3::UnitX().cross(blocks[i].centre);
    twist.segment<3>(at) = end_of(blocks[i]) * blocks[i].volume / end_moment * around;
  }
  const Column pulled = solver.solve(pull), twisted = solver.solve(twist);
  std::vector<Real> x, along, y, lateral, angle;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Vector3& centre = blocks[i].centre;
    if (!in_the_middle(blocks[i])) continue;
    x.push_back(centre.x());
    along.push_back(displacement(pulled, i).x());
    y.push_back(centre.y());
    lateral.push_back(displacement(pulled, i).y());
    angle.push_back(Vector3::UnitX().cross(centre).dot(displacement(twisted, i)) / centre.tail<2>().squaredNorm());
  }
  BarModuli moduli;
  const Real strain = fitted_slope(x, along);
  moduli.axial = 1 / strain;
  moduli.poisson = -fitted_slope(y, lateral) / strain;
  moduli.torsion = 1 / fitted_slope(x, angle);
  return moduli;
}

}  // namespace sazare::validation
