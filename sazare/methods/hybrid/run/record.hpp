#pragma once

/// What a run of method hybrid writes down: each side in a folder of its own, as if it were run alone, and what goes over the
/// surface between them. It never changes the run.

#include "sazare/methods/hybrid/continuum_side.hpp"
#include "sazare/methods/hybrid/run/continuum.hpp"
#include "sazare/methods/hybrid/run/coupled_bodies.hpp"

namespace sazare::runs {

/// A hybrid run's parts, as its record looks at them. Steps are windows.
template <int D, class Bodies>
struct HybridParts {
  const cases::CaseFile& file;
  const RunFolder &folder, &continuum_folder, &bodies_folder;
  ContinuumModel<D>& continuum;
  Bodies& bodies;
  const methods::hybrid::ContinuumSide<D>& side;
  std::int64_t steps_per_window;  ///< of the bodies
};

template <int D, class Bodies>
class HybridRecord {
public:
  HybridRecord(const HybridParts<D, Bodies>& parts, const RunClocks& clocks);

  void begin();
  void resume();
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk);

  /// Throws PhysicsError as the records of the sides do.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds);
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;

  /// What is written when the run is done.
  void write_end();

  /// Manifests of the two sides.
  void write_manifests(const observe::Manifest& like, std::int64_t step, Real wall_seconds);

  void columns(Archive& archive);

private:
  std::vector<RecordFiles::Table> tables() const;
  std::vector<Real> row(Real time, Real wall_seconds) const;
  Real residual() const;

  HybridParts<D, Bodies> parts_;
  RunClocks clocks_;
  ContinuumRecord<D> continuum_;
  typename Bodies::Record bodies_;
  RecordFiles files_;
  Real largest_force_ = 0;         ///< of the bodies on the surface, mean of a window [N]
  Real largest_displacement_ = 0;  ///< mean of the surface's nodes [m]
};

extern template class HybridRecord<2, CoupledSpheres>;
extern template class HybridRecord<3, CoupledSpheres>;
extern template class HybridRecord<2, CoupledRectangles>;
extern template class HybridRecord<2, CoupledBlocks>;
extern template class HybridRecord<3, CoupledBlocks>;
extern template class HybridRecord<2, CoupledGround<2>>;
extern template class HybridRecord<3, CoupledGround<3>>;

}  // namespace sazare::runs
