#pragma once

/// Lines of text "key value", as heads of messages and presence files have them; the first line is the greeting, the name of the
/// protocol and its version.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sazare/core/error.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::coupling {

inline constexpr std::string_view protocol_name = "sazare-coupling";
inline constexpr int protocol_version = 1;

/// A file is not whole, or not as it was written. It may still be under way where a partner does not write it in one go.
class DamagedFile : public MachineError {
public:
  using MachineError::MachineError;
};

class Entries {
public:
  Entries() = default;

  /// Reads lines up to the line `last`, or to the end of the text where it is empty. `name` is for the errors: UserError for
  /// another protocol or version, DamagedFile for what is cut off.
  Entries(std::string_view text, const std::string& name, std::string_view last);

  void add(std::string key, std::string value) { entries_.emplace_back(std::move(key), std::move(value)); }
  /// The shortest text that gives the same bits back.
  void add_number(std::string key, Real value);
  void add_count(std::string key, std::int64_t value);

  /// Throw DamagedFile when the key is not there, or no such number.
  const std::string& text(std::string_view key) const;
  Real number(std::string_view key) const;
  std::int64_t count(std::string_view key) const;
  /// All values of a key that may come several times.
  std::vector<std::string> all(std::string_view key) const;

  /// The greeting and the lines.
  std::string written() const;
  std::string lines() const;

  /// Where the text goes on behind the line `last`.
  std::size_t end() const { return end_; }

private:
  [[noreturn]] void fail(const std::string& words) const;

  std::string name_;
  std::vector<std::pair<std::string, std::string>> entries_;
  std::size_t end_ = 0;
};

}  // namespace sazare::coupling
