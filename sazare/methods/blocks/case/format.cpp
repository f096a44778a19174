#include "sazare/methods/blocks/case/format.hpp"

#include <fmt/format.h>

#include <utility>

#include "sazare/cases/case_reader.hpp"
#include "sazare/cases/case_writer.hpp"
#include "sazare/cases/outside_history.hpp"
#include "sazare/cases/water/checks.hpp"
#include "sazare/methods/blocks/case/checks.hpp"
#include "sazare/methods/blocks/case/fields.hpp"

namespace sazare::cases {
namespace {

/// Pressures of blasts and motions that only the caller of the engine knows.
std::vector<OutsideHistory> outside_histories(const BlocksCase& blocks) {
  std::vector<OutsideHistory> found = outside_motions(blocks.motions);
  for (std::size_t i = 0; i < blocks.blasts.size(); ++i)
    if (const auto* function = std::get_if<PressureFunction>(&blocks.blasts[i].pressure))
      found.push_back({blocks.blasts[i].name, fmt::format("blasts.{}.function", i), "pressure of the blast",
                       blocks.blasts[i].delay, function->samples});
  return found;
}

void resolve_clocks(const CheckContext& context, Time& time) {
  const Entry entry = context.entries_of("time").front();
  if (!entry.gives("end")) return;
  if (time.limiter != Limiter::stability && entry.is_sound("limiter") && !entry.has("base_step"))
    context.problems.error(entry.place("limiter"),
                           fmt::format("limiter \"{}\" needs base_step", time.limiter == Limiter::travel ? "travel" : "none"),
                           "add base_step = ... (a number in s, greater than 0): the largest step");
  resolve_clocks(context, {time.end, "base_step", time.base_step, time.history_interval, time.snapshot_interval});
}

void read(const CheckContext& context, CaseFile& file) {
  BlocksCase blocks = CaseReader(context).read<BlocksCase>();
  check_mesh_file(context, blocks.mesh);
  check_names(context, blocks);
  check_joints(context, blocks);
  check_contact(context, blocks);
  check_blasts(context, blocks);
  check_charges(context, blocks);
  check_constraints(context, blocks);
  check_initial_stress(context, blocks);
  check_settling(context, blocks);
  check_water(context, blocks.water, blocks.gravity, blocks.time.end);
  check_motions(context, blocks.motions, blocks.time.end);
  resolve_clocks(context, blocks.time);
  if (blocks.time.strict) context.problems.turn_warnings_into_errors();
  file.histories = outside_histories(blocks);
  file.content = std::move(blocks);
}

std::string write(const CaseFile& file, const std::filesystem::path& folder) {
  return write_resolved(file.as<BlocksCase>(), folder);
}

}  // namespace

std::string write_resolved(const BlocksCase& blocks, const std::filesystem::path& folder) {
  return CaseWriter(blocks_schema(), folder).write(blocks, "blocks");
}

CaseFormat blocks_format() {
  return {.method = "blocks",
          .sentence = "blocks (bonded tetrahedra that can break apart)",
          .tables = blocks_schema(),
          .read = read,
          .write = write};
}

}  // namespace sazare::cases
