#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/table_problems.hpp"
#include "sazare/cases/soil/backbone.hpp"

namespace sazare::cases {
namespace {

constexpr Real first_ratio = 0.98;  // a curve begins at 1, measured to 2 %

class ReductionReader {
public:
  ReductionReader(ModulusReduction& table, int source, const Place& named_at, Problems& problems)
      : table_(table), lines_(problems.source(source).lines), faults_(source, named_at, problems, "table") {}

  void run() {
    if (lines_.empty()) return faults_.report(0, {}, "the table of G/G0 is empty", help_for_header());
    separator_ = separator_of(lines_[0]);
    if (!read_header(lines_[0]))
      return faults_.report(1, trimmed(lines_[0], 0, lines_[0].size()), "wrong header", help_for_header());
    faults_.read_rows(lines_, [&](int line, std::string_view text) { read_row(line, text); });
    if (!faults_.any() && rows_.size() < 2)
      faults_.report(0, {}, fmt::format("the table of G/G0 has {}, at least 2 are needed", rows_.empty() ? "no rows" : "1 row"),
                     "the stress is linear between rows");
    if (!faults_.any()) check_bend();
    if (faults_.any()) table_ = {};
  }

private:
  struct Row {
    int line = 0;
    Field ratio;
  };

  static std::string help_for_header() {
    return "the first line is \"shear_strain [-],modulus_ratio [-]\", and may go on with \",damping_ratio [-]\"; strains and "
           "damping "
           "ratios may be in % instead";
  }

  /// The factor of a title's unit; 0 where it is another title.
  static Real factor_of(std::string_view title, std::string_view name) {
    if (title == fmt::format("{} [-]", name)) return 1;
    return title == fmt::format("{} [%]", name) ? 0.01 : 0;
  }

  bool read_header(std::string_view line) {
    const auto titles = split(line, separator_);
    columns_ = titles.size();
    if (columns_ != 2 && columns_ != 3) return false;
    strain_factor_ = factor_of(titles[0].text, "shear_strain");
    if (columns_ == 3) damping_factor_ = factor_of(titles[2].text, "damping_ratio");
    return strain_factor_ > 0 && titles[1].text == "modulus_ratio [-]" && damping_factor_ > 0;
  }

  void read_row(int line, std::string_view text) {
    const auto fields = split(text, separator_);
    if (fields.size() != columns_)
      return faults_.report(line, trimmed(text, 0, text.size()),
                            fmt::format("{} numbers were expected, found {} field{}", columns_ == 2 ? "two" : "three",
                                        fields.size(), fields.size() == 1 ? "" : "s"),
                            "a row has a number under each title");
    Real strain = 0, ratio = 0, damping = 0;
    const bool good_strain =
        faults_.read_number(line, fields[0], "shear strain", strain) && check_strain(line, fields[0], strain);
    bool good = faults_.read_number(line, fields[1], "G/G0", ratio) && good_strain;
    if (columns_ == 3)
      good = faults_.read_number(line, fields[2], "damping ratio", damping) && check_damping(line, fields[2], damping) && good;
    strain *= strain_factor_;
    if (!good) is_first_ = false;
    if (!good || !check_ratio(line, fields[1], strain, ratio)) return;
    rows_.push_back({line, fields[1]});
    table_.strain.push_back(strain);
    table_.ratio.push_back(ratio);
    if (columns_ == 3) table_.damping.push_back(damping * damping_factor_);
  }

  bool check_strain(int line, const Field& field, Real strain) {
    if (!(strain > 0)) {
      faults_.report(line, field, fmt::format("shear strain must be greater than 0, found {}", field.text),
                     "a curve of G/G0 is over the amplitude of the strain; at no strain it is 1");
      return false;
    }
    if (!table_.strain.empty() && !(strain * strain_factor_ > table_.strain.back())) {
      faults_.report(line, field,
                     fmt::format("shear strains must increase: {} comes after {} in line {}", field.text,
                                 short_number(table_.strain.back() / strain_factor_, 12), rows_.back().line),
                     "sort the rows by strain and keep one row for each");
      return false;
    }
    return true;
  }

  bool check_damping(int line, const Field& field, Real damping) {
    if (damping >= 0 && damping * damping_factor_ <= 1) return true;
    faults_.report(line, field, fmt::format("a damping ratio lies between 0 and 1 (100 %), found {}", field.text),
                   "check the number, and the unit of the header");
    return false;
  }

  bool check_ratio(int line, const Field& field, Real strain, Real ratio) {
    if (!(ratio > 0) || ratio > 1) {
      faults_.report(line, field, fmt::format("G/G0 must be greater than 0 and at most 1, found {}", field.text),
                     "divide the shear moduli by that at small strain");
      return false;
    }
    if (std::exchange(is_first_, false)) {
      if (ratio >= first_ratio) return true;
      faults_.report(line, field, fmt::format("the curve must begin at G/G0 = 1, to within 2 %, found {}", field.text),
                     "add rows at smaller strains, down to where the stiffness is that of youngs_modulus");
      return true;
    }
    if (table_.ratio.empty()) return true;
    if (ratio > table_.ratio.back()) {
      faults_.report(line, field,
                     fmt::format("G/G0 must not rise with the strain: {} comes after {} in line {}", field.text,
                                 short_number(table_.ratio.back()), rows_.back().line),
                     "soil does not become stiffer with strain; is a number wrong?");
      return false;
    }
    const Real least = table_.ratio.back() * table_.strain.back() / strain;
    if (ratio >= least * (1 - 1e-9)) return true;
    faults_.report(line, field,
                   fmt::format("the stress falls: G/G0 must be at least {} here, so that G/G0 times strain does not, found {}",
                               short_number(least), field.text),
                   "this law does not soften; end the table where the stress is largest");
    return false;
  }

  /// A curve whose stress becomes stiffer with strain is not the sum of parts that yield.
  void check_bend() {
    const auto lifts = lifts_of(table_);
    for (std::size_t i = 0; i < lifts.size() && !faults_.are_full(); ++i)
      if (lifts[i] > most_lifted)
        faults_.report(rows_[i].line, rows_[i].ratio,
                       fmt::format("the stress becomes stiffer after this row: G/G0 must be at least {} here, found {}",
                                   short_number(table_.ratio[i] * (1 + lifts[i])), rows_[i].ratio.text),
                       "stress over strain bends one way only, as between the rows around it; is a number wrong?");
  }

  ModulusReduction& table_;
  std::vector<std::string> lines_;  // rows point into it
  TableProblems faults_;
  char separator_ = ',';
  std::size_t columns_ = 0;
  Real strain_factor_ = 0, damping_factor_ = 1;
  std::vector<Row> rows_;
  bool is_first_ = true;
};

}  // namespace

void read_modulus_reduction(SoilBackbone& soil, const std::string& shown_name, const Place& named_at, Problems& problems) {
  const auto source = add_text_file(soil.modulus_reduction, shown_name, "the table of G/G0", named_at, problems);
  if (source) ReductionReader(soil.reduction, *source, named_at, problems).run();
}

}  // namespace sazare::cases
