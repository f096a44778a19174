#pragma once

/// What a run of method mps writes down: histories, gauges, snapshots, headline figures. It never changes the run.

#include "sazare/methods/mps/run/model.hpp"
#include "sazare/methods/mps/run/tensor_fields.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/record_files.hpp"
#include "sazare/runs/run_clocks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

/// The particle nearest to each gauge of a case. Throws UserError when one is farther than a spacing from all.
template <int D>
std::vector<std::size_t> gauge_particles(const cases::CaseFile& file, const Filling<D>& filling);

template <int D>
class MpsRecord {
public:
  /// Writes nothing yet. Throws UserError when a gauge is farther than a spacing from every particle.
  MpsRecord(const RunFolder& folder, const cases::CaseFile& file, MpsModel<D>& model, const RunClocks& clocks);

  void begin() { files_.begin(tables()); }
  void resume() { files_.resume(tables()); }
  void observe(std::int64_t step, Real wall_seconds);
  void flush(bool to_disk) { files_.flush(to_disk); }

  /// Throws PhysicsError when an acceleration is not a number or has diverged.
  void check_motion(Real time) const;

  std::vector<std::pair<std::string, observe::Figure>> results(std::int64_t step, Real wall_seconds) const;
  std::vector<std::pair<std::string, Real>> peak_particle_velocity() const;
  std::uint64_t state_hash() const;
  /// As of the last row [J; J/m in 2-D].
  Real energy_residual() const { return residual_; }

  void columns(Archive& archive);

private:
  std::vector<RecordFiles::Table> tables() const;  ///< history, gauges
  Vector3 displacement_of(std::size_t i) const;    ///< since the beginning [m]
  Real settlement() const;                         ///< largest displacement to equilibrium under gravity [m]
  bool has_energy_balance() const { return file_->as<cases::MpsCase>().time.integrator != cases::Integrator::euler; }
  const methods::mps::SurfaceContacts<D>* surface() const {
    return model_->at_surface != nullptr ? model_->at_surface->surface() : nullptr;
  }
  const std::vector<std::int32_t>& supported();
  void close_energy_balance(bool at_beginning);
  void write_snapshot(Real time, const state::FreedomColumns<D>& velocity, const state::FreedomColumns<D>& acceleration);

  const RunFolder* folder_;
  const cases::CaseFile* file_;
  MpsModel<D>* model_;
  RunClocks clocks_;
  std::vector<std::size_t> gauge_particles_;
  RecordFiles files_;
  TensorFields<D> tensors_;
  std::vector<std::int32_t> supported_;  ///< see supported
  std::vector<Real> peaks_;  ///< largest speed by gauge [m/s]
  Real displacement_ = 0;    ///< largest of the last row [m]
  Real largest_displacement_ = 0, largest_speed_ = 0, largest_acceleration_ = 0;
  Real kinetic_ = 0, elastic_ = 0;
  particles::WorkByCause work_;
  Real energy_at_beginning_ = 0, residual_ = 0;
};

extern template std::vector<std::size_t> gauge_particles<2>(const cases::CaseFile&, const Filling<2>&);
extern template std::vector<std::size_t> gauge_particles<3>(const cases::CaseFile&, const Filling<3>&);
extern template class MpsRecord<2>;
extern template class MpsRecord<3>;

}  // namespace sazare::runs
