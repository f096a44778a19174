#include "sazare/observe/vtkhdf.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "sazare/core/error.hpp"
#include "sazare/observe/hdf5_file.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::SmallDisk;
using test::TemporaryFolder;
using test::words_of;
using Names = std::vector<std::string>;

const std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
const std::vector<std::int32_t> tetrahedra = {0, 1, 2, 3, 1, 2, 3, 4};
const std::vector<std::int32_t> levels = {3, 5};
const std::vector<Real> velocities = {1, 2, 3, 4, 5, 6};

Grid grid_at(Real time) {
  return {Grid::Cell::tetrahedron,
          points,
          tetrahedra,
          {{"level", 1, std::span<const std::int32_t>(levels)}, {"velocity", 3, std::span<const Real>(velocities)}},
          time};
}

nlohmann::json list_of(const std::filesystem::path& file) { return nlohmann::json::parse(test::read_text(file)); }

TEST(vtkhdf, says_what_it_is) {
  const TemporaryFolder folder;
  write_vtkhdf(folder.path() / "a.vtkhdf", grid_at(0.5));
  const Hdf5Reader reader(folder.path() / "a.vtkhdf");
  EXPECT_EQ(reader.read_attribute("/VTKHDF", "Version"), (std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(reader.read_text_attribute("/VTKHDF", "Type"), "UnstructuredGrid");
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds", "Points", "Connectivity", "Offsets",
                           "Types", "CellData/level", "CellData/velocity", "FieldData/time"}) {
    EXPECT_TRUE(reader.has(std::string("/VTKHDF/") + name)) << name;
  }
  EXPECT_EQ(folder.files(), Names{"a.vtkhdf"});
}

TEST(vtkhdf, numbers_made_in_pieces_are_those_in_memory) {
  const TemporaryFolder folder;
  constexpr std::size_t cells = 20000;  // more than a piece
  std::vector<Vector3> places(3 * cells);
  std::vector<std::int32_t> order(3 * cells), number(cells);
  std::vector<Real> way(3 * cells);
  for (std::size_t i = 0; i < 3 * cells; ++i) {
    places[i] = {0.5 * static_cast<Real>(i), 1, -static_cast<Real>(i)};
    order[i] = static_cast<std::int32_t>(i);
    way[i] = static_cast<Real>(7 * i);
    number[i / 3] = static_cast<std::int32_t>(i);
  }
  Grid held{Grid::Cell::triangle, places, order, {}, 2};
  held.cell_data = {{"number", 1, std::span<const std::int32_t>(number)}, {"way", 3, std::span<const Real>(way)}};
  Grid made{Grid::Cell::triangle, {}, {}, {}, 2};
  const auto from = [](const auto* numbers) {
    return [numbers](std::size_t first, auto piece) { std::copy_n(numbers + first, piece.size(), piece.begin()); };
  };
  made.own_points = {9 * cells, from(places.front().data())};
  made.cell_data = {{"number", 1, MadeNumbers<std::int32_t>{cells, from(number.data())}},
                    {"way", 3, MadeNumbers<Real>{3 * cells, from(way.data())}}};
  write_vtkhdf(folder.path() / "held.vtkhdf", held);
  write_vtkhdf(folder.path() / "made.vtkhdf", made);
  EXPECT_TRUE(test::read_text(folder.path() / "held.vtkhdf") == test::read_text(folder.path() / "made.vtkhdf"));
}

TEST(vtkhdf, data_of_another_length_is_a_programming_error) {
  const TemporaryFolder folder;
  Grid grid = grid_at(0);
  grid.cell_data[0].components = 3;
  EXPECT_THROW(write_vtkhdf(folder.path() / "a.vtkhdf", grid), std::invalid_argument);
  EXPECT_EQ(folder.files(), Names{});
}

TEST(vtkhdf, full_disk_leaves_nothing) {
  const TemporaryFolder folder;
  for (const std::size_t limit : {0, 100, 1000, 3000}) {
    const SmallDisk small(limit);
    EXPECT_WORDS(words_of<MachineError>([&] { write_vtkhdf(folder.path() / "a.vtkhdf", grid_at(0)); }),
                 "a.vtkhdf: cannot be written: File too large");
    EXPECT_EQ(folder.files(), Names{});
  }
}

