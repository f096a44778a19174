#pragma once

/// The shells of a closed surface: parts that hang together, each around a solid or around a hollow in one.

#include <optional>
#include <span>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

/// Why a closed surface does not say which points are within: there is one that it goes around twice, or the wrong way.
struct ShellFault {
  enum class Kind {
    crossing,    ///< two triangles go through each other
    doubled,     ///< a shell lies within another, or partly, and both are solid: their common part would count twice
    inside_out,  ///< a shell that is not within another has the wrong side out
  };
  Kind kind;
  std::size_t triangle = 0, other = 0;  ///< counted from 0; the other one of a crossing
};

/// Shells may stand apart, touch from outside, or be hollows of the right orientation; anything else is a fault. Every edge of
/// the surface must belong to two triangles that have the same side out.
std::optional<ShellFault> find_shell_fault(std::span<const Triangle> surface);

}  // namespace sazare::geometry
