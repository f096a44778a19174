#include "sazare/methods/blocks/run/record.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/failure.hpp"
#include "sazare/methods/blocks/run/state_hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

static_assert(columns::blocks::energies.size() == terms::energy_kind_count, "a column for each account, in their order");

std::vector<std::string> history_titles(const cases::BlocksCase& blocks) {
  std::vector<std::string> titles;
  observe::add_titles(titles, columns::time);
  observe::add_titles(titles, columns::blocks::pieces);
  observe::add_titles(titles, columns::blocks::energies);
  observe::add_titles(titles, columns::blocks::progress);
  for (const cases::Boundary& boundary : blocks.boundaries)
    observe::add_titles(titles, columns::blocks::boundary, boundary.surface, 3);
  for (const cases::Charge& charge : blocks.charges) observe::add_titles(titles, columns::blocks::charge, charge.name);
  observe::add_titles(titles, columns::clock);
  return titles;
}

}  // namespace

RunRecord::RunRecord(const RunFolder& folder, const cases::CaseFile& file, BlocksModel& model, const RunClocks& clocks)
    : folder_(&folder),
      file_(&file),
      model_(&model),
      clocks_(clocks),
      gauges_(file, model.mesh),
      snapshots_(folder.snapshots(), model) {}

std::uint64_t RunRecord::state_hash() const { return runs::state_hash(*model_); }

std::vector<RecordFiles::Table> RunRecord::tables() const {
  return {{folder_->history(), history_titles(file_->as<cases::BlocksCase>())}, {folder_->gauges(), gauges_.titles()}};
}

void RunRecord::begin() { files_.begin(tables()); }

void RunRecord::resume() {
  files_.resume(tables());
  snapshots_.resume(static_cast<std::size_t>(snapshot_count_));
}

void RunRecord::check_motion(Real time) const {
  if (find_failed_element(*model_) >= 0) throw PhysicsError(describe_failure(*model_, *file_, time));
}

void RunRecord::survey(std::int64_t step, const parallel::Ranks* ranks) {
  survey_ = model_->simulation->survey(std::move(former_survey_));
  sum_absorbed(clocks_.time(step), ranks);
  if (clocks_.is_snapshot(step)) model_->simulation->collect();
}

void RunRecord::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  if (!survey_) survey(step, nullptr);
  former_survey_ = *std::exchange(survey_, std::nullopt);
  levels::Snapshot<3>& now = former_survey_.bodies;
  Real fastest_squared = 0;
  for (const Vector3& velocity : now.velocity) fastest_squared = std::max(fastest_squared, velocity.squaredNorm());
  peak_speed_ = std::max(peak_speed_, std::sqrt(fastest_squared));
  for (const state::StrainNow& strain : now.strain) peak_strain_ = std::max(peak_strain_, strain.strain.norm());
  files_.add_row(1, gauges_.sample(time, model_->simulation->bodies(), now));
  add_history_row(time, wall_seconds);
  if (!clocks_.is_snapshot(step)) return;
  snapshots_.write(time, std::move(now), fragments());
  ++snapshot_count_;
}

void RunRecord::add_history_row(Real time, Real wall_seconds) {
  const terms::EnergyBalance& balance = former_survey_.energy;
  latest_smallest_step_ = model_->simulation->take_smallest_step();
  smallest_step_ = smallest_step_ > 0 ? std::min(smallest_step_, latest_smallest_step_) : latest_smallest_step_;
  std::vector<Real> row = {time, static_cast<Real>(model_->joints->broken_count()), static_cast<Real>(fragments().count)};
  row.insert(row.end(), balance.joules.begin(), balance.joules.end());
  energy_residual_ = balance.residual();
  row.push_back(energy_residual_);
  row.push_back(latest_smallest_step_);
  row.push_back(static_cast<Real>(model_->simulation->counters().pair_evaluations));
  const std::vector<Vector3> forces = boundary_forces(time);
  for (std::size_t boundary = 0; boundary < forces.size(); ++boundary) {
    row.insert(row.end(), forces[boundary].begin(), forces[boundary].end());
    row.push_back(absorbed_[boundary].value());
  }
  for (const methods::blocks::ChargeState& charge : charge_states(time))
    row.insert(row.end(), {charge.pressure, charge.volume, charge.released, charge.work, charge.lost, charge.in_cracks});
  row.push_back(wall_seconds);
  files_.add_row(0, row);
}

