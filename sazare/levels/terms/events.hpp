#pragma once

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::terms {

/// Rare things noted by many threads during a step, and taken afterwards in an order that does not depend on them.
class Events {
public:
  void add(Index what) {
    const std::scoped_lock lock(adding_);
    noted_.push_back(what);
  }

  /// What was noted since the last call: rising, each once.
  std::vector<Index> take() {
    std::sort(noted_.begin(), noted_.end());
    noted_.erase(std::unique(noted_.begin(), noted_.end()), noted_.end());
    return std::exchange(noted_, {});
  }

private:
  std::mutex adding_;
  std::vector<Index> noted_;
};

}  // namespace sazare::terms
