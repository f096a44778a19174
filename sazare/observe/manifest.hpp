#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::observe {

/// The machine of a run.
struct Machine {
  std::string cpu;  ///< model name
  int cores = 0;    ///< processors that the system offers
  int threads = 0;  ///< threads that each process of the run uses
  int ranks = 1;    ///< processes of the run
};

/// This machine, and the threads set at present.
Machine this_machine();

/// The time of day, UTC, as "2026-01-31T23:59:59Z".
std::string time_of_day();

/// A headline figure of a run.
using Figure = std::variant<std::int64_t, Real>;

/// What a run was and what it found. The names in the file are an interface: scripts of users read them.
struct Manifest {
  std::string version;  ///< of Sazare
  std::string commit;   ///< of Sazare
  std::string case_title;
  std::string method;
  std::string status;    ///< "running", "done", "stopped" or "failed"
  std::string started;   ///< time of day
  std::string finished;  ///< time of day, empty while running
  Machine machine;
  std::uint64_t state_hash = 0;
  std::vector<std::pair<std::string, Figure>> results;               ///< in the order of the file
  std::vector<std::pair<std::string, Real>> peak_particle_velocity;  ///< `ppv` in the results, by gauge [m/s]
};

/// The manifest of a run of this program on this machine that starts now.
Manifest new_manifest();

/// Writes the manifest as JSON, atomically. Numbers that are not finite become null. Throws MachineError.
void write_manifest(const std::filesystem::path& file, const Manifest& manifest);

}  // namespace sazare::observe
