#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/fields.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/structure_check.hpp"
#include "sazare/cases/format/suggest.hpp"
#include "sazare/cases/motion_file.hpp"
#include "sazare/cases/motion_peaks.hpp"

namespace sazare::cases {

void check_keys(const CheckContext& context, const Entry& entry, const std::string& chosen,
                const std::vector<std::string_view>& needed, const std::vector<std::string_view>& foreign,
                const std::string& help) {
  if (!entry.exists()) return;
  for (const std::string_view key : needed)
    if (!entry.has(key))
      context.problems.error(entry.header(),
                             fmt::format("{} has no \"{}\", which {} needs", table_header(*entry.table), key, chosen),
                             how_to_add(*find_key(*entry.table, key)));
  for (const std::string_view key : foreign)
    if (entry.has(key)) context.problems.error(*entry.value->key_place(key), fmt::format("{} is not for {}", key, chosen), help);
}

namespace {

/// Refuses a record that leaves the range of numbers, itself or integrated, in SI units and times the amplitude.
void check_size(const CheckContext& context, const Entry& entry, const Motion& motion) {
  const laws::Record& record = motion.record;
  const auto is_too_large = [&](Real value) { return !std::isfinite(value * motion.amplitude); };
  if (std::ranges::none_of(record.value, is_too_large) && std::ranges::none_of(record.first, is_too_large) &&
      std::ranges::none_of(record.second, is_too_large))
    return;
  context.problems.error(entry.place("file"),
                         "the record holds numbers that are too large for its motion to be found, in its unit and times its "
                         "amplitude",
                         "check the numbers of the file, their unit and the amplitude");
}

/// What a thing does that follows a record which ends before the run.
void warn_of_end(const CheckContext& context, const Entry& entry, const Motion& motion, Real end) {
  const Real duration = motion.record.duration(), velocity = motion.amplitude * motion.record.first.back();
  std::string then = "what it moves stays where it is then; let the record reach the end of the run if that is not meant";
  Real largest = 0;
  for (const Real displacement : motion.record.second) largest = std::max(largest, std::abs(motion.amplitude * displacement));
  const bool drifts = std::abs(velocity) * (end - duration) > 1e-9 * largest;  // more than round-off leaves
  if (motion.quantity == laws::MotionQuantity::acceleration && drifts)
    then = fmt::format(
        "what it moves goes on at the velocity that is left, {} m/s, by {} m to the end of the run; let the run end "
        "with the record, or add accelerations that bring it to rest{}",
        short_number(velocity, 3), short_number(velocity * (end - duration), 3),
        motion.baseline == Baseline::none ? ", or set baseline = \"linear\"" : "");
  context.problems.warning(
      entry.place("file"),
      fmt::format("the record ends at {} s, before the run at {} s", short_number(duration), short_number(end)), then);
}

/// Motions in gal or cm/s whose numbers are taken for m/s2 or m/s are a hundred times too strong.
void warn_of_peaks(const CheckContext& context, const Entry& entry, const Motion& motion, Real end) {
  constexpr MotionPeaks strongest{50, 8, 25};  // somewhat more than the strongest that was ever recorded near a fault
  constexpr Real travel_of_impact = 0.01;      // m; a striker is faster than any ground, and moves little while the run lasts
  const std::optional<MotionPeaks> peaks = peaks_of(motion, end);
  if (!peaks || peaks->displacement < travel_of_impact) return;
  const bool is_record = motion.type == MotionShape::record;
  const Place place = entry.place(is_record ? "file" : "amplitude");
  const auto warn = [&](const char* what, Real peak, const char* unit, Real factor, const char* small_unit) {
    context.problems.warning(
        place, fmt::format("this motion has a peak {} of {} {}, more than any earthquake had", what, short_number(peak, 4), unit),
        fmt::format("check {}; as {} it would be {} {}",
                    is_record ? "the unit that the file states and the amplitude" : "its unit", small_unit,
                    short_number(factor * peak, 4), unit));
  };
  if (motion.quantity == laws::MotionQuantity::acceleration && peaks->acceleration > strongest.acceleration)
    warn("acceleration", peaks->acceleration, "m/s2", 0.01, "gal");
  else if (motion.quantity == laws::MotionQuantity::velocity && peaks->velocity > strongest.velocity)
    warn("velocity", peaks->velocity, "m/s", 0.01, "cm/s");
  else if (is_record && motion.quantity != laws::MotionQuantity::displacement && peaks->displacement > strongest.displacement)
    context.problems.warning(
        place, fmt::format("this record moves by {} m, more than any earthquake did", short_number(peaks->displacement, 4)),
        "records of accelerations drift: choose a baseline, or check the unit that the file states");
}

/// Things are at rest before t = 0: a motion that begins with a velocity jerks them.
void warn_of_jump(const CheckContext& context, const Place& place, std::string_view what, Real velocity,
                  const std::string& help) {
  context.problems.warning(
      place,
      fmt::format("{} begins at a velocity of {} m/s, and what it moves is at rest before", what, short_number(velocity, 4)),
      help);
}

/// A record of velocities that does not begin at rest.
void warn_of_start(const CheckContext& context, const Entry& entry, const Motion& motion) {
  constexpr Real at_rest = 0.01;  // of the peak
  const std::vector<Real>& velocity = motion.record.value;
  if (motion.quantity != laws::MotionQuantity::velocity || motion.amplitude == 0) return;
  Real peak = 0;
  for (const Real value : velocity) peak = std::max(peak, std::abs(value));
  if (std::abs(velocity.front()) <= at_rest * peak) return;
  warn_of_jump(context, entry.place("file"), "the record", motion.amplitude * velocity.front(),
               "it jumps there within the first step, which sends a wave out: begin the record where its velocity is 0, or add "
               "samples that "
               "lead up to it");
}

/// A sine of displacements is fastest at its beginning.
void warn_of_sine(const CheckContext& context, const Entry& entry, const Motion& motion) {
  if (motion.quantity != laws::MotionQuantity::displacement || !entry.gives("frequency") || motion.amplitude == 0) return;
  warn_of_jump(
      context, entry.place("quantity"), "a sine of displacements", 2 * std::numbers::pi * motion.frequency * motion.amplitude,
      "it jumps there within the first step, which sends a wave out: a sine of velocities or accelerations begins at rest");
}

/// Says what a record does that is easily overlooked.
void warn_of_record(const CheckContext& context, const Entry& entry, const Motion& motion, Real end) {
  const laws::Record& record = motion.record;
  const bool displaces = motion.quantity == laws::MotionQuantity::displacement;
  if (record.value.size() < 2) return;
  if (displaces && record.value.front() != 0)
    context.problems.warning(entry.place("file"),
                             fmt::format("the record begins at a displacement of {} m", short_number(record.value.front())),
                             "displacements count from where things stand at t = 0: this first value is taken off all others");
  warn_of_start(context, entry, motion);
  if (record.duration() < end * (1 - 1e-9)) warn_of_end(context, entry, motion, end);
  warn_of_peaks(context, entry, motion, end);
}

void check_record(const CheckContext& context, const Entry& entry, Motion& motion, Real end) {
  check_keys(context, entry, "a record", {"file"}, {"quantity", "frequency", "peak_time", "cycles"});
  if (!entry.gives("file")) return;
  const std::string as_written = *entry.value->find("file")->text();
  if (!check_file(context, entry.place("file"), "record", motion.file, as_written)) return;
  read_motion_file(motion, (context.shown_folder / as_written).lexically_normal().string(), entry.place("file"),
                   context.problems);
  if (motion.baseline != Baseline::none && motion.record.value.size() > 2)
    laws::take_off_baseline(motion.record, motion.baseline == Baseline::linear ? 1 : 0);
  check_size(context, entry, motion);
  warn_of_record(context, entry, motion, end);
}

/// Names of motions that anything of the case follows.
std::vector<std::string> followed_motions(const CheckContext& context) {
  std::vector<std::string_view> keys(motion_name_keys.begin(), motion_name_keys.end());
  keys.push_back("motion");
  std::vector<std::string> names;
  for (const Table& table : context.schema)
    for (const Entry& entry : context.entries_of(table.name))
      for (const std::string_view key : keys)
        if (entry.exists() && find_key(table, key) != nullptr && entry.gives(key))
          if (const auto* name = entry.value->find(key)->text()) names.push_back(*name);
  return names;
}

void warn_of_unused(const CheckContext& context, const std::vector<Motion>& motions) {
  const std::vector<std::string> followed = followed_motions(context);
  const auto list = context.entries_of("motions");
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].gives("name") && std::ranges::find(followed, motions[i].name) == followed.end())
      context.problems.warning(list[i].place("name"), fmt::format("nothing follows the motion \"{}\"", motions[i].name),
                               "give its name as motion_x, motion_y or motion_z of what it is to move, or remove it");
}

}  // namespace

