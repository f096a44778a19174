#include "sazare/cases/motion_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <regex>
#include <sstream>

#include "sazare/cases/format/number_text.hpp"

namespace sazare::cases {
namespace {

constexpr Real standard_gravity = 9.80665;  // m/s2
constexpr Real time_tolerance = 1e-4;       // of a step, within which rows of a CSV are equally spaced

struct Word {
  std::string_view text;
  int column = 1;
};

/// Words between blanks and commas.
std::vector<Word> words_of(std::string_view line, std::string_view separators = " \t,") {
  std::vector<Word> words;
  for (std::size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = line.find_first_not_of(separators, end);
  }
  return words;
}

std::optional<Real> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Real value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

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

class MotionReader {
public:
  MotionReader(Motion& motion, int source, const Place& named_at, Problems& problems)
      : motion_(motion), source_(source), named_at_(named_at), problems_(problems), lines_(problems.source(source).lines) {}

  void run() {
    std::string kind = motion_.file.extension().string();
    std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    static const std::regex knet(R"(\.(ew|ns|ud)[12]?)");
    if (kind == ".csv")
      read_csv();
    else if (kind == ".at2")
      read_peer();
    else if (std::regex_match(kind, knet))
      read_knet();
    else
      problems_.error(named_at_, fmt::format("{} is not in a known format of records", motion_.file.filename().string()),
                      "known formats are CSV (.csv), PEER (.AT2) and K-NET ASCII (.EW, .NS, .UD)");
    if (failed_ || values_.empty()) return;
    motion_.record = laws::Record::make(step_, std::move(values_));
  }

private:
  void report(int line, const Word& word, const std::string& what, const std::string& help) {
    failed_ = true;
    problems_.error_in_other_file({source_, line, word.column, std::max<int>(1, static_cast<int>(word.text.size()))}, named_at_,
                                  what, help);
  }

  bool take_number(int line, const Word& word, std::string_view name, Real& value) {
    const auto number = number_of(word.text);
    if (!number) {
      report(line, word, fmt::format("{}: a number was expected, found \"{}\"", name, word.text),
             "write numbers such as -1.5e-4");
      return false;
    }
    if (!std::isfinite(*number)) {
      report(line, word, fmt::format("{} must be a finite number, found {}", name, word.text),
             "enter the intended number; gaps in a record are not filled");
      return false;
    }
    value = *number;
    return true;
  }

  void read_csv() {
    static constexpr std::string_view help =
        "the first line has the form \"time [s],acceleration [m/s2]\"; units are m/s2, g, gal, "
        "cm/s2, m/s, cm/s, m and cm";
    static const std::regex header(R"(\s*time \[s\]\s*,\s*(acceleration|velocity|displacement)( \[([^\]]*)\])?\s*)");
    if (lines_.empty()) return report(0, {}, "the record is empty", std::string(help));
    std::smatch match;
    const Word first_line{lines_[0], 1};
    if (!std::regex_match(lines_[0], match, header)) return report(1, first_line, "wrong header", std::string(help));
    const std::string name = match[1], unit_name = match[3];
    if (unit_name.empty()) return report(1, first_line, fmt::format("{} has no unit", name), std::string(help));
    const auto unit = std::ranges::find(units, unit_name, &Unit::name);
    const auto quantity = name == "acceleration" ? laws::MotionQuantity::acceleration
                          : name == "velocity"   ? laws::MotionQuantity::velocity
                                                 : laws::MotionQuantity::displacement;
    if (unit == units.end() || unit->quantity != quantity)
      return report(1, first_line, fmt::format("{} is not a unit of {}", unit_name, name), std::string(help));
    motion_.quantity = quantity;
    read_rows(name, unit->factor);
  }

  void read_rows(const std::string& name, Real factor) {
    Real last = 0;
    for (std::size_t i = 1; i < lines_.size() && !failed_; ++i) {
      const int line = static_cast<int>(i) + 1;
      const auto words = words_of(lines_[i], ",");
      if (words_of(lines_[i]).empty()) continue;
      if (words.size() != 2)
        return report(line, {lines_[i], 1}, fmt::format("two numbers were expected, found {}", words.size()),
                      fmt::format("a row is time and {} with a comma between them", name));
      const auto trimmed = [&](const Word& word) {
        const auto inner = words_of(word.text, " \t");
        return inner.empty() ? word : Word{inner.front().text, word.column + inner.front().column - 1};
      };
      const Word time_word = trimmed(words[0]);
      Real time = 0, value = 0;
      if (!take_number(line, time_word, "time", time) || !take_number(line, trimmed(words[1]), name, value)) return;
      if (!check_time(line, time_word, time, last)) return;
      last = time;
      values_.push_back(factor * value);
    }
    if (values_.size() < 2) report(0, {}, fmt::format("the record has {} rows, at least 2 are needed", values_.size()), "");
  }

