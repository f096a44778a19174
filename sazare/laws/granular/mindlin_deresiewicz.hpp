#pragma once

/// Spheres that are pressed together elastically as in `Hertz`, and that slip at the edge of their contact before they slide: see
/// slip_bands.hpp.

#include "sazare/laws/granular/hertz.hpp"

namespace sazare::laws {

struct MindlinDeresiewicz : Hertz {
  static constexpr std::string_view word = "mindlin_deresiewicz";
  static constexpr bool slips_in_part = true;
};

}  // namespace sazare::laws
