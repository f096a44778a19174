#pragma once

/// The processes that run one case together, and all that they say to each other.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sazare::parallel {

/// Who is to learn what ranks give.
enum class To { all, first };

/// What all ranks have given, by rank.
struct Gathered {
  std::vector<std::byte> bytes;
  std::vector<std::size_t> begin;  ///< by rank, and the end

  std::span<const std::byte> of(int rank) const {
    const auto at = static_cast<std::size_t>(rank);
    return std::span(bytes).subspan(begin[at], begin[at + 1] - begin[at]);
  }
};

/// Bytes for a rank or from it.
struct Message {
  int rank = 0;
  std::vector<std::byte> bytes;
};

/// What ranks tell each other about.
enum class Topic {
  motion,   ///< bodies at the borders, at every tick
  changes,  ///< what breaks, begins and ends
  search,   ///< bodies that a search for contacts looks at
  rows,     ///< rows of histories
  state,    ///< all of the run: snapshots, checkpoints, a new distribution of the work
  other,
};
inline constexpr std::size_t topic_count = 6;

/// What a rank has sent to others. What all give to all counts as one message to each of the others.
struct Sent {
  std::int64_t bytes = 0;
  std::int64_t messages = 0;
};

/// What talking has cost a rank so far.
struct Traffic {
  std::array<Sent, topic_count> sent;  ///< by topic
  double seconds = 0;                  ///< wall-clock time, waiting for others included

  const Sent& of(Topic topic) const { return sent[static_cast<std::size_t>(topic)]; }
  Sent total() const;
};

/// One process, or those of an MPI launch when Sazare was built with MPI. One object per process, made at the start of main
/// and destroyed at its end.
///
/// Whoever waits gives the processor away after a moment, so that ranks may be more than there are processors.
class Ranks {
public:
  /// Joins the processes of the launch; argc and argv may be changed by MPI. Throws UserError when there are several and
  /// Sazare was built without MPI.
  Ranks(int& argc, char**& argv);
  /// One process, whatever started it.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// This process, 0..size()-1.
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }

  /// Returns when all processes have called it.
  void barrier() const;

  /// Everybody's bytes to everybody, or to the first rank: the others then have only their own. All call it.
  Gathered gather(std::span<const std::byte> own, Topic topic, To to = To::all) const;

  /// The first rank's number to everybody; all call it.
  std::int64_t from_first(std::int64_t number) const;

  /// Sends messages and fills those that come: their ranks and sizes are known. Empty ones do not travel.
  void exchange(const std::vector<Message>& sent, std::vector<Message>& received, Topic topic) const;

  /// Ends all processes at once with this exit code; nothing is flushed.
  [[noreturn]] void abort(int exit_code) const;

  /// Lets waits end with a MachineError when this turns true and nothing comes any more: a launcher that has lost a process
  /// asks the others to end.
  void watch(const std::atomic<bool>* asked_to_end) { asked_to_end_ = asked_to_end; }

  const Traffic& traffic() const { return traffic_; }

private:
  class Wait;
  void count(Topic topic, std::size_t bytes, int messages) const;
  void gather_round(Gathered& gathered, std::span<const std::byte> own, To to, std::size_t done, std::size_t part) const;

  int rank_ = 0;
  int size_ = 1;
  bool connected_ = false;  ///< this object speaks for a process of the launch
  bool finalize_ = false;   ///< this object started MPI and ends it
  const std::atomic<bool>* asked_to_end_ = nullptr;
  mutable Traffic traffic_;
  mutable bool lost_ = false;  ///< another process is gone
};

}  // namespace sazare::parallel
