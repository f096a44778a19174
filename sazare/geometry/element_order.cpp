#include "sazare/geometry/element_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "sazare/core/morton.hpp"
#include "sazare/core/saturated.hpp"

namespace sazare::geometry {

namespace {

constexpr int bits = 21;  // per axis: three fill a 64-bit number

Vector3 centre_of(const TetraMesh& mesh, std::size_t element) {
  const auto corners = corners_of(mesh, static_cast<std::int32_t>(element));
  return 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

std::vector<std::uint64_t> places_on_curve(const TetraMesh& mesh) {
  Vector3 low = Vector3::Constant(std::numeric_limits<Real>::infinity()), high = -low;
  for (const Vector3& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  const Real size = std::max((high - low).maxCoeff(), std::numeric_limits<Real>::min());
  std::vector<std::uint64_t> places;
  for (std::size_t element = 0; element < mesh.tetrahedra.size(); ++element) {
    const Vector3 at = ((1 << bits) - 1) / size * (centre_of(mesh, element) - low);
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis)
      place |= spread_for_three(saturated<std::uint64_t>(std::clamp<Real>(at[axis], 0, (1 << bits) - 1))) << axis;
    places.push_back(place);
  }
  return places;
}

template <class T>
void permute(std::vector<T>& column, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(order.size());
  for (const std::size_t element : order) sorted.push_back(column[element]);
  column = std::move(sorted);
}

}  // namespace

void sort_along_curve(TetraMesh& mesh) {
  const std::vector<std::uint64_t> places = places_on_curve(mesh);
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t element) { return places[element]; });
  std::vector<std::int64_t> tags;
  for (std::size_t element = 0; element < order.size(); ++element)
    tags.push_back(element_tag(mesh, static_cast<std::int32_t>(element)));
  mesh.tags = std::move(tags);
  permute(mesh.tags, order);
  permute(mesh.tetrahedra, order);
  permute(mesh.region, order);
}

}  // namespace sazare::geometry
