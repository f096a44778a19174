#pragma once

/// Who sits at a side of the coupling: a lock, which the system takes back from a program that dies, and a file in which a
/// program introduces itself.

#include <filesystem>
#include <optional>
#include <string>

#include "sazare/coupling/message.hpp"

namespace sazare::coupling {

/// What the file <side>.here says.
struct Presence {
  Side side = Side::continuum;
  std::string session;        ///< of this program's life, drawn by lot
  std::string partner = "-";  ///< the session of the partner that it has seen
  std::string run = "-";      ///< of the coupled run; - where it is not known yet
  std::int64_t next = 0;      ///< sequence with which it goes on
  std::int64_t kept = -1;     ///< sequence with which its last checkpoint goes on; below 0 where it keeps none
  std::int64_t process = 0;
  std::string host;
  bool locks = true;     ///< whether it holds <side>.lock
  bool is_done = false;  ///< it came to the end of the run

  std::string written() const;
  static Presence read(std::string_view text, const std::string& name);
};

/// Sixteen hexadecimal digits, drawn by lot.
std::string random_identity();

class Seat {
public:
  /// Takes the side's lock. Throws UserError when another program has it, MachineError when the folder cannot be written.
  Seat(std::filesystem::path folder, Side side);
  ~Seat();
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  /// Introduces this program; process, host and lock are filled in.
  void tell(Presence presence) const;

  /// What the partner has told; none where nobody has.
  std::optional<Presence> partner() const;

  enum class Life { alive, gone, unknown };
  /// Whether the program that told this is still there. Another host's program without a lock cannot be watched.
  Life life_of(const Presence& partner) const;

private:
  std::filesystem::path lock_of(Side side) const;
  std::filesystem::path here_of(Side side) const;

  std::filesystem::path folder_;
  Side side_;
  int descriptor_ = -1;
};

}  // namespace sazare::coupling
