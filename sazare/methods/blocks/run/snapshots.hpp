#pragma once

#include <future>

#include "sazare/methods/blocks/run/block_fragments.hpp"
#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/observe/vtkhdf.hpp"

namespace sazare::runs {

/// Pictures of a run for ParaView and pyvista: the elements, and the joints between them, at the snapshot times. Files are
/// written while the run goes on; what goes wrong then is thrown by the next call. What a file holds is made from places and
/// velocities as it is written, piece by piece: all of it at once would be four times as large as they are.
class Snapshots {
public:
  /// Makes the folder.
  Snapshots(const std::filesystem::path& folder, const BlocksModel& model);

  void write(Real time, levels::Snapshot<3> now, const FragmentMap& fragments);

  /// Brings what was written to the disk; to be called before a checkpoint counts on it.
  void sync();

  /// Goes on after the first `count` of an earlier run.
  void resume(std::size_t count);

private:
  struct Picture;
  void write_elements(const Picture& picture);
  void write_joints(const Picture& picture);
  void finish_writing();

  const BlocksModel* model_;
  observe::SnapshotSeries elements_;
  observe::SnapshotSeries joints_;
  std::future<void> writing_;  ///< the snapshot in the making; last, so that it ends before the rest goes
};

}  // namespace sazare::runs