/// Forces of the boundaries of the case on the body at the row that is written [N].
std::vector<Vector3> RunRecord::boundary_forces(Real time) const {
  const std::size_t count = file_->as<cases::BlocksCase>().boundaries.size();
  if (model_->boundaries == nullptr) return std::vector<Vector3>(count, Vector3::Zero());
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  const levels::Snapshot<3>& now = former_survey_.bodies;
  return model_->boundaries->forces(time, [&](Index body) -> methods::blocks::BodyMotion {
    const state::Pose<3>& pose = now.pose[at(body)];
    const state::StrainNow strain = now.strain.empty() ? state::StrainNow{} : now.strain[at(body)];
    return {pose, now.velocity[at(body)],
            motion::spin_of(pose.rotation, bodies.inertia[at(body)], bodies.locks[at(body)], now.angular_momentum[at(body)]),
            strain.strain, strain.rate};
  });
}

/// What the charges of the case have become by a time [s].
std::vector<methods::blocks::ChargeState> RunRecord::charge_states(Real time) const {
  if (model_->charges == nullptr) return std::vector<methods::blocks::ChargeState>(file_->as<cases::BlocksCase>().charges.size());
  return model_->charges->states(time);
}

/// Each process sums over its own elements, and the first one over the processes.
void RunRecord::sum_absorbed(Real time, const parallel::Ranks* ranks) {
  absorbed_.assign(file_->as<cases::BlocksCase>().boundaries.size(), {});
  if (model_->boundaries == nullptr) return;
  const levels::Simulation<3>& simulation = *model_->simulation;
  model_->boundaries->add_dissipated(
      {survey_->bodies.pose, survey_->ahead, time, nullptr, survey_->bodies.strain},
      [&](Index body) { return simulation.owns(body); },
      [&](Index body) { return simulation.work_on(body)[static_cast<std::size_t>(terms::Cause::boundary)]; }, absorbed_);
  if (ranks == nullptr) return;
  const parallel::Gathered all = ranks->gather(std::as_bytes(std::span(absorbed_)), parallel::Topic::rows, parallel::To::first);
  if (!ranks->is_first()) return;
  std::vector<ExactSum> part(absorbed_.size());
  absorbed_.assign(part.size(), {});
  for (int rank = 0; rank < ranks->size(); ++rank) {
    std::memcpy(static_cast<void*>(part.data()), all.of(rank).data(), all.of(rank).size());
    for (std::size_t boundary = 0; boundary < part.size(); ++boundary) absorbed_[boundary] += part[boundary];
  }
}

const FragmentMap& RunRecord::fragments() {
  const Index broken = model_->joints->broken_count();
  if (fragments_at_broken_ != broken) fragments_ = find_fragments(model_->simulation->bodies().size(), *model_->joints);
  fragments_at_broken_ = broken;
  return fragments_;
}

void RunRecord::flush(bool to_disk) {
  files_.flush(to_disk);
  if (!to_disk) return;
  snapshots_.sync();
  former_survey_ = {};  // a checkpoint, which comes next, takes as much
}

/// Largest first, those that stay marked.
std::vector<Fragment> RunRecord::measured_fragments(const levels::Snapshot<3>& now) {
  const state::Bodies<3>& bodies = model_->simulation->bodies();
  std::vector<Fragment> measured = measure_fragments(fragments(), model_->mesh, bodies, now, model_->places_at_start());
  mark_staying(fragments(), anchored_elements(file_->as<cases::BlocksCase>(), model_->boundaries, bodies), measured);
  return measured;
}

void RunRecord::write_fragments() {
  runs::write_fragments(folder_->fragments(), measured_fragments(model_->simulation->snapshot()), FragmentTable::with_stays);
}

/// Of the holes in the mesh, by the fragments at the end.
std::vector<HalfCast> RunRecord::half_casts(std::span<const Fragment> pieces) {
  const FragmentMap& map = fragments();
  std::vector<bool> fragment_stays(static_cast<std::size_t>(map.count)), stays;
  for (const Fragment& piece : pieces) fragment_stays[at(piece.number)] = piece.stays;
  for (const Index fragment : map.of_element) stays.push_back(fragment_stays[at(fragment)]);
  return measure_half_casts(file_->as<cases::BlocksCase>(), model_->mesh, stays);
}

void RunRecord::write_half_casts() {
  runs::write_half_casts(folder_->half_casts(), half_casts(measured_fragments(model_->simulation->snapshot())));
}

