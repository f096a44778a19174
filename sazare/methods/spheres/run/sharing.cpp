#include "sazare/methods/spheres/run/sharing.hpp"

#include <fmt/format.h>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/levels/distribute/balance.hpp"
#include "sazare/methods/spheres/ranks/forecast.hpp"
#include "sazare/methods/spheres/run/columns.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

using methods::spheres::Division;

Division division_of(distribute::Policy policy) {
  if (policy == distribute::Policy::fixed) return Division::even;
  return policy == distribute::Policy::random ? Division::random : Division::measured;
}

}  // namespace

void share_among(SpheresModel& model, const levels::Sharing& sharing) {
  if (sharing.ranks != nullptr) model.stepper->share(*sharing.ranks, division_of(sharing.policy));
}

std::vector<SphereRankWork> gather_rank_work(const SpheresModel& model) {
  const methods::spheres::RankTiles* const ranks = model.stepper->ranks();
  if (ranks == nullptr) return {};
  SphereRankWork own;
  own.rank = ranks->ranks().rank();
  own.seconds = ranks->seconds();
  own.spheres = static_cast<std::int64_t>(ranks->own_spheres());
  own.shown = ranks->border().shown();
  own.traffic = ranks->ranks().traffic();
  own.expected_motion = model.stepper->expected_to_send();
  return ranks->to_first(own, parallel::Topic::state);
}

void write_rank_times(const std::filesystem::path& file, Real time, const std::vector<SphereRankWork>& work) {
  if (work.empty()) return;
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::spheres::ranks);
  std::vector<std::vector<observe::CsvField>> rows;
  for (const SphereRankWork& of : work) {
    const parallel::Sent all = of.traffic.total(), motion = of.traffic.of(parallel::Topic::motion),
                         search = of.traffic.of(parallel::Topic::search);
    rows.push_back({time, of.rank, of.seconds, of.traffic.seconds, of.spheres, of.shown, all.bytes, all.messages, motion.bytes,
                    motion.messages, search.bytes, search.messages, of.expected_motion.bytes, of.expected_motion.messages});
  }
  observe::write_csv(file, titles, rows);
}

std::string explain_ranks_of_spheres(const cases::CaseFile& file, int ranks) {
  constexpr std::int64_t fewest_spheres = 4000;  // of a rank; with fewer, messages take longer than the work
  SpheresModel model = build_spheres(file);
  model.stepper->start();
  const methods::spheres::SharingForecast of =
      methods::spheres::forecast(model.stepper->levels(), !model.stepper->spheres().turn.empty(), ranks);
  std::string text = fmt::format(
      "\non {} ranks, as the spheres stand at the beginning\n"
      "  spheres of a rank    {} to {}\n"
      "  shown to others      {} at most, of a rank\n"
      "  sent in a {}{} {} B at most, by a rank\n",
      ranks, of.fewest, of.most, of.shown, model.steps.level.empty() ? "step" : "base step",
      model.steps.level.empty() ? "      " : " ", of.bytes);
  const auto most_ranks = std::max<std::int64_t>(1, static_cast<std::int64_t>(model.group.size()) / fewest_spheres);
  if (ranks > most_ranks)
    text +=
        fmt::format("  {} ranks have fewer than {} spheres each and wait for messages longer than they work: take {}\n", ranks,
                    fewest_spheres, most_ranks == 1 ? "one process and threads" : fmt::format("{} at most", most_ranks));
  return text;
}

}  // namespace sazare::runs