  bool check_time(int line, const Word& word, Real time, Real last) {
    if (values_.size() == 1) step_ = time - last;
    if (values_.empty() ? time == 0 : (step_ > 0 && std::abs(time - last - step_) <= time_tolerance * step_)) return true;
    if (values_.empty())
      report(line, word, fmt::format("the first time must be 0, found {}", word.text), "shift the times so that they begin at 0");
    else if (!(step_ > 0))
      report(line, word, "times must increase", "sort the rows by time");
    else
      report(line, word,
             fmt::format("times are not uniform: a step of {} s here, and a first step of {} s",
                         short_number(time - last, 6), short_number(step_, 6)),
             "resample the record to equal steps");
    return false;
  }

  void read_peer() {
    static constexpr std::string_view help = "a PEER file has four header lines: title, event, units, and NPTS= n, DT= t";
    if (lines_.size() < 5) return report(0, {}, "this is not a PEER record: it is too short", std::string(help));
    motion_.quantity = laws::MotionQuantity::acceleration;
    if (lines_[2].find("UNITS OF G") == std::string::npos)
      return report(3, {lines_[2], 1}, "the units are missing: line 3 of a PEER record says UNITS OF G", std::string(help));
    static const std::regex points(R"(NPTS\s*=\s*(\d+))"), step(R"(DT\s*=\s*([0-9.Ee+-]+))");
    std::smatch count, interval;
    if (!std::regex_search(lines_[3], count, points) || !std::regex_search(lines_[3], interval, step))
      return report(4, {lines_[3], 1}, "line 4 of a PEER record gives NPTS and DT", std::string(help));
    const std::string step_text = interval[1];
    step_ = number_of(step_text.starts_with('.') ? "0" + step_text : step_text).value_or(0);
    if (!(step_ > 0))
      return report(4, {lines_[3], 1}, fmt::format("DT must be greater than 0, found {}", step_text), std::string(help));
    read_block(4, standard_gravity);
    const auto wanted = std::stoull(count[1]);
    if (!failed_ && values_.size() != wanted)
      report(4, {lines_[3], 1}, fmt::format("NPTS is {}, but {} values follow", wanted, values_.size()), "is the file complete?");
  }

  /// Numbers in free format from a line on.
  void read_block(std::size_t first, Real factor) {
    for (std::size_t i = first; i < lines_.size() && !failed_; ++i)
      for (const Word& word : words_of(lines_[i])) {
        Real value = 0;
        if (!take_number(static_cast<int>(i) + 1, word, "acceleration", value)) return;
        values_.push_back(factor * value);
      }
  }

  void read_knet() {
    static constexpr std::string_view help = "a K-NET file has 17 header lines, with \"Sampling Freq(Hz)\" and \"Scale Factor\"";
    static const std::regex frequency(R"(^Sampling Freq\(Hz\)\s+([0-9.]+)\s*Hz)"),
        scale(R"(^Scale Factor\s+([0-9.]+)\(gal\)/([0-9.]+))");
    Real hertz = 0, factor = 0;
    std::size_t body = 0;
    for (std::size_t i = 0; i < lines_.size() && body == 0; ++i) {
      std::smatch match;
      if (std::regex_search(lines_[i], match, frequency)) hertz = number_of(match[1].str()).value_or(0);
      if (std::regex_search(lines_[i], match, scale))
        factor = 0.01 * number_of(match[1].str()).value_or(0) / number_of(match[2].str()).value_or(0);
      if (lines_[i].starts_with("Memo")) body = i + 1;
    }
    if (!(hertz > 0)) return report(0, {}, "the sampling frequency is missing", std::string(help));
    if (!(factor > 0)) return report(0, {}, "the units are missing: there is no scale factor in gal", std::string(help));
    if (body == 0) return report(0, {}, "the header has no line Memo., after which the samples begin", std::string(help));
    motion_.quantity = laws::MotionQuantity::acceleration;
    step_ = 1 / hertz;
    read_block(body, factor);
    if (failed_ || values_.size() < 2) return report(0, {}, "the record has no samples", std::string(help));
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
  std::ifstream stream(motion.file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) {
    problems.error(named_at, fmt::format("the record {} cannot be read", shown_name), "is it a text file?");
    return;
  }
  std::string content = text.str();
  std::erase(content, '\r');
  const int source = problems.add_source(source_from_text(shown_name, content));
  MotionReader(motion, source, named_at, problems).run();
}

}  // namespace sazare::cases
