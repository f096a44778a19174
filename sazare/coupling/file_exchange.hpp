#pragma once

/// One side of a coupling that exchanges files with a partner in another program, both in one folder: who is there, what is sent
/// and awaited, and how a run goes on that was stopped. docs/reference/coupling-files.md is the protocol.

#include <exception>

#include "sazare/core/stop_request.hpp"
#include "sazare/coupling/patience.hpp"
#include "sazare/coupling/seat.hpp"

namespace sazare::coupling {

/// Where a side goes on in an exchange: to be kept in its checkpoint.
struct ExchangeMark {
  std::string run = "-";
  std::int64_t next = 0;  ///< sequence of the next exchange; 0 is that of the shape
};

struct ExchangeOptions {
  std::filesystem::path folder;
  Side side = Side::continuum;
  ExchangeMark mark = {};         ///< of a run that is resumed; else a new one begins
  bool keeps_checkpoints = true;  ///< whether this side can be resumed: its partner's messages are then kept for it
  Real time_out = 600;            ///< wall-clock time without a message [s]
  StopRequest stop = {};
};

/// Not an error: this side was asked to stop while it waited, or the partner was and said so.
struct Stopped : std::exception {
  Stopped(bool by, std::int64_t at) : by_partner(by), window(at) {}
  const char* what() const noexcept override { return "stopped"; }
  bool by_partner;
  std::int64_t window;  ///< the partner is at its beginning
};

struct ExchangeCost {
  Real seconds = 0;            ///< wall-clock time [s]
  Real processor_seconds = 0;  ///< processor time [s]
};

enum class Farewell { done, stopped, failed };

class FileExchange {
public:
  /// Takes the side's place in the folder, and removes what this side has left there from another run, or from after its
  /// checkpoint. Throws UserError when the place is taken, MachineError when the folder cannot be written.
  explicit FileExchange(ExchangeOptions options);
  /// Says farewell where nobody did.
  ~FileExchange();

  /// Waits for the partner. Throws Stopped; MachineError when nobody comes; UserError when the two do not go together: another
  /// version of the protocol, another run, or messages that would be needed are no longer there.
  void meet();

  /// Sends the next message; who, which run and the sequence are filled in. Throws MachineError, and PhysicsError for a number
  /// that is not finite.
  void send(Message message);

  /// Waits for the partner's message of a sequence. Throws Stopped, or MachineError: time-out, partner's death or failure, a
  /// damaged or stale file.
  Message receive(std::int64_t sequence);

  /// A message of this side that is still there, such as that of the shape.
  Message own(std::int64_t sequence) const;

  /// Sequence of the next message.
  std::int64_t next() const { return next_; }
  const std::string& run() const { return presence_.run; }

  /// What writing and reading files has cost so far, without the waits for them.
  const ExchangeCost& cost() const { return cost_; }

  /// A checkpoint was made that goes on with this sequence: what both sides no longer need is removed.
  void keep_from(std::int64_t sequence);

  /// The last word; `window` is that at whose beginning this side stands.
  void part(Farewell reason, std::int64_t window, const std::string& words = "");

private:
  class Stopwatch;

  std::string partner_name() const;
  void remove_from(std::int64_t sequence);
  void remove_before(std::int64_t sequence);
  void wait(Patience& patience) const;
  bool has_met(const Presence& partner);
  void agree(const Presence& partner);
  std::optional<Message> look_for(std::int64_t sequence, const Patience& patience);
  void check_sender(const Message& message, std::int64_t sequence, const std::string& file) const;
  void watch_partner(std::int64_t sequence, const Patience& patience);
  Message opened(Message message) const;

  ExchangeOptions options_;
  Seat seat_;
  Presence presence_;
  std::string partner_session_;
  std::int64_t next_ = 0;    ///< sequence of the next message
  std::int64_t oldest_ = 1;  ///< of own messages that may still be there
  Real damaged_since_ = -1;  ///< of the wait, when the awaited file was first seen damaged [s]
  ExchangeCost cost_;
  Real last_wait_ = 0;  ///< for a message [s]
  bool has_parted_ = false;
};

}  // namespace sazare::coupling
