#pragma once

#include <fmt/format.h>

#include <map>
#include <string>

#include "sazare/cases/format/problems.hpp"

namespace sazare::cases {

/// Remembers names and where they were first given.
class SeenNames {
public:
  /// The place of the same name seen before, or nullptr.
  const Place* before(const std::string& name, const Place& place) {
    const auto [found, is_new] = seen_.try_emplace(name, place);
    return is_new ? nullptr : &found->second;
  }

private:
  std::map<std::string, Place> seen_;
};

/// Where the other one is, for the help of a message.
inline std::string other_line(const Place& place) {
  if (place.source > 0) return "the other one is given on the command line";
  return place.line > 0 ? fmt::format("the other one is in line {}", place.line) : "";
}

}  // namespace sazare::cases
