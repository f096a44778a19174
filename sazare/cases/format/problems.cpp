#include "sazare/cases/format/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "sazare/core/error.hpp"

namespace sazare::cases {
namespace {

struct Character {
  std::size_t begin = 0;
  std::size_t size = 1;
  int columns = 1;  // on a terminal
};

bool is_wide(std::uint32_t code) {
  return (code >= 0x1100 && code <= 0x115f) || (code >= 0x2e80 && code <= 0xa4cf) || (code >= 0xac00 && code <= 0xd7a3) ||
         (code >= 0xf900 && code <= 0xfaff) || (code >= 0xfe30 && code <= 0xfe6f) || (code >= 0xff00 && code <= 0xff60) ||
         (code >= 0x1f300 && code <= 0x1faff) || (code >= 0x20000 && code <= 0x3fffd);
}

std::vector<Character> characters(std::string_view line) {
  std::vector<Character> result;
  for (std::size_t i = 0; i < line.size();) {
    const auto lead = static_cast<unsigned char>(line[i]);
    std::size_t size = lead < 0xc0 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    size = std::min(size, line.size() - i);
    std::uint32_t code = size == 1 ? lead : lead & (0xffU >> (size + 1));
    for (std::size_t k = 1; k < size; ++k) code = (code << 6) | (static_cast<unsigned char>(line[i + k]) & 0x3fU);
    result.push_back({i, size, is_wide(code) ? 2 : 1});
    i += size;
  }
  return result;
}

/// The caret line under `line`: tabs kept, so that the caret stands under its place whatever the tab width.
std::string caret(std::string_view line, int column, int width) {
  const auto cells = characters(line);
  std::string out;
  const auto begin = static_cast<std::size_t>(std::max(column - 1, 0));
  for (std::size_t i = 0; i < begin; ++i) {
    if (i < cells.size() && line[cells[i].begin] == '\t')
      out += '\t';
    else
      out.append(i < cells.size() ? static_cast<std::size_t>(cells[i].columns) : 1, ' ');
  }
  std::size_t marks = 0;
  const std::size_t end = std::min(begin + static_cast<std::size_t>(std::max(width, 1)), cells.size());
  for (std::size_t i = begin; i < end; ++i) marks += static_cast<std::size_t>(cells[i].columns);
  return out + '^' + std::string(marks > 1 ? marks - 1 : 0, '~');
}

constexpr std::size_t long_line = 400, part_of_line = 200;    // characters
constexpr std::size_t long_text = 2000, part_of_text = 1000;  // bytes

/// What of a line is shown: all of it, or of a very long one what is about its place.
struct Excerpt {
  std::string line;
  int column = 1;
};

Excerpt excerpt_of(std::string_view line, int column) {
  const auto cells = characters(line);
  if (cells.size() <= long_line) return {std::string(line), column};
  const auto place = std::min(static_cast<std::size_t>(std::max(column - 1, 0)), cells.size() - 1);
  const std::size_t begin = place > part_of_line / 2 ? place - part_of_line / 2 : 0,
                    end = std::min(begin + part_of_line, cells.size());
  const std::size_t first = cells[begin].begin, last = cells[end - 1].begin + cells[end - 1].size;
  const std::string before = begin > 0 ? "..." : "", after = end < cells.size() ? "..." : "";
  return {before + std::string(line.substr(first, last - first)) + after, static_cast<int>(place - begin + before.size()) + 1};
}

/// A text that holds a very long word of a file, without the middle of it.
std::string shortened(const std::string& text) {
  if (text.size() <= long_text) return text;
  const auto is_inside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U; };
  std::size_t end = part_of_text, next = text.size() - part_of_text / 2;
  while (end > 0 && is_inside(end)) --end;
  while (is_inside(next) && next + 1 < text.size()) ++next;
  return text.substr(0, end) + fmt::format(" ... {} bytes more ... ", next - end) + text.substr(next);
}

/// Control characters would garble a terminal.
std::string printable(std::string_view text) {
  std::string out;
  for (char c : text) {
    const bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
    out += control ? '?' : c;
  }
  return out;
}

}  // namespace

Source source_from_text(std::string name, std::string_view text) {
  Source source{std::move(name), {}, true};
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    source.lines.emplace_back(line);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return source;
}

int Problems::add_source(Source source) {
  sources_.push_back(std::move(source));
  return static_cast<int>(sources_.size()) - 1;
}

void Problems::error(Place place, std::string what, std::string help) {
  errors_.push_back({place, std::move(what), std::move(help), place});
}

void Problems::error_in_other_file(Place place, Place listed_at, std::string what, std::string help) {
  errors_.push_back({place, std::move(what), std::move(help), listed_at});
}

void Problems::warning(Place place, std::string what, std::string help) {
  warnings_.push_back({place, std::move(what), std::move(help), place});
}

void Problems::turn_warnings_into_errors() {
  for (Problem& problem : warnings_) errors_.push_back(std::move(problem));
  warnings_.clear();
}

void Problems::append(std::string& out, const Problem& problem, std::string_view kind) const {
  const Place& place = problem.place;
  const Source& from = source(place.source);
  out += printable(from.name);
  if (place.line > 0 && from.has_line_numbers) out += fmt::format(":{}:{}", place.line, place.column);
  out += fmt::format(": {}: {}\n", kind, shortened(printable(problem.what)));
  const auto index = static_cast<std::size_t>(place.line - 1);
  if (place.line > 0 && index < from.lines.size()) {
    const std::string number = from.has_line_numbers ? fmt::format("{:>5} | ", place.line) : "      | ";
    const Excerpt shown = excerpt_of(from.lines[index], place.column);
    out += number + printable(shown.line) + '\n';
    out += "      | " + caret(shown.line, shown.column, place.width) + '\n';
  }
  if (!problem.help.empty()) out += fmt::format("      help: {}\n", shortened(printable(problem.help)));
}

std::string Problems::text(std::vector<Problem> list, std::string_view kind) const {
  const auto key = [](const Problem& problem) {
    Place place = problem.order;
    if (place.line == 0) place.line = 1 << 30;
    return std::tuple(place.source, place.line, place.column, problem.place);
  };
  std::stable_sort(list.begin(), list.end(), [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
  std::string out;
  for (const Problem& problem : list) append(out, problem, kind);
  return out;
}

std::string Problems::error_text() const {
  const std::size_t count = errors_.size();
  return text(errors_, "error") + fmt::format("{} error{}; nothing was run", count, count == 1 ? "" : "s");
}

std::string Problems::warning_text() const { return text(warnings_, "warning"); }

void Problems::throw_if_errors() const {
  if (has_errors()) throw UserError(error_text());
}

}  // namespace sazare::cases
