#pragma once

#include <algorithm>
#include <vector>

#include "sazare/parallel/threads.hpp"

namespace sazare::parallel {

/// Sorts on several threads. Where two items are equal, which comes first may depend on their number.
template <class T>
void sort(std::vector<T>& items) {
  constexpr std::size_t serial_below = 20000;
  std::size_t parts = 1;
  while (2 * parts <= static_cast<std::size_t>(threads()) && items.size() >= serial_below) parts *= 2;
  const auto at = [&](std::size_t part) { return items.begin() + static_cast<std::ptrdiff_t>(items.size() * part / parts); };
  parallel_for(parts, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) std::sort(at(part), at(part + 1));
  });
  for (std::size_t merged = 1; merged < parts; merged *= 2)
    parallel_for(parts / (2 * merged), 2, [&](std::size_t begin, std::size_t end) {
      for (std::size_t two = begin; two < end; ++two)
        std::inplace_merge(at(2 * merged * two), at(2 * merged * two + merged), at(2 * merged * (two + 1)));
    });
}

}  // namespace sazare::parallel