namespace {

Real volume_of(std::span<const Fragment> fragments) {
  Real volume = 0;
  for (const Fragment& fragment : fragments) volume += fragment.volume;
  return volume;
}

/// Largest displacement until time began [m].
Real settlement(const BlocksModel& model) {
  Real largest = 0;
  for (std::size_t element = 0; element < model.equilibrium.size(); ++element)
    largest = std::max(largest, (model.equilibrium[element] - model.simulation->bodies().start[element]).norm());
  return largest;
}

std::int64_t broken_in_shear(const methods::blocks::Joints& joints) {
  std::int64_t count = 0;
  for (Index joint = 0; joint < joints.count(); ++joint)
    if (is_crack(joints.state(joint)) && joints.losses(joint).is_mostly_shear()) ++count;
  return count;
}

/// Of the strength of cracks by the rate of loading; 1 where there are none.
Real mean_strength_factor(const methods::blocks::Joints& joints) {
  Real sum = 0;
  for (Index joint = 0; joint < joints.count(); ++joint)
    if (is_crack(joints.state(joint))) sum += joints.strength_factor(joint);
  return joints.broken_count() > 0 ? sum / static_cast<Real>(joints.broken_count()) : 1;
}

}  // namespace

std::vector<std::pair<std::string, observe::Figure>> RunRecord::results(std::int64_t step, Real wall_seconds) {
  const auto& simulation = *model_->simulation;
  const levels::Counters& counters = simulation.counters();
  const levels::Snapshot<3> now = simulation.snapshot();
  const terms::EnergyBalance balance = simulation.energy_balance(now);
  const std::vector<Fragment> pieces = measured_fragments(now), loose = detached(pieces);
  Real farthest = 0;
  for (const Fragment& piece : pieces) farthest = std::max(farthest, piece.throw_distance);
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"broken_joints", std::int64_t{model_->joints->broken_count()}},
      {"broken_in_shear", broken_in_shear(*model_->joints)},
      {"joints", static_cast<std::int64_t>(model_->joints->links().size())},
      {"fragments", std::int64_t{fragments().count}},
      {"detached_fragments", static_cast<std::int64_t>(loose.size())},
      {"elements", std::int64_t{simulation.bodies().size()}},
      {"pair_evaluations", counters.pair_evaluations},
      {"uniform_evaluations", counters.uniform_evaluations},
      {"wall_seconds", wall_seconds},
      {"steps", step},
      {"updates", counters.kicks},
      {"update_times", counters.ticks},
      {"smallest_step", smallest_step_}};
  for (std::size_t i = 0; i < balance.joules.size(); ++i)
    results.emplace_back(columns::blocks::energies[i].name, balance.joules[i]);
  results.emplace_back("energy_residual", balance.residual());
  if (model_->joints->follow_rates()) results.emplace_back("dynamic_increase", mean_strength_factor(*model_->joints));
  if (model_->charges != nullptr) {
    Real released = 0, work = 0;
    for (const methods::blocks::ChargeState& charge : charge_states(clocks_.time(step))) {
      released += charge.released;
      work += charge.work;
    }
    results.emplace_back("explosive_released", released);
    results.emplace_back("explosive_work", work);
  }
  results.emplace_back("detached_volume", volume_of(loose));
  if (const std::vector<HalfCast> casts = half_casts(pieces); !casts.empty())
    results.emplace_back("half_cast_factor", half_cast_factor(casts));
  results.emplace_back("p20", passing_size(loose, 0.2));
  results.emplace_back("p50", passing_size(loose, 0.5));
  results.emplace_back("p80", passing_size(loose, 0.8));
  results.emplace_back("largest_fragment_volume", pieces.empty() ? 0 : pieces.front().volume);
  results.emplace_back("throw_max", farthest);
  if (!model_->equilibrium.empty()) results.emplace_back("settlement", settlement(*model_));
  results.emplace_back("peak_speed", peak_speed_);
  if (!now.strain.empty()) results.emplace_back("peak_strain", peak_strain_);
  return results;
}

void RunRecord::columns(Archive& archive) {
  files_.columns(archive);
  archive("snapshots", snapshot_count_);
  archive("smallest_step", smallest_step_);
  archive("latest_smallest_step", latest_smallest_step_);
  archive("peak_speed", peak_speed_);
  archive("peak_strain", peak_strain_);
  archive.folder("gauges", [&] { gauges_.columns(archive); });
}

}  // namespace sazare::runs
