#include "sazare/methods/blocks/run/rank_times.hpp"

#include <algorithm>
#include <vector>

#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

void write_rank_times(const std::filesystem::path& file, levels::Simulation<3>& simulation) {
  const std::vector<levels::RankWork> work = simulation.take_rank_work();
  if (work.empty()) return;
  const Real tick_seconds = simulation.now().tick_seconds;
  std::vector<Real> worked;
  std::vector<std::vector<observe::CsvField>> rows;
  for (const levels::RankWork& of : work) {
    worked.resize(std::max(worked.size(), static_cast<std::size_t>(of.rank) + 1), 0);
    Real& sum = worked[static_cast<std::size_t>(of.rank)] += of.seconds;
    rows.push_back({static_cast<Real>(of.tick) * tick_seconds, std::int64_t{of.rank}, sum, of.talking, of.bytes,
                    std::int64_t{of.first_body}});
  }
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::blocks::ranks);
  observe::write_csv(file, titles, rows);
}

}  // namespace sazare::runs
