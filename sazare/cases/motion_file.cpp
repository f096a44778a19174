#include "sazare/cases/motion_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

#include "sazare/cases/format/csv_fields.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/units.hpp"

namespace sazare::cases {
namespace {

constexpr Real time_tolerance = 1e-4;       // of a step, within which rows of a CSV are equally spaced

constexpr Real largest_value = 1e30;  // SI units; beyond it a record is none, and sums over it overflow

struct Unit {
  std::string_view name;
  laws::MotionQuantity quantity;
  Real factor;
};

constexpr std::array units{
    Unit{"m/s2", laws::MotionQuantity::acceleration, 1},   Unit{"g", laws::MotionQuantity::acceleration, standard_gravity},
    Unit{"gal", laws::MotionQuantity::acceleration, 0.01}, Unit{"cm/s2", laws::MotionQuantity::acceleration, 0.01},
    Unit{"m/s", laws::MotionQuantity::velocity, 1},        Unit{"cm/s", laws::MotionQuantity::velocity, 0.01},
    Unit{"m", laws::MotionQuantity::displacement, 1},      Unit{"cm", laws::MotionQuantity::displacement, 0.01},
};

struct Quantity {
  std::string_view name;
  laws::MotionQuantity quantity;
};

constexpr std::array quantities{
    Quantity{"acceleration", laws::MotionQuantity::acceleration},
    Quantity{"velocity", laws::MotionQuantity::velocity},
    Quantity{"displacement", laws::MotionQuantity::displacement},
};

/// Units of acceleration in line 3 of a PEER file, in lower case.
struct PeerUnit {
  std::string_view name;
  Real factor;
};

constexpr std::array peer_units{
    PeerUnit{"g", standard_gravity}, PeerUnit{"gal", 0.01},    PeerUnit{"cm/s2", 0.01},   PeerUnit{"cm/s/s", 0.01},
    PeerUnit{"cm/sec2", 0.01},       PeerUnit{"cm/s^2", 0.01}, PeerUnit{"cm/s**2", 0.01}, PeerUnit{"cm/sec/sec", 0.01},
    PeerUnit{"cm/sec**2", 0.01},     PeerUnit{"m/s2", 1},      PeerUnit{"m/s/s", 1},      PeerUnit{"m/s^2", 1},
    PeerUnit{"m/s**2", 1},           PeerUnit{"m/sec2", 1},    PeerUnit{"m/sec/sec", 1},
};

class MotionReader {
public:
  MotionReader(Motion& motion, int source, const Place& named_at, Problems& problems)
      : motion_(motion), source_(source), named_at_(named_at), problems_(problems), lines_(problems.source(source).lines) {}

  void run() {
    const std::string kind = lower_case(motion_.file.extension().string());
    if (kind == ".csv")
      read_csv();
    else if (kind == ".at2")
      read_peer();
    else if (is_knet(kind))
      read_knet();
    else
      problems_.error(named_at_, fmt::format("{} is not in a known format of records", motion_.file.filename().string()),
                      "known formats are CSV (.csv), PEER (.AT2) and K-NET ASCII (.EW, .NS, .UD)");
    if (failed_ || values_.empty()) return;
    motion_.record = laws::Record::make(step_, std::move(values_));
  }

private:
  static std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  }

  /// .ew, .ns, .ud, and those with 1 (borehole) or 2 (surface) of KiK-net.
  static bool is_knet(std::string kind) {
    if (kind.ends_with('1') || kind.ends_with('2')) kind.pop_back();
    return kind == ".ew" || kind == ".ns" || kind == ".ud";
  }

  void report(int line, const Field& field, const std::string& what, const std::string& help) {
    failed_ = true;
    problems_.error_in_other_file({source_, line, field.column, std::max<int>(1, static_cast<int>(field.text.size()))}, named_at_,
                                  what, help);
  }

  bool take_number(int line, const Field& field, std::string_view name, Real& value) {
    NumberProblem problem = read_number_field(field, name, value);
    if (problem.what.empty()) return true;
    if (field.text.empty() || !std::isfinite(value)) problem.help = "enter the intended number; gaps in a record are not filled";
    report(line, field, problem.what, problem.help);
    return false;
  }

  /// A sample of the record in the file's unit.
  bool take_sample(int line, const Field& field, std::string_view name, Real factor) {
    Real value = 0;
    if (!take_number(line, field, name, value)) return false;
    values_.push_back(factor * value);
    if (std::abs(values_.back()) <= largest_value) return true;
    report(line, field, fmt::format("{}: {} is beyond any motion", name, field.text),
           "check the number, and the unit of the file");
    return false;
  }

