#include "sazare/methods/blocks/case/pressure_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/table_problems.hpp"

namespace sazare::cases {
namespace {

constexpr std::string_view header = "time [s],pressure [Pa]";

class TableReader {
public:
  TableReader(PressureTable& table, int source, const Place& named_at, Problems& problems)
      : table_(table), lines_(problems.source(source).lines), faults_(source, named_at, problems, "table") {}

  void run() {
    if (lines_.empty()) {
      faults_.report(0, {}, "the pressure table is empty", help_for_header());
      return;
    }
    separator_ = separator_of(lines_[0]);
    if (!is_header(lines_[0])) faults_.report(1, trimmed(lines_[0], 0, lines_[0].size()), "wrong header", help_for_header());
    faults_.read_rows(lines_, [&](int line, std::string_view text) { read_row(line, text); });
    if (!faults_.any() && table_.time.size() < 2)
      faults_.report(0, {},
                     fmt::format("the pressure table has {}, at least 2 are needed", table_.time.empty() ? "no rows" : "1 row"),
                     "pressure is linear between rows, and zero before the first and after the last");
  }

private:
  static std::string help_for_header() { return fmt::format("the first line is \"{}\"", header); }

  bool is_header(std::string_view line) const {
    const auto fields = split(line, separator_);
    return fields.size() == 2 && fields[0].text == "time [s]" && fields[1].text == "pressure [Pa]";
  }

  void read_row(int line, std::string_view text) {
    const auto fields = split(text, separator_);
    if (fields.size() != 2) {
      faults_.report(line, trimmed(text, 0, text.size()),
                     fmt::format("two numbers were expected, found {} field{}", fields.size(), fields.size() == 1 ? "" : "s"),
                     "a row is time and pressure with a comma between them");
      return;
    }
    Real time = 0, pressure = 0;
    const bool good_time = faults_.read_number(line, fields[0], "time", time);
    const bool good_pressure = faults_.read_number(line, fields[1], "pressure", pressure);
    if (good_time) check_order(line, fields[0], time);
    if (!good_time || !good_pressure) return;
    table_.time.push_back(time);
    table_.pressure.push_back(pressure);
  }

  void check_order(int line, const Field& field, Real time) {
    if (time < 0)
      faults_.report(line, field, fmt::format("time must be at least 0, found {}", field.text),
                     "times count from the delay of the blast");
    else if (last_line_ > 0 && !(time > last_time_))
      faults_.report(line, field,
                     fmt::format("times must increase: {} s comes after {} s in line {}", short_number(time, 12),
                                 short_number(last_time_, 12), last_line_),
                     "sort the rows by time and keep one row for each time");
    last_time_ = time;
    last_line_ = line;
  }

  PressureTable& table_;
  std::vector<std::string> lines_;
  TableProblems faults_;
  char separator_ = ',';
  Real last_time_ = 0;
  int last_line_ = 0;
};

}  // namespace

void read_pressure_table(PressureTable& table, const std::string& shown_name, const Place& named_at, Problems& problems) {
  const auto source = add_text_file(table.file, shown_name, "the pressure table", named_at, problems);
  if (source) TableReader(table, *source, named_at, problems).run();
}

}  // namespace sazare::cases
