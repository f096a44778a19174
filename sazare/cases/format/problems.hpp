#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

/// Collects everything that is wrong with a case, and prints it the way compilers do: place, line, caret,
/// what to do.
namespace sazare::cases {

/// A piece of text that was read: a file, or an override from the command line.
struct Source {
  std::string name;  // as the user would type it: "cases/x/case.toml", "--set time.end"
  std::vector<std::string> lines;
  bool has_line_numbers = true;
};

Source source_from_text(std::string name, std::string_view text);

/// Where in a source; line 0 means the source as a whole. Columns count characters, from 1.
struct Place {
  int source = 0;
  int line = 0;
  int column = 0;
  int width = 1;
  auto operator<=>(const Place&) const = default;
};

struct Problem {
  Place place;
  std::string what;
  std::string help;
  Place order{};  // where it is listed; `place` unless the problem lies in a file that the case names
};

class Problems {
public:
  /// Returns the index to use as `Place::source`. The case file itself is added first.
  int add_source(Source source);

  void error(Place place, std::string what, std::string help);
  void error_in_other_file(Place place, Place listed_at, std::string what, std::string help);
  void warning(Place place, std::string what, std::string help);

  /// Refuses what would only be warned about.
  void turn_warnings_into_errors();

  bool has_errors() const { return !errors_.empty(); }
  int source_count() const { return static_cast<int>(sources_.size()); }
  const Source& source(int index) const { return sources_.at(static_cast<std::size_t>(index)); }

  /// Errors in file order, followed by their number and "nothing was run".
  std::string error_text() const;
  std::string warning_text() const;

  /// Throws a UserError with `error_text()` if there is any error.
  void throw_if_errors() const;

private:
  std::string text(std::vector<Problem> list, std::string_view kind) const;
  void append(std::string& out, const Problem& problem, std::string_view kind) const;

  std::vector<Source> sources_;
  std::vector<Problem> errors_;
  std::vector<Problem> warnings_;
};

}  // namespace sazare::cases
