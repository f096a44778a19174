#include <fmt/format.h>

#include <array>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/table_problems.hpp"
#include "sazare/cases/water/checks.hpp"

namespace sazare::cases {
namespace {

constexpr std::array<std::string_view, 3> titles{"time [s]", "elevation [m]", "velocity [m/s]"};
constexpr std::string_view help_for_header = "the first line is \"time [s],elevation [m],velocity [m/s]\"";

class RecordReader {
public:
  RecordReader(laws::WaterRecord& record, int source, const Place& named_at, Problems& problems)
      : record_(record), lines_(problems.source(source).lines), faults_(source, named_at, problems, "table") {}

  bool run() {
    if (lines_.empty()) return fault(0, {}, "the table of waves is empty", help_for_header);
    separator_ = separator_of(lines_[0]);
    const auto found = split(lines_[0], separator_);
    bool right = found.size() == titles.size();
    for (std::size_t n = 0; right && n < titles.size(); ++n) right = found[n].text == titles[n];
    if (!right) return fault(1, trimmed(lines_[0], 0, lines_[0].size()), "wrong header", help_for_header);
    faults_.read_rows(lines_, [&](int line, std::string_view text) { read_row(line, text); });
    if (!faults_.any() && record_.time.empty()) return fault(0, {}, "the table of waves has no rows", "give at least one");
    return !faults_.any();
  }

private:
  bool fault(int line, const Field& field, const std::string& what, std::string_view help) {
    faults_.report(line, field, what, std::string(help));
    return false;
  }

  void read_row(int line, std::string_view text) {
    const auto fields = split(text, separator_);
    if (fields.size() != titles.size()) {
      fault(line, trimmed(text, 0, text.size()), fmt::format("three numbers were expected, found {} field{}", fields.size(),
                                                             fields.size() == 1 ? "" : "s"),
            "a row has a number under each title");
      return;
    }
    std::array<Real, 3> row{};
    bool good = true;
    for (std::size_t n = 0; n < titles.size(); ++n)
      good = faults_.read_number(line, fields[n], titles[n].substr(0, titles[n].find(' ')), row[n]) && good;
    if (!good) return;
    if (!record_.time.empty() && !(row[0] > record_.time.back())) {
      fault(line, fields[0], fmt::format("times must increase: {} comes after {}", fields[0].text,
                                         short_number(record_.time.back(), 12)),
            "sort the rows by time and keep one row for each");
      return;
    }
    record_.time.push_back(row[0]);
    record_.elevation.push_back(row[1]);
    record_.velocity.push_back(row[2]);
  }

  laws::WaterRecord& record_;
  std::vector<std::string> lines_;  // rows point into it
  TableProblems faults_;
  char separator_ = ',';
};

}  // namespace

void read_water_record(Water& water, const std::string& shown_name, const Place& named_at, Problems& problems) {
  const auto source = add_text_file(water.wave_file, shown_name, "the table of waves", named_at, problems);
  if (!source) return;
  laws::WaterRecord record;
  if (RecordReader(record, *source, named_at, problems).run()) water.record = std::make_shared<laws::WaterRecord>(std::move(record));
}

}  // namespace sazare::cases
