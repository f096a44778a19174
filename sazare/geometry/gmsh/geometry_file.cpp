#include "sazare/geometry/gmsh/geometry_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "sazare/core/error.hpp"

namespace sazare::geometry {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_string = 1000;  // Gmsh cuts strings at 1023 characters, and takes the rest for code
constexpr std::size_t most_files = 200;

/// Words that stand in no geometry for another purpose: refused wherever they are.
constexpr std::array words_anywhere = {"SystemCall",   "NonBlockingSystemCall", "OnelabRun",   "OnelabAction",
                                       "SendToServer", "ExternalProcess",       "CommandLine", "CreateDir"};

/// Words that are commands, options of files and programs, or ways to make such a word from a string; refused in code.
constexpr std::array words_in_code = {"System", "Print",         "Save",         "Plugin",       "Solver",
                                      "Sleep",  "ShapeFromFile", "ListFromFile", "StringToName", "S2N"};

/// Commands that read another file.
constexpr std::array reading_words = {"Include", "Merge", "MergeWithBoundingBox"};

/// Formats that describe shapes and nothing else; files of other formats are programs to Gmsh.
constexpr std::array shape_formats = {".stl", ".step", ".stp", ".iges", ".igs", ".brep", ".msh"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_letter_or_digit(char c) { return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Reads one file of Gmsh's language word by word, as Gmsh does.
class Scanner {
public:
  Scanner(const fs::path& file, const fs::path& folder, std::string text, std::set<fs::path>& seen)
      : file_(file), folder_(folder), text_(std::move(text)), seen_(seen) {}

  void run() {
    if (text_.find('\0') != std::string::npos) fail("it has bytes of value 0, and is no text");
    for (const std::string_view word : words_anywhere)
      if (const std::size_t at = text_.find(word); at != std::string::npos) {
        at_ = at;
        fail(fmt::format("it uses {}", word));
      }
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (text_[at_] == '"' || text_[at_] == '\'')
        read_string();
      else if (is_letter(text_[at_]))
        check_word(read_word());
      else
        ++at_;
    }
  }

private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    throw UserError(
        fmt::format("{}:{}: {}; a geometry may describe shapes only, since one from a stranger could run commands and change "
                    "files. If you have "
                    "read this file and trust it, add --trust-geometry, or set SAZARE_TRUST_GEOMETRY=1 in the environment",
                    file_.string(), line, what));
  }

  /// Past blanks and comments.
  void skip_blanks() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_]))
        ++at_;
      else if (text_.compare(at_, 2, "//") == 0)
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string::npos) fail("a comment does not end");
        at_ = end + 2;
      } else
        return;
    }
  }

  std::string read_string() {
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string::npos || end - at_ > longest_string) fail("a string does not end, or is too long");
    std::string string = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return string;
  }

  std::string read_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter_or_digit(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool stands_at(char c) const { return at_ < text_.size() && text_[at_] == c; }

  void check_word(const std::string& word) {
    const std::size_t end = at_;
    skip_blanks();
    if (word == "Print" && stands_at('.')) return;  // options of pictures
    if (std::ranges::find(words_in_code, word) != words_in_code.end()) fail(fmt::format("it uses {}", word));
    const std::string lower = lower_case(word);
    if (lower.find("filename") != std::string::npos || lower.starts_with("executable"))
      if (word != "CurrentFileName" && word != "GmshExecutableName") fail(fmt::format("it uses {}", word));
    if (word == "Printf" || word == "Error" || word == "Warning") return check_message(word);
    if (std::ranges::find(reading_words, word) != reading_words.end()) return check_file(word);
    at_ = end;
  }

  /// Printf("text") > "file" writes to the file.
  void check_message(const std::string& word) {
    if (!stands_at('(')) return;
    int depth = 0;
    do {
      skip_blanks();
      if (at_ == text_.size()) return;
      if (text_[at_] == '"' || text_[at_] == '\'') {
        read_string();
        continue;
      }
      if (is_letter(text_[at_])) {
        check_word(read_word());
        continue;
      }
      depth += text_[at_] == '(' ? 1 : text_[at_] == ')' ? -1 : 0;
      ++at_;
    } while (depth > 0);
    skip_blanks();
    if (stands_at('>')) fail(fmt::format("{} writes to a file", word));
  }

  void check_file(const std::string& word) {
    if (!stands_at('"') && !stands_at('\''))
      fail(fmt::format("{} is followed by something else than the name of a file in quotes", word));
    const fs::path name = read_string();
    skip_blanks();
    if (!stands_at(';')) fail(fmt::format("{} is followed by something else than the name of a file in quotes", word));
    std::error_code error;
    const fs::path other = fs::weakly_canonical(folder_ / name, error);
    const auto [at_folder, at_other] = std::ranges::mismatch(folder_, other);
    if (error || name.is_absolute() || at_folder != folder_.end())
      fail(fmt::format("it reads {}, which lies outside of its folder", name.string()));
    const std::string format = lower_case(other.extension().string());
    const bool holds_shapes = word != "Include" && std::ranges::find(shape_formats, format) != shape_formats.end();
    if (!holds_shapes) scan(other, folder_, seen_);
  }

public:
  static void scan(const fs::path& file, const fs::path& folder, std::set<fs::path>& seen) {
    if (!seen.insert(file).second) return;
    if (seen.size() > most_files) throw UserError(fmt::format("{}: the geometry includes too many files", file.string()));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    std::error_code error;
    if (!stream || !fs::is_regular_file(file, error))
      throw UserError(fmt::format("{}: there is no such geometry file, or it cannot be read. Check the name", file.string()));
    Scanner(file, folder, text.str(), seen).run();
  }

private:
  const fs::path& file_;
  const fs::path& folder_;
  std::string text_;
  std::set<fs::path>& seen_;
  std::size_t at_ = 0;
};

}  // namespace

bool geometries_are_trusted() {
  const char* trust = std::getenv("SAZARE_TRUST_GEOMETRY");
  return trust != nullptr && std::string_view(trust) == "1";
}

void refuse_what_reaches_outside(const fs::path& geometry) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(geometry).parent_path(), error);
  std::set<fs::path> seen;
  Scanner::scan(geometry, folder, seen);
  fs::path options = geometry;
  options += ".opt";
  if (fs::exists(fs::symlink_status(options, error))) Scanner::scan(options, folder, seen);
}

}  // namespace sazare::geometry
