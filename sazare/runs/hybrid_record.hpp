#pragma once

/// What a run of method hybrid writes down: each side in a folder of its own, as if it were run alone, and what goes over the
/// surface between them. It never changes the run.

#include "sazare/engine/continuum_side.hpp"
#include "sazare/engine/sphere_side.hpp"
#include "sazare/runs/fem_record.hpp"
#include "sazare/runs/spheres_record.hpp"

namespace sazare::runs {

/// A hybrid run's parts, as its record looks at them. Steps are windows.
template <int D>
struct HybridParts {
  const cases::CaseFile& file;
  const RunFolder &folder, &continuum_folder, &bodies_folder;
  FemModel<D>& continuum;
  SpheresModel& bodies;
  const engine::ContinuumSide<D>& side;
  std::int64_t steps_per_window;  ///< of the bodies
};

template <int D>
class HybridRecord {
public:
  HybridRecord(const HybridParts<D>& parts, const RunClocks& clocks);

  void begin();
  void resume();
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk);

  /// Throws PhysicsError as the records of the sides do.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;

  void write_fragments() const { bodies_.write_fragments(); }

  /// Manifests of the two sides.
  void write_manifests(const observe::Manifest& like, std::int64_t step, Real wall_seconds) const;

  void columns(Archive& archive);

private:
  std::vector<Real> row(Real time, Real wall_seconds) const;
  Real residual() const;

  HybridParts<D> parts_;
  RunClocks clocks_;
  FemRecord<D> continuum_;
  SpheresRecord bodies_;
  std::optional<observe::CsvWriter> history_;
  Real largest_force_ = 0;         ///< of the bodies on the surface, mean of a window [N]
  Real largest_displacement_ = 0;  ///< mean of the surface's nodes [m]
  Real first_sum_ = 0;             ///< of the bodies' energies [J]
  std::int64_t rows_ = 0;
};

extern template class HybridRecord<2>;
extern template class HybridRecord<3>;

}  // namespace sazare::runs
