#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sazare::cases {

/// A count of things whose plural ends in a mere s: counted(2, "spheres") is "2 spheres", counted(1, "spheres") is "1 sphere".
inline std::string counted(std::int64_t count, std::string_view things) {
  if (count == 1) things.remove_suffix(1);
  return std::to_string(count) + " " + std::string(things);
}

}  // namespace sazare::cases
