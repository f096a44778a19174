#include "sazare/coupling/entries.hpp"

#include <fmt/format.h>

#include <charconv>

namespace sazare::coupling {

namespace {

constexpr std::size_t longest_line = 4096;

/// Throws when the first line is not that of this protocol and version.
void check_greeting(std::string_view line, const std::string& name) {
  const std::size_t space = line.find(' ');
  if (line.substr(0, space) != protocol_name || space == std::string_view::npos)
    throw UserError(fmt::format(
        "{}: is not a coupling file: it should begin with '{} {}'. Choose a folder for the exchange to which nothing else writes",
        name, protocol_name, protocol_version));
  if (line.substr(space + 1) != std::to_string(protocol_version))
    throw UserError(
        fmt::format("{}: the partner speaks version {} of the protocol, and this program version {}. Use programs of "
                    "the same version on both sides",
                    name, line.substr(space + 1), protocol_version));
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Entries::Entries(std::string_view text, const std::string& name, std::string_view last) : name_(name) {
  bool first = true, ended = last.empty();
  while (end_ < text.size()) {
    const std::size_t stop = text.find('\n', end_);
    if (stop == std::string_view::npos || stop - end_ > longest_line) break;
    const std::string_view line = text.substr(end_, stop - end_);
    end_ = stop + 1;
    if (first) check_greeting(line, name);
    if (!first && line == last) {
      ended = true;
      break;
    }
    const std::size_t space = line.find(' ');
    if (!first && space == std::string_view::npos) fail("has a line without a value in its head");
    if (!first) entries_.emplace_back(line.substr(0, space), line.substr(space + 1));
    first = false;
  }
  if (first && text.find('\n') == std::string_view::npos && text.size() > protocol_name.size() + 1) check_greeting(text, name);
  if (first || !ended || (last.empty() && end_ != text.size())) fail("is half written: it ends in its head");
}

void Entries::fail(const std::string& words) const { throw DamagedFile(fmt::format("{}: {}", name_, words)); }

void Entries::add_number(std::string key, Real value) { add(std::move(key), fmt::format("{}", value)); }
void Entries::add_count(std::string key, std::int64_t value) { add(std::move(key), std::to_string(value)); }

const std::string& Entries::text(std::string_view key) const {
  for (const auto& [name, value] : entries_)
    if (name == key) return value;
  fail(fmt::format("its head has no line '{}'", key));
}

Real Entries::number(std::string_view key) const {
  Real value = 0;
  if (!parse(text(key), value)) fail(fmt::format("'{} {}' in its head is not a number", key, text(key)));
  return value;
}

std::int64_t Entries::count(std::string_view key) const {
  std::int64_t value = 0;
  if (!parse(text(key), value)) fail(fmt::format("'{} {}' in its head is not a whole number", key, text(key)));
  return value;
}

std::vector<std::string> Entries::all(std::string_view key) const {
  std::vector<std::string> found;
  for (const auto& [name, value] : entries_)
    if (name == key) found.push_back(value);
  return found;
}

std::string Entries::written() const { return fmt::format("{} {}\n", protocol_name, protocol_version) + lines(); }

std::string Entries::lines() const {
  std::string text;
  for (const auto& [key, value] : entries_) text += fmt::format("{} {}\n", key, value);
  return text;
}

}  // namespace sazare::coupling
