#include "sazare/methods/blocks/run/rows/rank_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

static_assert(columns::blocks::rank_topics.size() == parallel::topic_count);

/// The finest level of any rank.
std::size_t finest_level(const std::vector<levels::RankWork>& work) {
  std::size_t finest = 0;
  for (const levels::RankWork& of : work)
    for (std::size_t level = finest; level < of.bodies.size(); ++level)
      if (of.bodies[level] > 0) finest = level;
  return finest;
}

std::vector<std::string> titles_of(std::size_t finest) {
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::blocks::ranks);
  for (const std::string_view topic : columns::blocks::rank_topics)
    observe::add_titles(titles, columns::blocks::rank_topic, topic);
  for (std::size_t level = 0; level <= finest; ++level)
    observe::add_titles(titles, columns::blocks::rank_level, fmt::format("level_{}", level));
  return titles;
}

std::vector<observe::CsvField> row_of(const levels::RankWork& of, Real tick_seconds, Real worked, std::size_t finest) {
  const parallel::Sent all = of.traffic.total();
  std::vector<observe::CsvField> row = {static_cast<Real>(of.tick) * tick_seconds,
                                        std::int64_t{of.rank},
                                        worked,
                                        of.traffic.seconds,
                                        of.lock_step,
                                        std::int64_t{of.body_count()},
                                        std::int64_t{of.border},
                                        std::int64_t{of.ranges},
                                        all.bytes,
                                        all.messages,
                                        of.expected_motion.bytes,
                                        of.expected_motion.messages};
  for (const parallel::Sent& about : of.traffic.sent) {
    row.emplace_back(about.bytes);
    row.emplace_back(about.messages);
  }
  for (std::size_t level = 0; level <= finest; ++level) row.emplace_back(std::int64_t{of.bodies[level]});
  return row;
}

}  // namespace

void write_rank_times(const std::filesystem::path& file, levels::Simulation<3>& simulation) {
  const std::vector<levels::RankWork> work = simulation.take_rank_work();
  if (work.empty()) return;
  const std::size_t finest = finest_level(work);
  std::vector<Real> worked;
  std::vector<std::vector<observe::CsvField>> rows;
  for (const levels::RankWork& of : work) {
    worked.resize(std::max(worked.size(), static_cast<std::size_t>(of.rank) + 1), 0);
    const Real sum = worked[static_cast<std::size_t>(of.rank)] += of.seconds;
    rows.push_back(row_of(of, simulation.now().tick_seconds, sum, finest));
  }
  observe::write_csv(file, titles_of(finest), rows);
}

}  // namespace sazare::runs
