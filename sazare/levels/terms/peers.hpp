#pragma once

/// What a term may ask of the other processes that compute the same run. Alone there is nobody to ask.

#include <cstddef>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::terms {

/// All processes ask the same things in the same order.
class Peers {
public:
  virtual ~Peers() = default;

  virtual bool alone() const { return true; }

  /// Whether this process is the one that speaks for a body.
  virtual bool owns(Index) const { return true; }

  /// Makes lists of all processes one, rising, each number once.
  virtual void unite(std::vector<Index>& list) const;

  /// Records of all processes, one process after the other.
  virtual std::vector<std::byte> gather(std::span<const std::byte> own) const { return {own.begin(), own.end()}; }

  /// Makes the motion of these bodies known here. The same list everywhere.
  virtual void fetch(std::span<const Index>) {}
};

}  // namespace sazare::terms
