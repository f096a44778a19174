#pragma once

#include <stdexcept>

namespace sazare {

/// What the user can put right: the case, the mesh, a table, the command line. Exit code 2.
class UserError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
  static constexpr int exit_code = 2;
};

/// The simulated physics failed: a number that is not finite, a step past its limit. Exit code 3.
class PhysicsError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
  static constexpr int exit_code = 3;
};

/// The machine failed: disk full, folder not writable, memory exhausted. Exit code 4.
class MachineError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
  static constexpr int exit_code = 4;
};

}  // namespace sazare
