#include "sazare/observe/vtkhdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/observe/atomic_file.hpp"

namespace sazare::observe {
namespace {

namespace fs = std::filesystem;

/// Points of a cell by VTK's number of its type.
std::size_t points_of(std::uint8_t type) {
  switch (type) {
    case 1:
      return 1;
    case 3:
      return 2;
    case 5:
    case 21:
      return 3;
    case 9:
    case 10:
      return 4;
    case 22:
      return 6;
    case 12:
    case 23:
      return 8;
    case 28:
      return 9;
    case 24:
      return 10;
    case 25:
      return 20;
    case 29:
      return 27;
    default:
      throw std::invalid_argument(fmt::format("cells of VTK's type {} are not known", type));
  }
}

void write_count(Hdf5Writer& out, const std::string& name, std::size_t count) {
  const std::vector<std::int64_t> value = {static_cast<std::int64_t>(count)};
  out.write("/VTKHDF/" + name, std::span<const std::int64_t>(value));
}

std::size_t count_points(const Grid& grid) { return grid.own_points.fill ? grid.own_points.count / 3 : grid.points.size(); }

std::size_t count_corners(const Grid& grid) { return grid.own_points.fill ? count_points(grid) : grid.connectivity.size(); }

std::size_t count_cells(const Grid& grid) {
  if (grid.cell == Grid::Cell::polygon) return grid.ends.size();
  if (!grid.types.empty()) return grid.types.size();
  return count_corners(grid) / points_of(static_cast<std::uint8_t>(grid.cell));
}

void write_points(Hdf5Writer& out, const Grid& grid) {
  static_assert(sizeof(Vector3) == 3 * sizeof(Real), "points are written as they lie in memory");
  const std::vector<std::size_t> shape = {count_points(grid), 3};
  if (grid.own_points.fill) return out.write("/VTKHDF/Points", grid.own_points, shape);
  const Real* first = grid.points.empty() ? nullptr : grid.points.front().data();
  out.write("/VTKHDF/Points", std::span(first, 3 * grid.points.size()), shape);
}

/// Whole numbers of 64 bits from a function of their place.
template <class NumberAt>
void write_long(Hdf5Writer& out, const std::string& name, std::size_t count, NumberAt&& number_at) {
  const auto fill = [&](std::size_t first, std::span<std::int64_t> piece) {
    for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = number_at(first + i);
  };
  out.write("/VTKHDF/" + name, MadeNumbers<std::int64_t>{count, fill}, {count});
}

void write_cells(Hdf5Writer& out, const Grid& grid, std::size_t cells) {
  write_long(out, "Connectivity", count_corners(grid), [&](std::size_t i) {
    return grid.own_points.fill ? static_cast<std::int64_t>(i) : std::int64_t{grid.connectivity[i]};
  });
  std::vector<std::uint8_t> types(grid.types.begin(), grid.types.end());
  if (types.empty()) types.assign(cells, static_cast<std::uint8_t>(grid.cell));
  std::int64_t end = 0;  // offsets are asked for one after the other
  write_long(out, "Offsets", cells + 1, [&](std::size_t i) {
    if (i > 0)
      end = grid.cell == Grid::Cell::polygon ? grid.ends[i - 1] : end + static_cast<std::int64_t>(points_of(types[i - 1]));
    return end;
  });
  out.write("/VTKHDF/Types", std::span<const std::uint8_t>(types));
}

void write_data(Hdf5Writer& out, const std::string& group, const CellData& data, std::size_t cells) {
  std::visit(
      [&](const auto& values) {
        if (values.size() != cells * data.components) {
          throw std::invalid_argument(
              fmt::format("data '{}' has {} numbers for {} cells or points", data.name, values.size(), cells));
        }
        std::vector<std::size_t> shape = {cells};
        if (data.components > 1) shape.push_back(data.components);
        out.write(group + data.name, values, shape);
      },
      data.values);
}

}  // namespace

void write_vtkhdf(const fs::path& file, const Grid& grid, Sync sync) {
  const std::size_t cells = count_cells(grid);
  Hdf5Writer out(file);
  out.make_group("/VTKHDF");
  out.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  out.set_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  write_count(out, "NumberOfPoints", count_points(grid));
  write_count(out, "NumberOfCells", cells);
  write_count(out, "NumberOfConnectivityIds", count_corners(grid));
  write_points(out, grid);
  write_cells(out, grid, cells);
  out.make_group("/VTKHDF/CellData");
  for (const CellData& data : grid.cell_data) write_data(out, "/VTKHDF/CellData/", data, cells);
  if (!grid.point_data.empty()) out.make_group("/VTKHDF/PointData");
  for (const CellData& data : grid.point_data) write_data(out, "/VTKHDF/PointData/", data, count_points(grid));
  out.make_group("/VTKHDF/FieldData");
  out.write("/VTKHDF/FieldData/time", std::span<const Real>(&grid.time, 1));
  out.commit(sync);
}

namespace {

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_to_write(folder, error.value());
}

}  // namespace

SnapshotSeries::SnapshotSeries(fs::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {
  make_folder(folder_);
}

std::string SnapshotSeries::file_name(std::size_t index) const { return fmt::format("{}_{:05}.vtkhdf", name_, index); }

fs::path SnapshotSeries::series_file(const std::string& ending) const {
  return folder_ / fmt::format("{}.{}.series", name_, ending);
}

void SnapshotSeries::write(const Grid& grid) {
  if (times_.empty()) make_folder(folder_);  // which went with the run that this one replaces
  write_vtkhdf(folder_ / file_name(times_.size()), grid, Sync::system);
  times_.push_back(grid.time);
  is_listed_ = false;
  write_series();
}

void SnapshotSeries::sync() {
  sync_early();
  if (is_listed_) return;
  for (const std::string ending : {"vtkhdf", "hdf"}) sync_file(series_file(ending));
  sync_folder(folder_);
  is_listed_ = true;
}

void SnapshotSeries::sync_early() {
  for (; synced_ < times_.size(); ++synced_) sync_file(folder_ / file_name(synced_));
}

void SnapshotSeries::write_series() const {
  nlohmann::ordered_json series = {{"file-series-version", "1.0"}, {"files", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < times_.size(); ++i) {
    series["files"].push_back({{"name", file_name(i)}, {"time", times_[i]}});
  }
  for (const std::string ending : {"vtkhdf", "hdf"}) {
    write_file(series_file(ending), series.dump(1) + "\n", Sync::system);
  }
}

void SnapshotSeries::resume(std::size_t count) {
  std::vector<Real> times;
  try {
    std::ifstream stream(series_file("vtkhdf"));
    const nlohmann::json series = stream ? nlohmann::json::parse(stream) : nlohmann::json{{"files", {}}};
    for (const auto& entry : series.at("files")) times.push_back(entry.at("time").get<Real>());
  } catch (const nlohmann::json::exception&) {
    times.clear();
  }
  if (times.size() < count) {
    throw UserError(fmt::format(
        "{}: should list at least the {} snapshots of the run to be resumed, but lists {}. Start the run again with --overwrite",
        series_file("vtkhdf").string(), count, times.size()));
  }
  const std::size_t found = times.size();
  times.resize(count);
  times_ = std::move(times);
  synced_ = count;
  write_series();
  // One more than is listed: the run may have been stopped between the snapshot and the list.
  std::error_code ignored;
  for (std::size_t i = count; i <= found; ++i) fs::remove(folder_ / file_name(i), ignored);
}

}  // namespace sazare::observe
