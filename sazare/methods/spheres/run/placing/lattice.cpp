#include "sazare/methods/spheres/run/placing/lattice.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/machine_memory.hpp"
#include "sazare/core/time.hpp"
#include "sazare/methods/spheres/sphere_at.hpp"

namespace sazare::runs {

namespace {

using cases::short_number;
using cases::SphereGroup;
using cases::SphereSource;

constexpr int bytes_of_sphere = 350;  // see docs/theory/spheres.md
constexpr Index most_spheres = methods::spheres::SphereAt::most;

/// Spheres along the axes of a lattice, as numbers that may be larger than any whole one.
std::array<Real, 3> lattice_counts(const SphereGroup& group) {
  const Real spacing = group.spacing.value_or(2 * group.radius);
  std::array<Real, 3> counts{};
  for (int axis = 0; axis < 3; ++axis) {
    const Real room = group.upper[axis] - group.lower[axis] - 2 * group.radius;
    counts[static_cast<std::size_t>(axis)] = room < -1e-9 * spacing ? 0 : std::floor(room / spacing + 1e-9) + 1;
  }
  return counts;
}

}  // namespace

std::vector<geometry::Ball> lattice(const SphereGroup& group) {
  const Real spacing = group.spacing.value_or(2 * group.radius);
  const std::array<Real, 3> count = lattice_counts(group);
  Vector3 first;
  for (int axis = 0; axis < 3; ++axis)
    first[axis] = 0.5 * (group.lower[axis] + group.upper[axis] - spacing * (count[static_cast<std::size_t>(axis)] - 1));
  std::vector<geometry::Ball> balls;
  for (Real k = 0; k < count[2]; ++k)
    for (Real j = 0; j < count[1]; ++j)
      for (Real i = 0; i < count[0]; ++i) balls.push_back({first + spacing * Vector3(i, j, k), group.radius});
  return balls;
}

void check_count(const cases::CaseFile& file, std::size_t number, const SphereGroup& group, std::size_t of_each) {
  const bool is_lattice = group.source == SphereSource::lattice;
  if (!is_lattice && group.source != SphereSource::random) return;
  const std::array<Real, 3> along = lattice_counts(group);
  const Real count = static_cast<Real>(of_each) * (is_lattice ? along[0] * along[1] * along[2] : group.count),
             needed = bytes_of_sphere * count, memory = machine_memory();
  if (count <= most_spheres && needed <= memory) return;
  const char* key = !is_lattice ? "count" : group.spacing ? "spacing" : group.shape.empty() ? "radius" : "lower";
  refuse(file, fmt::format("spheres.{}.{}", number, key),
         fmt::format("the group \"{}\" would have {} spheres", group.name, short_number(count, 4)),
         fmt::format("they need {} GB, {} bytes each, and this machine has {} GB{}: choose larger or fewer ones",
                     short_number(1e-9 * needed, 3), bytes_of_sphere, short_number(1e-9 * memory, 3),
                     count > most_spheres ? fmt::format("; a run has {} at most", most_spheres) : ""));
}

}  // namespace sazare::runs