  void read_csv() {
    static constexpr std::string_view help =
        "the first line has the form \"time [s],acceleration [m/s2]\"; units are m/s2, g, gal, "
        "cm/s2, m/s, cm/s, m and cm";
    if (lines_.empty()) return report(0, {}, "the record is empty", std::string(help));
    const Field first_line{lines_[0], 1};
    const char separator = separator_of(lines_[0]);
    const auto titles = split(lines_[0], separator);
    if (titles.size() != 2 || titles[0].text != "time [s]") return report(1, first_line, "wrong header", std::string(help));
    const std::size_t bracket = titles[1].text.find(" [");
    const std::string name(titles[1].text.substr(0, bracket));
    const auto quantity = std::ranges::find(quantities, name, &Quantity::name);
    const bool has_unit = bracket != std::string_view::npos;
    if (quantity == quantities.end() || (has_unit && !titles[1].text.ends_with(']')))
      return report(1, first_line, "wrong header", std::string(help));
    if (!has_unit) return report(1, first_line, fmt::format("{} has no unit", name), std::string(help));
    const std::string unit_name(titles[1].text.substr(bracket + 2, titles[1].text.size() - bracket - 3));
    const auto unit = std::ranges::find(units, unit_name, &Unit::name);
    if (unit == units.end() || unit->quantity != quantity->quantity)
      return report(1, first_line, fmt::format("{} is not a unit of {}", unit_name, name), std::string(help));
    motion_.quantity = quantity->quantity;
    read_rows(name, unit->factor, separator);
  }

  void read_rows(const std::string& name, Real factor, char separator) {
    Real last = 0;
    for (std::size_t i = 1; i < lines_.size() && !failed_; ++i) {
      const int line = static_cast<int>(i) + 1;
      if (words_of(lines_[i]).empty()) continue;
      const auto fields = split(lines_[i], separator);
      if (fields.size() != 2)
        return report(line, {lines_[i], 1}, fmt::format("two numbers were expected, found {}", fields.size()),
                      fmt::format("a row is time and {} with a {} between them", name,
                                  separator == ';'   ? "semicolon"
                                  : separator == ',' ? "comma"
                                                     : "tab"));
      Real time = 0;
      if (!take_number(line, fields[0], "time", time) || !check_time(line, fields[0], time, last)) return;
      last = time;
      if (!take_sample(line, fields[1], name, factor)) return;
    }
    if (values_.size() < 2) report(0, {}, fmt::format("the record has {} rows, at least 2 are needed", values_.size()), "");
  }

  bool check_time(int line, const Field& word, Real time, Real last) {
    if (values_.size() == 1) step_ = time - last;
    if (values_.empty() ? time == 0 : (step_ > 0 && std::abs(time - last - step_) <= time_tolerance * step_)) return true;
    if (values_.empty())
      report(line, word, fmt::format("the first time must be 0, found {}", word.text), "shift the times so that they begin at 0");
    else if (!(step_ > 0))
      report(line, word, "times must increase", "sort the rows by time");
    else
      report(line, word,
             fmt::format("times are not uniform: a step of {} s here, and a first step of {} s", short_number(time - last, 6),
                         short_number(step_, 6)),
             "resample the record to equal steps");
    return false;
  }

  void read_peer() {
    static const std::string help = "a PEER file has four header lines: title, event, units, and NPTS= n, DT= t";
    if (lines_.size() < 5) return report(0, {}, "this is not a PEER record: it is too short", help);
    motion_.quantity = laws::MotionQuantity::acceleration;
    const auto factor = peer_unit();
    if (!factor) return;
    const Field line{lines_[3], 1};
    const auto count = text_after("NPTS", lines_[3]), interval = text_after("DT", lines_[3]);
    if (!count || !interval) return report(4, line, "line 4 of a PEER record gives NPTS and DT", help);
    const std::string_view step_text = number_at(*interval);
    NumberProblem problem = read_number_field({step_text, 1}, "DT", step_);
    if (!problem.what.empty() || !(step_ > 0))
      return report(4, line, fmt::format("DT must be greater than 0, found {}", step_text), help);
    const auto rest = words_of(interval->substr(step_text.size()));
    if (!rest.empty() && !is_second(rest.front().text))
      return report(4, line, fmt::format("DT is given in \"{}\", but must be in s", rest.front().text), help);
    read_block(4, *factor);
    const std::string_view wanted = number_at(*count);
    std::size_t number = 0;
    const auto [end, failure] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    const bool is_count = failure == std::errc{} && end == wanted.data() + wanted.size();
    if (!failed_ && (!is_count || values_.size() != number))
      report(4, line, fmt::format("NPTS is {}, but {} values follow", wanted, values_.size()), "is the file complete?");
  }

  /// The unit that line 3 of a PEER record states [m/s2]: "... IN UNITS OF G". Reports what is none.
  std::optional<Real> peer_unit() {
    static const std::string help = "line 3 ends in UNITS OF G; GAL, CM/S/S, CM/SEC2 and M/S/S are read too";
    const std::string line = lower_case(lines_[2]);
    const Field field{lines_[2], 1};
    static constexpr std::string_view mark = "units of";
    const std::size_t at = line.find(mark);
    if (at == std::string::npos) {
      report(3, field, "the units are missing: line 3 of a PEER record says UNITS OF G",
             "a PEER file has four header lines: title, event, units, and NPTS= n, DT= t");
      return {};
    }
    const auto words = words_of(std::string_view(line).substr(at + mark.size()));
    const std::string_view written = words.empty() ? std::string_view{} : words.front().text;
    const std::string_view unit = written.substr(0, written.find_last_not_of(".,;:") + 1);
    const auto found = std::ranges::find(peer_units, unit, &PeerUnit::name);
    const bool has_more = words.size() > 1 && unit.size() == written.size();
    if (found == peer_units.end() || has_more || line.find("velocity") < at || line.find("displacement") < at) {
      report(3, field,
             fmt::format("\"{}\" is not a unit of acceleration that is read",
                         trimmed(lines_[2], at + mark.size(), line.size()).text),
             help);
      return {};
    }
    return found->factor;
  }

