#include "sazare/cases/extent.hpp"

#include <fmt/format.h>

#include <vector>

#include "sazare/cases/explanation.hpp"

namespace sazare::cases {
namespace {

constexpr Real longest = 3000;  // [m]

}  // namespace

Extent extent_of(std::span<const Vector3> points) {
  Extent extent;
  if (points.empty()) return extent;
  extent.low = extent.high = points.front();
  for (const Vector3& point : points) {
    extent.low = extent.low.cwiseMin(point);
    extent.high = extent.high.cwiseMax(point);
  }
  return extent;
}

Extent extent_of(std::size_t bodies, const std::function<Vector3(std::size_t)>& centre,
                 const std::function<Vector3(std::size_t)>& reach) {
  std::vector<Vector3> ends;
  for (std::size_t i = 0; i < bodies; ++i) {
    ends.emplace_back(centre(i) - reach(i));
    ends.emplace_back(centre(i) + reach(i));
  }
  return extent_of(ends);
}

std::string explain_size(const Extent& extent) {
  const Vector3 size = extent.size();
  const std::string depth = size.z() > 0 ? fmt::format(" x {}", number(size.z())) : "";
  return line("size", fmt::format("{} x {}{} m, from {} to {} m", number(size.x()), number(size.y()), depth,
                                  vector_text(extent.low), vector_text(extent.high)));
}

std::string warn_of_size(const CaseSource& source, const Extent& extent) {
  const Real length = extent.size().maxCoeff();
  if (length <= longest) return "";
  return warning(source, "mesh.file", fmt::format("the mesh is {} m long", number(length)),
                 fmt::format("if its coordinates are in millimetres, set scale = 0.001 in [mesh]: it is then {} m long",
                             number(length / 1000)));
}

}  // namespace sazare::cases
