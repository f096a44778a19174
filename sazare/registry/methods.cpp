#include <array>

#include "sazare/methods/blocks/run/method.hpp"
#include "sazare/methods/fem/run/method.hpp"
#include "sazare/methods/hybrid/run/method.hpp"
#include "sazare/methods/mps/run/method.hpp"
#include "sazare/methods/rectangles/run/method.hpp"
#include "sazare/methods/spheres/run/method.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::registry {

/// The table of methods, in the order of the reference. A new method is one more row.
std::span<const runs::Method> methods() {
  static const std::array table{
      runs::blocks_method(),  runs::mps_method(), runs::rectangles_method(),
      runs::spheres_method(), runs::fem_method(), runs::hybrid_method(),
  };
  return table;
}

}  // namespace sazare::registry
