#include "sazare/runs/hybrid_record.hpp"

#include <algorithm>

#include "sazare/observe/hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

template <int D>
HybridRecord<D>::HybridRecord(const HybridParts<D>& parts, const RunClocks& clocks)
    : parts_(parts),
      clocks_(clocks),
      continuum_(parts.continuum_folder, *parts.file.hybrid().continuum, parts.continuum, clocks),
      bodies_(parts.bodies_folder, *parts.file.hybrid().bodies, parts.bodies, clocks) {}

template <int D>
std::vector<RecordFiles::Table> HybridRecord<D>::tables() const {
  std::vector<std::string> history;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::hybrid::history);
  observe::add_titles(history, columns::clock);
  return {{parts_.folder.history(), history}};
}

template <int D>
void HybridRecord<D>::begin() {
  files_.begin(tables());
  continuum_.begin();
  bodies_.begin();
}

template <int D>
void HybridRecord<D>::resume() {
  files_.resume(tables());
  continuum_.resume();
  bodies_.resume();
}

/// Work that neither side's ledger accounts for, nor the surface's [J].
template <int D>
Real HybridRecord<D>::residual() const {
  const Real width = D == 2 ? parts_.side.rules().width : 1;
  return width * parts_.continuum.stepper->energy_residual() + parts_.bodies.stepper->energies().sum() - first_sum_;
}

template <int D>
std::vector<Real> HybridRecord<D>::row(Real time, Real wall_seconds) const {
  const auto& ledger = parts_.side.ledger();
  std::vector<Real> row = {time};
  for (const Vector3& value :
       {parts_.side.mean_displacement(), parts_.side.mean_force(), parts_.side.last_force(), ledger.given, ledger.under_way()})
    row.insert(row.end(), value.begin(), value.end());
  const Real width = D == 2 ? parts_.side.rules().width : 1;
  row.insert(row.end(),
             {ledger.work_on_nodes, ledger.work_on_bodies, ledger.made(), width * parts_.continuum.stepper->energy_residual(),
              parts_.bodies.stepper->energies().sum() - first_sum_, static_cast<Real>(ledger.passes), parts_.side.disagreement(),
              wall_seconds});
  return row;
}

template <int D>
void HybridRecord<D>::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  if (files_.rows() == 0) first_sum_ = parts_.bodies.stepper->energies().sum();
  files_.add_row(0, row(clocks_.time(step), wall_seconds));
  largest_force_ = std::max(largest_force_, parts_.side.mean_force().norm());
  largest_displacement_ = std::max(largest_displacement_, parts_.side.mean_displacement().norm());
  continuum_.observe(step, wall_seconds);
  bodies_.observe(step, wall_seconds);
}

template <int D>
void HybridRecord<D>::flush(bool to_disk) {
  files_.flush(to_disk);
  continuum_.flush(to_disk);
  bodies_.flush(to_disk);
}

template <int D>
void HybridRecord<D>::check_motion(Real time) const {
  continuum_.check_motion(time);
  bodies_.check_motion(time);
}

template <int D>
std::vector<std::pair<std::string, observe::Figure>> HybridRecord<D>::results(std::int64_t step, Real wall_seconds) const {
  const auto& ledger = parts_.side.ledger();
  const auto spheres = static_cast<std::int64_t>(parts_.bodies.group.size());
  return {{"windows", step},
          {"window", parts_.continuum.step},
          {"passes", ledger.passes},
          {"steps_per_window", parts_.steps_per_window},
          {"step", parts_.bodies.step},
          {"elements", static_cast<std::int64_t>(parts_.continuum.mesh().elements.size())},
          {"freedoms", static_cast<std::int64_t>(parts_.continuum.stepper->free_freedoms())},
          {"particles", spheres},
          {"particle_steps", spheres * parts_.steps_per_window * ledger.passes},
          {"wall_seconds", wall_seconds},
          {"impulse_given", ledger.given.norm()},
          {"impulse_under_way", ledger.under_way().norm()},
          {"work_on_nodes", ledger.work_on_nodes},
          {"energy_made", ledger.made()},
          {"energy_residual", files_.rows() > 0 ? residual() : 0},
          {"peak_force", largest_force_},
          {"peak_displacement", largest_displacement_}};
}

template <int D>
std::vector<std::pair<std::string, Real>> HybridRecord<D>::peak_particle_velocity() const {
  auto peaks = continuum_.peak_particle_velocity();
  for (auto& peak : bodies_.peak_particle_velocity()) peaks.push_back(std::move(peak));
  return peaks;
}

template <int D>
std::uint64_t HybridRecord<D>::state_hash() const {
  const std::array<std::uint64_t, 2> both = {continuum_.state_hash(), bodies_.state_hash()};
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(both)));
  return hash.value();
}

template <int D>
void HybridRecord<D>::write_manifests(const observe::Manifest& like, std::int64_t step, Real wall_seconds) const {
  observe::Manifest manifest = like;
  manifest.case_title = parts_.file.hybrid().continuum->fem().title;
  manifest.method = "fem";
  manifest.results = continuum_.results(step, wall_seconds);
  manifest.peak_particle_velocity = continuum_.peak_particle_velocity();
  manifest.state_hash = continuum_.state_hash();
  observe::write_manifest(parts_.continuum_folder.manifest(), manifest);
  manifest.case_title = parts_.file.hybrid().bodies->spheres().title;
  manifest.method = "spheres";
  manifest.results = bodies_.results(step * parts_.steps_per_window, wall_seconds);
  manifest.peak_particle_velocity = bodies_.peak_particle_velocity();
  manifest.state_hash = bodies_.state_hash();
  observe::write_manifest(parts_.bodies_folder.manifest(), manifest);
}

template <int D>
void HybridRecord<D>::columns(Archive& archive) {
  files_.columns(archive);
  archive("largest_force", largest_force_);
  archive("largest_displacement", largest_displacement_);
  archive("first_sum", first_sum_);
  archive.folder("continuum", [&] { continuum_.columns(archive); });
  archive.folder("bodies", [&] { bodies_.columns(archive); });
}

template class HybridRecord<2>;
template class HybridRecord<3>;

}  // namespace sazare::runs
