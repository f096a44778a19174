#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/cases/format/problems.hpp"
#include "sazare/core/vector.hpp"

/// Tables of numbers in text files, read with one strictness for all: a field is one number and nothing else, and an empty field
/// is none.
namespace sazare::cases {

/// A piece of a line that knows where it stands; columns count from 1.
struct Field {
  std::string_view text;
  int column = 1;
};

/// What stands between two places of a line, without blanks around it.
Field trimmed(std::string_view line, std::size_t begin, std::size_t end);

/// What separates the fields of a table, by its line of titles: semicolons, else commas, else tabs.
char separator_of(std::string_view titles);

/// What stands between separators.
std::vector<Field> split(std::string_view line, char separator);

/// Words between blanks and tabs.
std::vector<Field> words_of(std::string_view line);

/// The fields of a row without titles: between semicolons or commas where the line has any, else the words between blanks.
std::vector<Field> fields_of_row(std::string_view line);

/// What is wrong with a number; `what` is empty where nothing is.
struct NumberProblem {
  std::string what, help;
};
NumberProblem read_number_field(const Field& field, std::string_view name, Real& value);

/// Reads a text file that a case names into the sources of `problems`, without byte order mark and with lines of any system, and
/// returns its index; reports a file that cannot be read or is no text. `what` is "the record", say.
std::optional<int> add_text_file(const std::filesystem::path& file, const std::string& shown_name, std::string_view what,
                                 const Place& named_at, Problems& problems);

}  // namespace sazare::cases
