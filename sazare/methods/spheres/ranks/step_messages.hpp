#pragma once

/// What a rank sends to each other one in a step and gets from it, and the records that these messages consist of.

#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

#include "sazare/parallel/ranks.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// Force and moment of a sphere on their way to another rank.
using LoadNumbers = std::array<Real, 6>;

inline LoadNumbers numbers_of(const state::SphereLoad& load) { return {load.fx, load.fy, load.fz, load.mx, load.my, load.mz}; }
inline state::SphereLoad load_of(const LoadNumbers& numbers) {
  return {numbers[0], numbers[1], numbers[2], 0, numbers[3], numbers[4], numbers[5], 0};
}

/// A message that is written record by record.
class MessageWriter {
public:
  explicit MessageWriter(std::vector<std::byte>& bytes) : next_(bytes.data()) {}

  template <class Record>
  void write(const Record& record) {
    std::memcpy(next_, &record, sizeof record);
    next_ += sizeof record;
  }

private:
  std::byte* next_;
};

/// A message that is read record by record.
class MessageReader {
public:
  explicit MessageReader(const std::vector<std::byte>& bytes) : next_(bytes.data()), end_(next_ + bytes.size()) {}

  bool is_at_end() const { return next_ == end_; }
  template <class Record>
  Record read() {
    Record record;
    std::memcpy(static_cast<void*>(&record), next_, sizeof record);
    next_ += sizeof record;
    return record;
  }

private:
  const std::byte *next_, *end_;
};

class StepMessages {
public:
  explicit StepMessages(const parallel::Ranks& ranks);

  /// How many bytes go to a rank and come from it in the next exchange.
  void plan(int rank, std::size_t going, std::size_t coming);
  /// The message to a rank, to be filled between `plan` and `exchange`.
  MessageWriter to(int rank) { return MessageWriter(sent_[static_cast<std::size_t>(rank)].bytes); }
  /// Sends all messages and waits for those that come; empty ones do not travel. All ranks call it.
  void exchange();
  /// The message from a rank.
  MessageReader from(int rank) const { return MessageReader(received_[static_cast<std::size_t>(rank)].bytes); }

  /// What was planned to be sent so far.
  const parallel::Sent& planned() const { return planned_; }

private:
  const parallel::Ranks* ranks_;
  std::vector<parallel::Message> sent_, received_;  ///< by rank
  parallel::Sent planned_;
};

}  // namespace sazare::methods::spheres
