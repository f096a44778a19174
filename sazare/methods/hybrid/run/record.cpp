#include "sazare/methods/hybrid/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <variant>

#include "sazare/core/error.hpp"
#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/methods/hybrid/run/columns.hpp"
#include "sazare/methods/hybrid/run/continuum.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

template <int D, class Bodies>
HybridRecord<D, Bodies>::HybridRecord(const HybridParts<D, Bodies>& parts, const RunClocks& clocks)
    : parts_(parts),
      clocks_(clocks),
      continuum_(parts.continuum_folder, *parts.file.template as<cases::HybridCase>().continuum, parts.continuum, clocks),
      bodies_(parts.bodies_folder, *parts.file.template as<cases::HybridCase>().bodies, parts.bodies.model, clocks) {}

template <int D, class Bodies>
std::vector<RecordFiles::Table> HybridRecord<D, Bodies>::tables() const {
  std::vector<std::string> history;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::hybrid::history);
  observe::add_titles(history, columns::clock);
  return {{parts_.folder.history(), history}};
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::begin() {
  files_.begin(tables());
  continuum_.begin();
  bodies_.begin();
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::resume() {
  files_.resume(tables());
  continuum_.resume();
  bodies_.resume();
}

/// Residual of the energy balance of both sides and the surface [J].
template <int D, class Bodies>
Real HybridRecord<D, Bodies>::residual() const {
  const Real width = D == 2 ? parts_.side.rules().width : 1;
  return width * parts_.continuum.stepper->energy_residual() + bodies_.energy_residual();
}

template <int D, class Bodies>
std::vector<Real> HybridRecord<D, Bodies>::row(Real time, Real wall_seconds) const {
  const auto& totals = parts_.side.totals();
  std::vector<Real> row = {time};
  for (const Vector3& value :
       {parts_.side.mean_displacement(), parts_.side.mean_force(), parts_.side.last_force(), totals.given, totals.under_way()})
    row.insert(row.end(), value.begin(), value.end());
  const Real width = D == 2 ? parts_.side.rules().width : 1;
  row.insert(row.end(), {totals.energy_work_on_nodes, totals.energy_work_on_bodies, totals.made(),
                         width * parts_.continuum.stepper->energy_residual(), bodies_.energy_residual(),
                         static_cast<Real>(totals.passes), parts_.side.disagreement(), wall_seconds});
  return row;
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  continuum_.observe(step, wall_seconds);
  bodies_.observe(step, wall_seconds);
  files_.add_row(0, row(clocks_.time(step), wall_seconds));
  largest_force_ = std::max(largest_force_, parts_.side.mean_force().norm());
  largest_displacement_ = std::max(largest_displacement_, parts_.side.mean_displacement().norm());
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::flush(bool to_disk) {
  files_.flush(to_disk);
  continuum_.flush(to_disk);
  bodies_.flush(to_disk);
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::check_motion(Real time) const {
  try {
    continuum_.check_motion(time);
    bodies_.check_motion(time);
  } catch (const PhysicsError& error) {
    const auto& rules = parts_.side.rules();
    using methods::hybrid::CouplingScheme;
    if (rules.scheme != CouplingScheme::lagged && rules.scheme != CouplingScheme::impulse) throw;
    throw PhysicsError(
        fmt::format("{}\n  the coupling added {:.3g} J until then: a scheme that lags behind does so where the contact is stiff beside "
                    "the surface; set coupling.scheme = \"automatic\"",
                    error.what(), parts_.side.totals().made()));
  }
}

namespace {

/// The reference of a side's residual: its work, or the works by cause that it names [J].
Real work_of(const std::vector<std::pair<std::string, observe::Figure>>& figures) {
  Real sum = 0;
  for (const auto& [name, value] : figures)
    if (name.starts_with("energy_work"))
      sum += std::visit([](auto number) { return std::abs(static_cast<Real>(number)); }, value);
  return sum;
}

}  // namespace

template <int D, class Bodies>
std::vector<std::pair<std::string, observe::Figure>> HybridRecord<D, Bodies>::results(std::int64_t step, Real wall_seconds) {
  const auto& totals = parts_.side.totals();
  return {{"windows", step},
          {"window", parts_.continuum.step},
          {"passes", totals.passes},
          {"unconverged_windows", totals.unconverged},
          {"steps_per_window", parts_.steps_per_window},
          {"step", parts_.bodies.step()},
          {"elements", static_cast<std::int64_t>(parts_.continuum.mesh().elements.size())},
          {"degrees_of_freedom", static_cast<std::int64_t>(parts_.continuum.stepper->free_freedoms())},
          {Bodies::count_key, parts_.bodies.count()},
          {Bodies::steps_key, parts_.bodies.count() * parts_.steps_per_window * totals.passes},
          {"wall_seconds", wall_seconds},
          {"impulse_given", totals.given.norm()},
          {"impulse_pending", totals.under_way().norm()},
          {"energy_work_on_nodes", totals.energy_work_on_nodes},
          {"energy_coupling_error", totals.made()},
          {"energy_work", work_of(continuum_.results(step, wall_seconds)) + work_of(bodies_.results(step, wall_seconds))},
          {"energy_residual", files_.rows() > 0 ? residual() : 0},
          {"peak_force", largest_force_},
          {"peak_displacement", largest_displacement_}};
}

template <int D, class Bodies>
std::vector<std::pair<std::string, Real>> HybridRecord<D, Bodies>::peak_particle_velocity() const {
  auto peaks = continuum_.peak_particle_velocity();
  for (auto& peak : bodies_.peak_particle_velocity()) peaks.push_back(std::move(peak));
  return peaks;
}

template <int D, class Bodies>
std::uint64_t HybridRecord<D, Bodies>::state_hash() const {
  const std::array<std::uint64_t, 2> both = {continuum_.state_hash(), bodies_.state_hash()};
  observe::Hash hash;
  hash.add(std::as_bytes(std::span(both)));
  return hash.value();
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::write_end() {
  if constexpr (requires { bodies_.write_fragments(); }) bodies_.write_fragments();
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::write_manifests(const observe::Manifest& like, std::int64_t step, Real wall_seconds) {
  observe::Manifest manifest = like;
  manifest.case_title = cases::continuum_of(parts_.file.template as<cases::HybridCase>()).title;
  manifest.method = std::string(cases::continuum_method);
  manifest.results = continuum_.results(step, wall_seconds);
  manifest.peak_particle_velocity = continuum_.peak_particle_velocity();
  manifest.state_hash = continuum_.state_hash();
  observe::write_manifest(parts_.continuum_folder.manifest(), manifest);
  manifest.case_title = parts_.bodies.title();
  manifest.method = Bodies::method;
  manifest.results = bodies_.results(step * parts_.steps_per_window, wall_seconds);
  manifest.peak_particle_velocity = bodies_.peak_particle_velocity();
  manifest.state_hash = bodies_.state_hash();
  observe::write_manifest(parts_.bodies_folder.manifest(), manifest);
}

template <int D, class Bodies>
void HybridRecord<D, Bodies>::columns(Archive& archive) {
  files_.columns(archive);
  archive("largest_force", largest_force_);
  archive("largest_displacement", largest_displacement_);
  archive.folder("continuum", [&] { continuum_.columns(archive); });
  archive.folder("bodies", [&] { bodies_.columns(archive); });
}

template class HybridRecord<2, CoupledSpheres>;
template class HybridRecord<3, CoupledSpheres>;
template class HybridRecord<2, CoupledRectangles>;
template class HybridRecord<2, CoupledBlocks>;
template class HybridRecord<3, CoupledBlocks>;
template class HybridRecord<2, CoupledGround<2>>;
template class HybridRecord<3, CoupledGround<3>>;

}  // namespace sazare::runs