void check_motions(const CheckContext& context, std::vector<Motion>& motions, Real end) {
  const auto list = context.entries_of("motions");
  warn_of_unused(context, motions);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    Motion& motion = motions[i];
    if (!entry.gives("type")) continue;
    if (motion.type == MotionShape::record) {
      check_record(context, entry, motion, end);
    } else if (motion.type == MotionShape::function) {
      check_keys(context, entry, "a function", {}, {"file", "baseline", "frequency", "peak_time", "cycles"});
      motion.samples = std::make_shared<laws::Record>();
    } else if (motion.type == MotionShape::sine) {
      check_keys(context, entry, "a sine", {"frequency"}, {"file", "baseline", "peak_time"});
      warn_of_sine(context, entry, motion);
    } else {
      check_keys(context, entry, "a Ricker wavelet", {"frequency", "peak_time"}, {"file", "baseline", "cycles"});
      if (entry.gives("frequency") && entry.gives("peak_time") && motion.peak_time * motion.frequency < 1 - 1e-9)
        context.problems.error(entry.place("peak_time"),
                               fmt::format("the wavelet begins before t = 0: peak_time is {} s and 1/frequency {} s",
                                           short_number(motion.peak_time), short_number(1 / motion.frequency)),
                               "choose a peak_time of 1/frequency or more");
    }
    if (motion.type != MotionShape::record) warn_of_peaks(context, entry, motion, end);
  }
}

