#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "sazare/core/time.hpp"

namespace sazare::methods::spheres {

/// The place of a sphere as processors address its records: eight times, for then those of 64 and of 32 bytes are found without
/// a multiplication.
struct SphereAt {
  static constexpr Index most = (Index{1} << 29) - 1;  ///< beyond it eight times a place is no number of 32 bits

  std::uint32_t eightfold = 0;

  static SphereAt at(Index place) { return {8 * static_cast<std::uint32_t>(place)}; }
  Index place() const { return static_cast<Index>(eightfold / 8); }

  /// Its record in a table.
  template <class T>
  T* of(T* table) const {
    static_assert(sizeof(T) % 8 == 0 && sizeof(T) <= 64);
    using Byte = std::conditional_t<std::is_const_v<T>, const char, char>;
    return reinterpret_cast<T*>(reinterpret_cast<Byte*>(table) + std::size_t{eightfold} * (sizeof(T) / 8));
  }
};

}  // namespace sazare::methods::spheres
