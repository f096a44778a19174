#include "sazare/geometry/gmsh/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/core/plain_text.hpp"

namespace sazare::geometry {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// Shown in a message: short, and without bytes that a terminal would not print.
std::string printable(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string shown(word.substr(0, longest));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > longest ? shown + "..." : shown;
}

std::string read_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw UserError(fmt::format("{}: there is no such mesh file. Check the name, or generate it with gmsh", file.string()));
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw UserError(fmt::format("{}: is not a file. Name a Gmsh mesh (.msh)", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string reason = std::generic_category().message(errno);
  if (!stream) throw UserError(fmt::format("{}: cannot be opened: {}. Check its permissions", file.string(), reason));
  std::string text(static_cast<std::size_t>(std::filesystem::file_size(file, error)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.empty()) throw UserError(fmt::format("{}: the mesh file is empty. Generate it again with gmsh", file.string()));
  return text;
}

}  // namespace

GmshScanner::GmshScanner(std::filesystem::path file) : file_(std::move(file)), text_(read_file(file_)) {
  position_ = text_.size() - without_byte_order_mark(text_).size();
}

void GmshScanner::fail(std::string_view message) const {
  const std::string in = section_.empty() ? "" : fmt::format("${}: ", section_);
  if (binary_) throw UserError(fmt::format("{}: byte {}: {}{}", file_.string(), position_, in, message));
  const std::size_t end = std::min(position_, text_.size());
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  throw UserError(fmt::format("{}:{}: {}{}", file_.string(), line, in, message));
}

void GmshScanner::fail_truncated(std::string_view what) const {
  fail(fmt::format("the file ends where {} should be: it is truncated. Write or copy it again", what));
}

void GmshScanner::skip_space() {
  while (position_ < text_.size() && is_space(text_[position_])) ++position_;
}

bool GmshScanner::next_section() {
  section_.clear();
  skip_space();
  if (position_ == text_.size()) return false;
  const std::size_t line_end = std::min(text_.find('\n', position_), text_.size());
  std::string_view name(text_.data() + position_, line_end - position_);
  while (!name.empty() && is_space(name.back())) name.remove_suffix(1);
  if (name.size() < 2 || name[0] != '$') {
    fail(fmt::format("a section such as $Nodes should begin here, not '{}'. Is this a Gmsh mesh (.msh)?", printable(name)));
  }
  section_ = name.substr(1);
  position_ = std::min(line_end + 1, text_.size());
  return true;
}

void GmshScanner::end_section() {
  skip_space();
  const std::string mark = "$End" + section_;
  if (position_ == text_.size()) fail_truncated(mark);
  const std::string_view word = read_word(mark);
  if (word != mark) {
    if (mark.starts_with(word)) fail_truncated(mark);
    fail(fmt::format("{} should be here, not '{}': the section has more than it announces. Write the file again", mark,
                     printable(word)));
  }
  section_.clear();
}

void GmshScanner::skip_section() {
  const std::size_t end = text_.find("$End" + section_, position_);
  if (end == std::string::npos) {
    position_ = text_.size();
    fail_truncated("$End" + section_);
  }
  position_ = end;
  end_section();
}

std::string_view GmshScanner::read_word(std::string_view what) {
  skip_space();
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
  if (position_ == begin) fail_truncated(what);
  return std::string_view(text_).substr(begin, position_ - begin);
}

std::string GmshScanner::read_quoted(std::string_view what) {
  skip_space();
  if (position_ == text_.size()) fail_truncated(what);
  if (text_[position_] != '"') return std::string(read_word(what));
  const std::size_t end = text_.find('"', position_ + 1);
  if (end == std::string::npos) fail_truncated(what);
  std::string result = text_.substr(position_ + 1, end - position_ - 1);
  position_ = end + 1;
  return result;
}

std::int64_t GmshScanner::read_text_integer(std::string_view what) {
  const std::string_view word = read_word(what);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc{} && end == word.data() + word.size()) return value;
  position_ -= word.size();
  if (word[0] == '$') {
    fail(fmt::format("the section ends where {} should be: it has less than it announces. Write the file again", what));
  }
  fail(fmt::format("{} should be a whole number, not '{}'. Write the file again", what, printable(word)));
}

template <class T>
T GmshScanner::read_bytes(std::string_view what) {
  T value;
  if (remaining() < sizeof(T)) {
    position_ = text_.size();
    fail_truncated(what);
  }
  std::memcpy(&value, text_.data() + position_, sizeof(T));
  position_ += sizeof(T);
  return value;
}

std::int32_t GmshScanner::read_integer(std::string_view what) {
  if (binary_) return read_bytes<std::int32_t>(what);
  const std::int64_t value = read_text_integer(what);
  if (value < INT32_MIN || value > INT32_MAX) {
    fail(fmt::format("{} is {}, which is too large for any mesh. Write the file again", what, value));
  }
  return static_cast<std::int32_t>(value);
}

std::int64_t GmshScanner::read_long(std::string_view what) {
  return binary_ ? read_bytes<std::int64_t>(what) : read_text_integer(what);
}

std::int64_t GmshScanner::read_count(std::string_view what, std::size_t item_bytes) {
  const std::int64_t count = read_long(what);
  if (count < 0) fail(fmt::format("{} is {}, but must not be negative. Write the file again", what, count));
  constexpr std::size_t shortest_word = 2;  // a digit and a space
  const std::size_t room = remaining() / (binary_ ? item_bytes : shortest_word);
  if (static_cast<std::size_t>(count) > room) {
    fail(fmt::format(
        "{} is {}, but the rest of the file has space for {} at most: it is truncated or damaged. Write or copy it again", what,
        count, room));
  }
  return count;
}

Real GmshScanner::read_real(std::string_view what) {
  if (binary_) return read_bytes<Real>(what);
  const std::string_view word = read_word(what);
  Real value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end == word.data() + word.size()) {
    // Out of range is infinity or zero: the check of the coordinates will say so with the node's number.
    return error == std::errc{} ? value : std::strtod(std::string(word).c_str(), nullptr);
  }
  position_ -= word.size();
  if (word[0] == '$') {
    fail(fmt::format("the section ends where {} should be: it has less than it announces. Write the file again", what));
  }
  fail(fmt::format("{} should be a number, not '{}'. Write the file again", what, printable(word)));
}

void GmshScanner::skip_bytes(std::size_t bytes) {
  if (bytes > remaining()) {
    position_ = text_.size();
    fail_truncated("more data");
  }
  position_ += bytes;
}

}  // namespace sazare::geometry