void check_flat(const CheckContext& context, const Entry& entry, std::string_view key, const Vector3& value, int dimension,
                std::string_view table) {
  if (dimension == 3 || value.z() == 0 || !entry.gives(key)) return;
  context.problems.error(entry.place(key), fmt::format("{}: z must be 0 in 2-D, found {}", key, short_number(value.z())),
                         fmt::format("write 0 as the third number, or set dimension = 3 in [{}]", table));
}

void check_damping(const CheckContext& context, const Damping& damping, const std::vector<Real>& ratios) {
  const Entry entry = context.entries_of("damping").front();
  const auto list = context.entries_of("materials");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!(ratios[i] > 0) || (entry.has("f1") && entry.has("f2"))) continue;
    context.problems.error(
        list[i].place("damping_ratio"), "a damping_ratio needs the frequencies f1 and f2",
        "add [damping] with f1 = ... and f2 = ... in Hz: between them the damping ratio is at most damping_ratio");
    break;
  }
  if (entry.gives("f1") && entry.gives("f2") && !(damping.f1 < damping.f2))
    context.problems.error(
        entry.place("f2"),
        fmt::format("f2 must be greater than f1, found {} and {} Hz", short_number(damping.f2), short_number(damping.f1)),
        "f1 is the lower frequency");
}

void check_motion_names(const CheckContext& context, const Entry& entry, const std::array<std::string, 3>& motion,
                        const std::vector<std::string>& names) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string& name = motion[axis];
    if (name.empty() || std::ranges::find(names, name) != names.end()) continue;
    context.problems.error(entry.place(motion_name_keys[axis]), fmt::format("there is no motion \"{}\"", name),
                           full_suggestion(name, names, "motions"));
  }
}

void check_strength(const CheckContext& context, const Entry& entry, const StrengthNumbers& strength) {
  if (!entry.gives("friction_angle")) return;
  if (strength.dilation_angle > strength.friction_angle)
    context.problems.error(entry.place("dilation_angle"), "dilation_angle must be at most friction_angle",
                           "with a larger one, plastic flow would generate energy");
  const Real most = strength.cohesion / std::tan(strength.friction_angle * std::numbers::pi / 180);
  if (strength.friction_angle > 0 && strength.tensile_strength > most * (1 + 1e-9))
    context.problems.error(entry.place("tensile_strength"),
                           fmt::format("tensile_strength must be at most cohesion/tan(friction_angle) = {} Pa, found {}",
                                       short_number(most), short_number(strength.tensile_strength)),
                           "the shear strength is zero at that stress");
}

}  // namespace sazare::cases
