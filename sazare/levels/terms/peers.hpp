#pragma once

/// What a term may ask of the other processes that compute the same run. Alone there is nobody to ask.

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

  /// Makes the motion of these bodies known here. The same list everywhere.
  virtual void fetch(std::span<const Index>) {}
};

}  // namespace sazare::terms
