#pragma once

#include <functional>
#include <span>
#include <string>

#include "sazare/cases/case_file.hpp"

namespace sazare::cases {

/// Corners of the box around a model [m].
struct Extent {
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();

  Vector3 size() const { return high - low; }
};

Extent extent_of(std::span<const Vector3> points);

/// The box around bodies, of which the centre and how far they reach from it along the axes [m] are given by number.
Extent extent_of(std::size_t bodies, const std::function<Vector3(std::size_t)>& centre,
                 const std::function<Vector3(std::size_t)>& reach);

/// A line of `check` with the size of a model.
std::string explain_size(const Extent& extent);

/// Warns of a mesh that is longer than bodies of this field are, most likely because its coordinates are in millimetres;
/// otherwise empty.
std::string warn_of_size(const CaseSource& source, const Extent& extent);

}  // namespace sazare::cases
