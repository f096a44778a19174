#pragma once

/// Where the wall-clock time of a run went, over all its parts when it was interrupted.

#include <array>
#include <chrono>
#include <filesystem>
#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/levels/simulation.hpp"

namespace sazare::runs {

class RunTimes {
public:
  /// What is not part of a step.
  enum class Part : std::size_t { setup, output, checkpoints };

  /// Wall-clock time of the run until now [s].
  Real now() const { return earlier_ + std::chrono::duration<Real>(Clock::now() - start_).count(); }

  void add(Part part, Real seconds) { own_[static_cast<std::size_t>(part)] += seconds; }

  /// Writes timing.csv: the engine's parts, those here, and what is in none of them.
  void write(const std::filesystem::path& file, std::span<const levels::PartTime> engine) const;

  void columns(Archive& archive, std::span<const levels::PartTime> engine);

private:
  using Clock = std::chrono::steady_clock;

  Real earlier_ = 0;  ///< until the checkpoint that the run was resumed from [s]
  Clock::time_point start_ = Clock::now();
  std::array<Real, 3> own_{};
  std::vector<Real> engine_earlier_;  ///< by part of the engine [s]
};

}  // namespace sazare::runs
