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
#include "sazare/observe/hdf5_file.hpp"

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

void write_cells(Hdf5Writer& out, const Grid& grid, std::size_t cells) {
  std::vector<std::int64_t> numbers(grid.connectivity.begin(), grid.connectivity.end());
  out.write("/VTKHDF/Connectivity", std::span<const std::int64_t>(numbers));
  std::vector<std::uint8_t> types(grid.types.begin(), grid.types.end());
  if (types.empty()) types.assign(cells, static_cast<std::uint8_t>(grid.cell));
  numbers.assign(1, 0);
  for (const std::uint8_t type : types) numbers.push_back(numbers.back() + static_cast<std::int64_t>(points_of(type)));
  out.write("/VTKHDF/Offsets", std::span<const std::int64_t>(numbers));
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
  const std::size_t cells =
      grid.types.empty() ? grid.connectivity.size() / points_of(static_cast<std::uint8_t>(grid.cell)) : grid.types.size();
  Hdf5Writer out(file);
  out.make_group("/VTKHDF");
  out.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  out.set_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  write_count(out, "NumberOfPoints", grid.points.size());
  write_count(out, "NumberOfCells", cells);
  write_count(out, "NumberOfConnectivityIds", grid.connectivity.size());
  static_assert(sizeof(Vector3) == 3 * sizeof(Real), "points are written as they lie in memory");
  const Real* first = grid.points.empty() ? nullptr : grid.points.front().data();
  out.write("/VTKHDF/Points", std::span(first, 3 * grid.points.size()), {grid.points.size(), 3});
  write_cells(out, grid, cells);
  out.make_group("/VTKHDF/CellData");
  for (const CellData& data : grid.cell_data) write_data(out, "/VTKHDF/CellData/", data, cells);
  if (!grid.point_data.empty()) out.make_group("/VTKHDF/PointData");
  for (const CellData& data : grid.point_data) write_data(out, "/VTKHDF/PointData/", data, grid.points.size());
  out.make_group("/VTKHDF/FieldData");
  out.write("/VTKHDF/FieldData/time", std::span<const Real>(&grid.time, 1));
  out.commit(sync);
}

SnapshotSeries::SnapshotSeries(fs::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) fail_to_write(folder_, error.value());
}

std::string SnapshotSeries::file_name(std::size_t index) const { return fmt::format("{}_{:05}.vtkhdf", name_, index); }

fs::path SnapshotSeries::series_file(const std::string& ending) const {
  return folder_ / fmt::format("{}.{}.series", name_, ending);
}

void SnapshotSeries::write(const Grid& grid) {
  write_vtkhdf(folder_ / file_name(times_.size()), grid, Sync::system);
  times_.push_back(grid.time);
  write_series();
}

void SnapshotSeries::sync() {
  if (synced_ == times_.size()) return;
  for (; synced_ < times_.size(); ++synced_) sync_file(folder_ / file_name(synced_));
  for (const std::string ending : {"vtkhdf", "hdf"}) sync_file(series_file(ending));
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
    throw UserError(
        fmt::format("{}: should list {} snapshots at least, of the run to be resumed, and lists {}. Start "
                    "the run again without --resume",
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