TEST(vtkhdf, equal_contents_make_equal_files) {
  const TemporaryFolder folder;
  write_vtkhdf(folder.path() / "a.vtkhdf", grid_at(0.5));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 knows times of creation in whole seconds
  write_vtkhdf(folder.path() / "b.vtkhdf", grid_at(0.5));
  EXPECT_EQ(test::read_text(folder.path() / "a.vtkhdf"), test::read_text(folder.path() / "b.vtkhdf"));
}

TEST(vtkhdf, series_lists_the_snapshots_with_their_times) {
  const TemporaryFolder folder;
  SnapshotSeries series(folder.path() / "snapshots", "elements");
  for (const Real time : {0.0, 2.5e-5, 5e-5}) {
    series.write(grid_at(time));
    const auto list = list_of(folder.path() / "snapshots" / "elements.vtkhdf.series");
    ASSERT_EQ(list.at("files").size(), series.size());
    EXPECT_EQ(list.at("files").back().at("time").get<Real>(), time);
  }
  const auto list = list_of(folder.path() / "snapshots" / "elements.vtkhdf.series");
  EXPECT_EQ(list.at("file-series-version"), "1.0");
  EXPECT_EQ(list.at("files")[2].at("name"), "elements_00002.vtkhdf");
  for (const auto& entry : list.at("files")) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "snapshots" / entry.at("name").get<std::string>()));
  }
  EXPECT_EQ(list, list_of(folder.path() / "snapshots" / "elements.hdf.series"));
}

TEST(vtkhdf, synced_series_is_what_was_written) {
  const TemporaryFolder folder;
  SnapshotSeries series(folder.path(), "elements");
  series.sync();  // nothing yet
  series.write(grid_at(0));
  series.write(grid_at(1));
  series.sync();
  EXPECT_EQ(folder.files(),
            (Names{"elements.hdf.series", "elements.vtkhdf.series", "elements_00000.vtkhdf", "elements_00001.vtkhdf"}));
  series.write(grid_at(2));
  std::filesystem::remove(folder.path() / "elements_00002.vtkhdf");
  EXPECT_WORDS(words_of<MachineError>([&] { series.sync(); }), "elements_00002.vtkhdf: cannot be written");
}

TEST(vtkhdf, resumed_series_equals_an_uninterrupted_one) {
  const TemporaryFolder folder;
  const auto write = [](SnapshotSeries& series, int from, int to) {
    for (int i = from; i < to; ++i) series.write(grid_at(i * 0.1));
  };
  SnapshotSeries whole(folder.path() / "whole", "elements");
  write(whole, 0, 6);
  SnapshotSeries interrupted(folder.path() / "resumed", "elements");
  write(interrupted, 0, 5);
  write_vtkhdf(folder.path() / "resumed" / "elements_00005.vtkhdf",
               grid_at(9));  // stopped before it was listed

  SnapshotSeries resumed(folder.path() / "resumed", "elements");
  resumed.resume(2);
  EXPECT_EQ(resumed.size(), 2u);
  for (int i = 2; i < 6; ++i) {
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "resumed" / ("elements_0000" + std::to_string(i) + ".vtkhdf")));
  }
  write(resumed, 2, 6);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "whole")) {
    EXPECT_EQ(test::read_text(entry.path()), test::read_text(folder.path() / "resumed" / entry.path().filename()))
        << entry.path();
  }
}

TEST(vtkhdf, resume_refuses_a_list_that_is_missing_short_or_damaged) {
  const TemporaryFolder folder;
  SnapshotSeries series(folder.path(), "elements");
  const auto words = [&](std::size_t count) { return words_of<UserError>([&] { series.resume(count); }); };
  EXPECT_WORDS(words(1), "elements.vtkhdf.series: should list at least the 1 snapshots of the run to be resumed, but lists 0");
  series.write(grid_at(0));
  EXPECT_WORDS(words(2), "lists 1");
  test::write_text(folder.path() / "elements.vtkhdf.series", "{\"files\": [{\"na");
  EXPECT_WORDS(words(1), "lists 0");
  test::write_text(folder.path() / "elements.vtkhdf.series", "{\"files\": [{\"name\": 3}]}");
  EXPECT_WORDS(words(1), "lists 0");
}

TEST(vtkhdf, folder_that_cannot_be_made) {
  const TemporaryFolder folder;
  test::write_text(folder.path() / "file", "");
  EXPECT_WORDS(words_of<MachineError>([&] { SnapshotSeries(folder.path() / "file" / "snapshots", "a"); }), "cannot be written");
}

}  // namespace
}  // namespace sazare::observe
