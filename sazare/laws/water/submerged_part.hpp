#pragma once

/// The part of a triangle or a tetrahedron that is below a plane, exactly: its share of the whole, and its first moment over that
/// of the whole, from which its centroid follows without a division by a share that may be small.

#include <array>
#include <cmath>
#include <cstddef>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct SubmergedPart {
  Real share = 0;                    ///< of the area or volume
  Vector3 moment = Vector3::Zero();  ///< share times the centroid of the part [m]
};

/// Corners and how deep each is below the plane [m].
template <std::size_t N>
struct CutSimplex {
  std::array<Vector3, N> corner;
  std::array<Real, N> depth;

  Vector3 centroid() const {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& each : corner) sum += each;
    return sum / static_cast<Real>(N);
  }
};

/// The part around one corner, which alone is on its side of the plane.
template <std::size_t N>
SubmergedPart part_at_corner(const CutSimplex<N>& cut, std::size_t alone) {
  Real share = 1;
  Vector3 away = Vector3::Zero();
  for (std::size_t n = 0; n < N; ++n) {
    if (n == alone) continue;
    const Real along = cut.depth[alone] / (cut.depth[alone] - cut.depth[n]);
    share *= along;
    away += along * (cut.corner[n] - cut.corner[alone]);
  }
  return {share, share * (cut.corner[alone] + away / static_cast<Real>(N))};
}

/// Between two wet corners and the plane: a wedge of three tetrahedra.
inline SubmergedPart part_of_wedge(const CutSimplex<4>& cut, std::array<std::size_t, 2> wet, std::array<std::size_t, 2> dry) {
  const auto on_plane = [&](std::size_t from, std::size_t to) -> Vector3 {
    const Real along = cut.depth[from] / (cut.depth[from] - cut.depth[to]);
    return cut.corner[from] + along * (cut.corner[to] - cut.corner[from]);
  };
  const auto volume = [](const std::array<Vector3, 4>& c) { return std::abs((c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0])); };
  const Vector3 &a = cut.corner[wet[0]], &b = cut.corner[wet[1]];
  const Vector3 ac = on_plane(wet[0], dry[0]), ad = on_plane(wet[0], dry[1]), bc = on_plane(wet[1], dry[0]),
                bd = on_plane(wet[1], dry[1]);
  SubmergedPart sum;
  for (const std::array<Vector3, 4>& part : {std::array{a, ac, ad, b}, std::array{ac, ad, b, bc}, std::array{ad, b, bc, bd}}) {
    const Real share = volume(part) / volume(cut.corner);
    sum.share += share;
    sum.moment += share / 4 * (part[0] + part[1] + part[2] + part[3]);
  }
  return sum;
}

template <std::size_t N>
SubmergedPart submerged_part(const CutSimplex<N>& cut) {
  std::array<std::size_t, N> wet{}, dry{};
  std::size_t count = 0, above = 0;
  for (std::size_t n = 0; n < N; ++n) cut.depth[n] > 0 ? void(wet[count++] = n) : void(dry[above++] = n);
  if (count == 0) return {};
  if (above == 0) return {1, cut.centroid()};
  if (count == 1) return part_at_corner(cut, wet[0]);
  if constexpr (N == 4)
    if (count == 2) return part_of_wedge(cut, {wet[0], wet[1]}, {dry[0], dry[1]});
  const SubmergedPart rest = part_at_corner(cut, dry[0]);
  return {1 - rest.share, cut.centroid() - rest.moment};
}

}  // namespace sazare::laws
