#pragma once

/// A message of a coupling as a file: a head in lines of text, numbers as they lie in memory, and a checksum of all of it.
/// docs/reference/coupling-files.md has every byte.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/coupling/entries.hpp"

namespace sazare::coupling {

enum class Side { continuum, bodies };
enum class Kind { shape, motion, force, farewell };

std::string_view name_of(Side side);
std::string_view name_of(Kind kind);
inline Side other(Side side) { return side == Side::continuum ? Side::bodies : Side::continuum; }

/// A table of numbers, row by row.
struct NumberTable {
  std::string name;
  int columns = 1;
  std::string unit;  ///< 1 where there is none
  std::vector<Real> values;
};

struct Message {
  Side from = Side::continuum;
  Kind kind = Kind::farewell;
  std::string run;  ///< of which run, an identity without spaces
  std::int64_t sequence = 0;
  std::int64_t window = 0;
  std::int32_t pass = 0;
  Real time = 0;    ///< [s]
  Entries details;  ///< further lines of the head
  std::vector<NumberTable> tables;

  /// Throws DamagedFile when there is none of that name with so many columns and that unit.
  NumberTable& table(std::string_view name, int columns, std::string_view unit);
};

/// continuum-000000000017.message
std::filesystem::path file_name(Side from, std::int64_t sequence);

/// The bytes of the file.
std::string encode(const Message& message);

/// The message of such bytes; `name` is for the errors. Throws UserError for another protocol or version of it, DamagedFile for
/// bytes that are cut off or changed.
Message decode(std::string_view bytes, const std::string& name);

}  // namespace sazare::coupling
