#include "sazare/coupling/message.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>

namespace sazare::coupling {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::array<std::string_view, 2> sides = {"continuum", "bodies"};
constexpr std::array<std::string_view, 4> kinds = {"shape", "motion", "force", "farewell"};
constexpr std::string_view last_line_of_head = "data";
constexpr std::string_view seal_key = "checksum ";
constexpr std::size_t most_numbers = std::size_t{1} << 56;  // of all tables: their bytes can still be counted
constexpr std::size_t seal_size = seal_key.size() + 8 + 1;

std::string seal_of(std::string_view bytes) {
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return fmt::format("{}{:08x}\n", seal_key, sum);
}

template <std::size_t N>
std::size_t place_of(std::string_view word, const std::array<std::string_view, N>& words, const std::string& name) {
  for (std::size_t i = 0; i < N; ++i)
    if (words[i] == word) return i;
  throw DamagedFile(fmt::format("{}: has the unknown word '{}' in its head", name, word));
}

/// A table without its numbers, and how many they are, from the line "name rows columns unit".
std::size_t read_layout(const std::string& line, const std::string& name, NumberTable& table) {
  std::istringstream words(line);
  std::int64_t rows = -1;
  words >> table.name >> rows >> table.columns >> table.unit;
  constexpr std::int64_t most = std::int64_t{1} << 40;
  if (!words || rows < 0 || rows > most || table.columns < 1 || table.columns > 1000)
    throw DamagedFile(fmt::format("{}: 'table {}' in its head is not a table", name, line));
  return static_cast<std::size_t>(rows) * static_cast<std::size_t>(table.columns);
}

}  // namespace

std::string_view name_of(Side side) { return sides[static_cast<std::size_t>(side)]; }
std::string_view name_of(Kind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::filesystem::path file_name(Side from, std::int64_t sequence) {
  return fmt::format("{}-{:012d}.message", name_of(from), sequence);
}

NumberTable& Message::table(std::string_view name, int columns, std::string_view unit) {
  const std::string file = file_name(from, sequence).string();
  for (NumberTable& each : tables) {
    if (each.name != name) continue;
    if (each.columns == columns && each.unit == unit) return each;
    throw UserError(fmt::format("{}: the table '{}' has {} numbers in [{}] per row, but {} in [{}] are expected", file, name,
                                each.columns, each.unit, columns, unit));
  }
  throw UserError(fmt::format("{}: has no table '{}'", file, name));
}

std::string encode(const Message& message) {
  Entries head;
  head.add("from", std::string(name_of(message.from)));
  head.add("kind", std::string(name_of(message.kind)));
  head.add("run", message.run);
  head.add_count("sequence", message.sequence);
  head.add_count("window", message.window);
  head.add_count("pass", message.pass);
  head.add_number("time", message.time);
  std::string bytes = head.written() + message.details.lines();
  for (const NumberTable& table : message.tables)
    bytes += fmt::format("table {} {} {} {}\n", table.name, table.values.size() / static_cast<std::size_t>(table.columns),
                         table.columns, table.unit);
  bytes += fmt::format("{}\n", last_line_of_head);
  for (const NumberTable& table : message.tables)
    bytes.append(reinterpret_cast<const char*>(table.values.data()), table.values.size() * sizeof(Real));
  return bytes + seal_of(bytes);
}

Message decode(std::string_view bytes, const std::string& name) {
  Entries head(bytes, name, last_line_of_head);
  Message message;
  message.from = static_cast<Side>(place_of(head.text("from"), sides, name));
  message.kind = static_cast<Kind>(place_of(head.text("kind"), kinds, name));
  message.run = head.text("run");
  message.sequence = head.count("sequence");
  message.window = head.count("window");
  const std::int64_t pass = head.count("pass");
  if (pass < 0 || pass > std::numeric_limits<std::int32_t>::max())
    throw DamagedFile(fmt::format("{}: 'pass {}' in its head is out of range", name, pass));
  message.pass = static_cast<std::int32_t>(pass);
  message.time = head.number("time");
  std::vector<std::size_t> counts;  // tables get their room once the file is known to hold them
  std::size_t numbers = 0;
  for (const std::string& line : head.all("table")) {
    counts.push_back(read_layout(line, name, message.tables.emplace_back()));
    numbers += counts.back();
    if (numbers > most_numbers)
      throw DamagedFile(fmt::format("{}: is damaged: its tables have {} numbers or more", name, numbers));
  }
  const std::size_t size = head.end() + numbers * sizeof(Real) + seal_size;
  if (bytes.size() < size) throw DamagedFile(fmt::format("{}: is half written: {} of {} bytes", name, bytes.size(), size));
  if (bytes.size() > size) throw DamagedFile(fmt::format("{}: is damaged: {} bytes instead of {}", name, bytes.size(), size));
  if (bytes.substr(size - seal_size) != seal_of(bytes.substr(0, size - seal_size)))
    throw DamagedFile(fmt::format("{}: is damaged: its checksum does not match its data", name));
  const char* from = bytes.data() + head.end();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    NumberTable& table = message.tables[i];
    table.values.resize(counts[i]);
    if (!table.values.empty()) std::memcpy(table.values.data(), from, table.values.size() * sizeof(Real));
    from += table.values.size() * sizeof(Real);
  }
  message.details = std::move(head);
  return message;
}

}  // namespace sazare::coupling
