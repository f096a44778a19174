#pragma once

#include <future>

#include "sazare/observe/vtkhdf.hpp"
#include "sazare/runs/blocks_model.hpp"
#include "sazare/runs/fragments.hpp"

namespace sazare::runs {

/// Pictures of a run for ParaView and pyvista: the elements, and the joints between them, at the snapshot times. Files are
/// written while the run goes on; what goes wrong then is thrown by the next call.
class Snapshots {
public:
  /// Makes the folder.
  Snapshots(const std::filesystem::path& folder, const BlocksModel& model);

  void write(Real time, const engine::Snapshot<3>& now, const FragmentMap& fragments);

  /// Brings what was written to the disk; to be called before a checkpoint counts on it.
  void sync();

  /// Goes on after the first `count` of an earlier run.
  void resume(std::size_t count);

private:
  /// A joint's face as a face of its first element.
  struct Face {
    Index joint = 0;
    std::array<Vector3, 3> corners;  ///< at the beginning [m]
    Vector3 normal;                  ///< out of the first element, at the beginning
  };

  struct ElementData;
  struct JointData;
  ElementData element_data(const engine::Snapshot<3>& now, const FragmentMap& fragments) const;
  JointData joint_data(const engine::Snapshot<3>& now) const;
  void write_elements(Real time, const ElementData& data);
  void write_joints(Real time, const JointData& data);
  std::vector<Real> damage() const;
  void finish_writing();

  const BlocksModel* model_;
  observe::SnapshotSeries elements_;
  observe::SnapshotSeries joints_;
  std::vector<Face> faces_;  ///< by joint
  std::vector<std::int32_t> tags_;
  std::future<void> writing_;  ///< the snapshot in the making; last, so that it ends before the rest goes
};

}  // namespace sazare::runs
