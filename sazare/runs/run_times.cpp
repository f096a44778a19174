#include "sazare/runs/run_times.hpp"

#include <algorithm>
#include <string_view>

#include "sazare/observe/csv_writer.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

constexpr std::array<std::string_view, 3> part_names = {"setup", "output", "checkpoints"};

}  // namespace

void RunTimes::write(const std::filesystem::path& file, std::span<const levels::PartTime> engine) const {
  const Real total = now();
  Real accounted = 0;
  std::vector<std::vector<observe::CsvField>> rows;
  const auto add_row = [&](std::string_view part, Real seconds) {
    accounted += seconds;
    rows.push_back({std::string(part), seconds, total > 0 ? seconds / total : 0});
  };
  for (std::size_t i = 0; i < engine.size(); ++i)
    add_row(engine[i].part, engine[i].seconds + (i < engine_earlier_.size() ? engine_earlier_[i] : 0));
  for (std::size_t i = 0; i < own_.size(); ++i) add_row(part_names[i], own_[i]);
  add_row("other", std::max(total - accounted, Real{0}));
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::timing);
  observe::write_csv(file, titles, rows);
}

void RunTimes::columns(Archive& archive, std::span<const levels::PartTime> engine) {
  Real wall = now();
  std::vector<Real> own(own_.begin(), own_.end()), parts;
  for (std::size_t i = 0; i < engine.size(); ++i)
    parts.push_back(engine[i].seconds + (i < engine_earlier_.size() ? engine_earlier_[i] : 0));
  archive("wall", wall);
  archive("own", own);
  archive("engine", parts);
  if (!archive.reading()) return;
  earlier_ = wall;
  engine_earlier_ = parts;
  for (std::size_t i = 0; i < std::min(own.size(), own_.size()); ++i) own_[i] += own[i];
}

}  // namespace sazare::runs
