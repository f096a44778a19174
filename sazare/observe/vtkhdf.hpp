#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sazare/core/vector.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hdf5_file.hpp"

namespace sazare::observe {

/// Numbers of the cells, or of the points, of a grid under a name, (n, components).
struct CellData {
  std::string name;
  std::size_t components = 1;  ///< 1 or 3
  std::variant<std::span<const Real>, std::span<const std::int32_t>, MadeNumbers<Real>, MadeNumbers<std::int32_t>> values;
};

/// A grid of cells, as views on the caller's memory.
struct Grid {
  /// Cell types by VTK's numbers.
  enum class Cell : std::uint8_t { vertex = 1, triangle = 5, polygon = 7, tetrahedron = 10 };

  Cell cell = Cell::tetrahedron;
  std::span<const Vector3> points;             ///< positions [m], (n, 3)
  std::span<const std::int32_t> connectivity;  ///< point indices, (cells, corners); of polygons one after the other
  std::vector<CellData> cell_data;
  Real time = 0;                            ///< [s]
  std::span<const std::int64_t> ends = {};  ///< of polygons: where each ends in the connectivity

  std::span<const std::uint8_t> types = {};   ///< VTK's number of every cell, where they are not all equal
  std::span<const CellData> point_data = {};  ///< numbers of the points, (points, components)

  /// Points that are made while they are written, in place of `points` and `connectivity`: every cell has its own, in order.
  MadeNumbers<Real> own_points = {};
};

/// Writes a VTKHDF file (version 1.0, UnstructuredGrid), which ParaView 5.11 and newer and pyvista open; the
/// time is the field data `time`. The file appears whole or not at all. Throws MachineError when the disk
/// fails.
void write_vtkhdf(const std::filesystem::path& file, const Grid& grid, Sync sync = Sync::disk);

/// Snapshots of one grid over time: `<name>_00000.vtkhdf`, `<name>_00001.vtkhdf` ... and
/// `<name>.vtkhdf.series`, the list with the times that ParaView opens as one. ParaView 5.11 knows the reader
/// by the ending .hdf only, so the same list stands in `<name>.hdf.series` too. The lists are renewed after
/// each snapshot.
class SnapshotSeries {
public:
  /// Makes the folder. Nothing is written yet.
  SnapshotSeries(std::filesystem::path folder, std::string name);

  /// Writes a snapshot and renews the lists, with Sync::system.
  void write(const Grid& grid);

  /// Brings all that was written so far to the disk; to be called before a checkpoint counts on it.
  void sync();

  /// Brings the snapshots to the disk, so that less is left for `sync`: where somebody has the time.
  void sync_early();

  /// Number of snapshots written.
  std::size_t size() const { return times_.size(); }

  /// Goes on after the first `count` snapshots of an earlier run; later ones are removed.
  /// Throws UserError when the list in the folder is missing, damaged or shorter.
  void resume(std::size_t count);

private:
  std::string file_name(std::size_t index) const;
  std::filesystem::path series_file(const std::string& ending) const;
  void write_series() const;

  std::filesystem::path folder_;
  std::string name_;
  std::vector<Real> times_;
  std::size_t synced_ = 0;  ///< snapshots that are on the disk
  bool is_listed_ = true;   ///< so are their names and the lists
};

}  // namespace sazare::observe