  /// What follows "KEY =" in a line.
  static std::optional<std::string_view> text_after(std::string_view key, std::string_view line) {
    for (std::size_t at = line.find(key); at != std::string_view::npos; at = line.find(key, at + 1)) {
      std::size_t next = line.find_first_not_of(" \t", at + key.size());
      if (next == std::string_view::npos || line[next] != '=') continue;
      next = line.find_first_not_of(" \t", next + 1);
      if (next != std::string_view::npos) return line.substr(next);
    }
    return {};
  }

  /// The characters at the beginning of a text that may belong to a number.
  static std::string_view number_at(std::string_view text) { return text.substr(0, text.find_first_not_of("0123456789.Ee+-")); }

  static bool is_second(std::string_view word) {
    const std::string unit = lower_case(std::string(word.substr(0, word.find_last_not_of(".,;") + 1)));
    return unit.empty() || unit == "s" || unit == "sec" || unit == "seconds";
  }

  /// Numbers in free format from a line on.
  void read_block(std::size_t first, Real factor) {
    for (std::size_t i = first; i < lines_.size() && !failed_; ++i)
      for (const Field& word : words_of(lines_[i]))
        if (!take_sample(static_cast<int>(i) + 1, word, "acceleration", factor)) return;
  }

  /// A number with its unit, such as 100Hz; 0 where it is none.
  static Real number_with(std::string_view text, std::string_view unit) {
    if (!text.ends_with(unit)) return 0;
    text.remove_suffix(unit.size());
    Real value = 0;
    return read_number_field(trimmed(text, 0, text.size()), "", value).what.empty() ? value : 0;
  }

  void read_knet() {
    static const std::string help = "a K-NET file has 17 header lines, with \"Sampling Freq(Hz)\" and \"Scale Factor\"";
    Real hertz = 0, factor = 0, duration = 0;
    std::size_t body = 0;
    for (std::size_t i = 0; i < lines_.size() && body == 0; ++i) {
      const std::string_view line = lines_[i];
      const auto rest_after = [&](std::string_view title) { return trimmed(line, title.size(), line.size()).text; };
      if (line.starts_with("Sampling Freq(Hz)")) hertz = number_with(rest_after("Sampling Freq(Hz)"), "Hz");
      if (line.starts_with("Duration Time(s)")) duration = number_with(rest_after("Duration Time(s)"), "");
      if (line.starts_with("Scale Factor")) {
        const std::string_view scale = rest_after("Scale Factor");
        const std::size_t slash = std::min(scale.find('/'), scale.size());
        const Real counts = slash < scale.size() ? number_with(scale.substr(slash + 1), "") : 0;
        factor = counts > 0 ? 0.01 * number_with(scale.substr(0, slash), "(gal)") / counts : 0;
      }
      if (line.starts_with("Memo")) body = i + 1;
    }
    if (!(hertz > 0)) return report(0, {}, "the sampling frequency is missing", help);
    if (!(factor > 0)) return report(0, {}, "the units are missing: there is no scale factor in gal", help);
    if (body == 0) return report(0, {}, "the header has no line Memo., after which the samples begin", help);
    motion_.quantity = laws::MotionQuantity::acceleration;
    step_ = 1 / hertz;
    read_block(body, factor);
    if (failed_) return;
    if (values_.size() < 2) return report(0, {}, "the record has no samples", help);
    if (duration > 0 && std::abs(duration * hertz - static_cast<Real>(values_.size())) > 0.5)
      return report(0, {},
                    fmt::format("the header announces {} s at {} Hz, {} samples, but {} follow", short_number(duration),
                                short_number(hertz), short_number(duration * hertz, 9), values_.size()),
                    "is the file complete?");
    const Real mean = std::accumulate(values_.begin(), values_.end(), Real{0}) / static_cast<Real>(values_.size());
    for (Real& value : values_) value -= mean;
  }

  Motion& motion_;
  int source_;
  Place named_at_;
  Problems& problems_;
  std::vector<std::string> lines_;
  std::vector<Real> values_;
  Real step_ = 0;
  bool failed_ = false;
};

}  // namespace

void read_motion_file(Motion& motion, const std::string& shown_name, const Place& named_at, Problems& problems) {
  const auto source = add_text_file(motion.file, shown_name, "the record", named_at, problems);
  if (source) MotionReader(motion, *source, named_at, problems).run();
}

}  // namespace sazare::cases
