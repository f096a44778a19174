#include <fmt/format.h>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/motion_file.hpp"
#include "sazare/cases/number_text.hpp"
#include "sazare/cases/structure_check.hpp"

namespace sazare::cases {

void check_keys(const CheckContext& context, const Entry& entry, const std::string& chosen,
                const std::vector<std::string_view>& needed, const std::vector<std::string_view>& foreign) {
  if (!entry.exists()) return;
  for (const std::string_view key : needed)
    if (!entry.has(key))
      context.problems.error(entry.header(),
                             fmt::format("{} has no \"{}\", which {} needs", table_header(*entry.table), key, chosen),
                             how_to_add(*find_key(*entry.table, key)));
  for (const std::string_view key : foreign)
    if (entry.has(key))
      context.problems.error(*entry.value->key_place(key), fmt::format("{} is not for {}", key, chosen),
                             "remove it, or choose another kind");
}

namespace {

void check_record(const CheckContext& context, const Entry& entry, Motion& motion) {
  check_keys(context, entry, "a record", {"file"}, {"quantity", "frequency", "peak_time", "cycles"});
  if (!entry.gives("file")) return;
  const std::string as_written = *entry.value->find("file")->text();
  if (!check_file(context, entry.place("file"), "record", motion.file, as_written)) return;
  read_motion_file(motion, (context.shown_folder / as_written).lexically_normal().string(), entry.place("file"),
                   context.problems);
  if (motion.baseline != Baseline::none && motion.record.value.size() > 2)
    laws::take_off_baseline(motion.record, motion.baseline == Baseline::linear ? 1 : 0);
}

}  // namespace

void check_motions(const CheckContext& context, std::vector<Motion>& motions) {
  const auto list = context.entries_of("motions");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry& entry = list[i];
    Motion& motion = motions[i];
    if (!entry.gives("type")) continue;
    if (motion.type == MotionShape::record) {
      check_record(context, entry, motion);
    } else if (motion.type == MotionShape::sine) {
      check_keys(context, entry, "a sine", {"frequency"}, {"file", "baseline", "peak_time"});
    } else {
      check_keys(context, entry, "a Ricker wavelet", {"frequency", "peak_time"}, {"file", "baseline", "cycles"});
      if (entry.gives("frequency") && entry.gives("peak_time") && motion.peak_time * motion.frequency < 1 - 1e-9)
        context.problems.error(entry.place("peak_time"),
                               fmt::format("the wavelet has begun before t = 0: peak_time is {} s and 1/frequency {} s",
                                           short_number(motion.peak_time), short_number(1 / motion.frequency)),
                               "choose a peak_time of 1/frequency or more");
    }
  }
}

}  // namespace sazare::cases
