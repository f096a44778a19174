#include "sazare/methods/spheres/run/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/exact_vector.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/columns.hpp"
#include "sazare/methods/spheres/run/pieces.hpp"
#include "sazare/methods/spheres/stepper/clump_motion.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/runs/record_columns.hpp"

namespace sazare::runs {

namespace {

constexpr Real senseless_speed = 1e5;  // m/s; no grain moves so fast

/// What a gauge tells of a group, added up without rounding: in any order of its spheres.
struct GroupSums {
  bool has_gauge = false;
  ExactSum mass;
  ExactVector place, momentum;  ///< the place times the mass
  ExactVector force;

  void add(Real own, const Vector3& centre, const Vector3& velocity) {
    mass += own;
    place += Vector3(own * centre);
    momentum += Vector3(own * velocity);
  }
};

}  // namespace

SpheresRecord::SpheresRecord(const RunFolder& folder, const cases::CaseFile& file, SpheresModel& model, const RunClocks& clocks,
                             bool warns)
    : folder_(&folder),
      file_(&file),
      model_(&model),
      clocks_(clocks),
      files_(folder.snapshots(), "particles"),
      surface_files_(folder.snapshots(), "walls"),
      peaks_(file.as<cases::SpheresCase>().gauges.size(), 0),
      warns_(warns) {
  const auto& groups = file.as<cases::SpheresCase>().spheres;
  for (const cases::GroupGauge& gauge : file.as<cases::SpheresCase>().gauges)
    gauge_group_.push_back(
        static_cast<Index>(std::ranges::find(groups, gauge.group, &cases::SphereGroup::name) - groups.begin()));
}

std::vector<RecordFiles::Table> SpheresRecord::tables() const {
  std::vector<std::string> history, gauges, walls;
  observe::add_titles(history, columns::time);
  observe::add_titles(history, columns::spheres::history);
  observe::add_titles(history, columns::clock);
  observe::add_titles(gauges, columns::time);
  for (const auto& gauge : file_->as<cases::SpheresCase>().gauges) observe::add_titles(gauges, columns::spheres::gauge, gauge.name);
  observe::add_titles(walls, columns::time);
  for (const auto& wall : file_->as<cases::SpheresCase>().walls) observe::add_titles(walls, columns::spheres::wall, wall.name);
  return {{folder_->history(), history}, {folder_->gauges(), gauges}, {folder_->walls(), walls}};
}

void SpheresRecord::resume() {
  files_.resume(tables());
  if (kept_surfaces_ > 0) surface_files_.resume(kept_surfaces_);
}

void SpheresRecord::flush(bool to_disk) {
  files_.flush(to_disk);
  if (to_disk) surface_files_.sync();
}

void SpheresRecord::observe(std::int64_t step, Real wall_seconds) {
  if (!clocks_.is_row(step)) return;
  const Real time = clocks_.time(step);
  methods::spheres::SphereStepper& stepper = *model_->stepper;
  stepper.evaluate_now();
  stepper.look_at_step();
  energies_ = stepper.energies();
  if (files_.rows() == 0) first_sum_ = energies_.sum();
  const Real speed = stepper.largest_speed();
  files_.add_row(0, std::vector<Real>{time,
                                      energies_.translation,
                                      energies_.rotation,
                                      energies_.elastic,
                                      energies_.sliding,
                                      energies_.potential,
                                      energies_.dashpot_work,
                                      energies_.sliding_work,
                                      energies_.wall_work,
                                      energies_.bonds,
                                      energies_.bond_drag,
                                      energies_.fracture,
                                      energies_.water_work,
                                      energies_.applied_work,
                                      energies_.sum() - first_sum_,
                                      static_cast<Real>(stepper.contacts()),
                                      static_cast<Real>(stepper.broken_bonds()),
                                      static_cast<Real>(broken_bodies(stepper.bodies())),
                                      speed,
                                      wall_seconds});
  largest_speed_ = std::max(largest_speed_, speed);
  peak_kinetic_ = std::max(peak_kinetic_, energies_.translation + energies_.rotation);
  add_gauge_row(time);
  add_wall_row(time);
  if (clocks_.is_snapshot(step)) write_snapshot(time);
  check_step(time);
}

void SpheresRecord::add_gauge_row(Real time) {
  const state::Spheres& spheres = model_->stepper->spheres();
  std::vector<GroupSums> groups(file_->as<cases::SpheresCase>().spheres.size());
  for (const Index g : gauge_group_) groups[static_cast<std::size_t>(g)].has_gauge = true;
  if (!gauge_group_.empty())
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const auto number = static_cast<std::size_t>(spheres.number[i]);
      GroupSums& group = groups[static_cast<std::size_t>(model_->group[number])];
      if (!group.has_gauge) continue;
      const Real own = model_->body[number] < 0 ? spheres.place[i].mass : 0;  // the others have that of their clump
      group.add(own, spheres.place[i].centre(), model_->stepper->velocity(i));
      const state::SphereLoad load = model_->stepper->load(i);
      group.force += Vector3(load.fx, load.fy, load.fz);
    }
  const methods::spheres::SphereStepper& stepper = *model_->stepper;
  for (std::size_t c = 0; c < stepper.clumps().clumps.size(); ++c) {
    const state::Clump& clump = stepper.clumps().clumps[c];
    const auto first = static_cast<std::size_t>(stepper.clumps().members[stepper.clumps().begin_of(c)].sphere);
    GroupSums& group = groups[static_cast<std::size_t>(model_->group[first])];
    if (group.has_gauge) group.add(clump.mass, clump.centre, methods::spheres::velocity(clump));
  }
  std::vector<Real> row = {time};
  for (std::size_t gauge = 0; gauge < gauge_group_.size(); ++gauge) {
    const GroupSums& group = groups[static_cast<std::size_t>(gauge_group_[gauge])];
    const Real mass = group.mass.value();
    const Vector3 centre = group.place.value() / mass, velocity = group.momentum.value() / mass;
    for (const Vector3& value : {centre, velocity, group.force.value()}) row.insert(row.end(), value.begin(), value.end());
    peaks_[gauge] = std::max(peaks_[gauge], velocity.norm());
  }
  files_.add_row(1, row);
}

void SpheresRecord::add_wall_row(Real time) {
  std::vector<methods::spheres::WallLoad> total(file_->as<cases::SpheresCase>().walls.size());
  const auto loads = model_->stepper->walls().loads();
  for (std::size_t w = 0; w < model_->case_wall.size(); ++w) total[static_cast<std::size_t>(model_->case_wall[w])] += loads[w];
  std::vector<Real> row = {time};
  for (const auto& load : total)
    for (const Vector3& value : {load.force, load.moment}) row.insert(row.end(), value.begin(), value.end());
  files_.add_row(2, row);
}

void SpheresRecord::write_snapshot(Real time) {
  const state::Spheres& spheres = model_->stepper->spheres();
  const std::size_t n = spheres.size();
  std::vector<Vector3> place(n), velocity(n), spin(n);
  const std::vector<Real> broken = broken_fraction();
  std::vector<Real> radius(n);
  const std::vector<std::int32_t> body = body_numbers(*model_);
  std::vector<std::int32_t> cell(n), group(n), material(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto number = static_cast<std::size_t>(spheres.number[i]);
    place[number] = spheres.box.wrapped(spheres.place[i].centre());
    velocity[number] = model_->stepper->velocity(i);
    spin[number] = model_->stepper->spin(i);
    radius[number] = spheres.place[i].radius;
    group[number] = model_->group[number];
    material[number] = static_cast<std::int32_t>(spheres.spin[i].material);
    cell[number] = static_cast<std::int32_t>(number);
  }
  files_.add_snapshot({observe::Grid::Cell::vertex, place, cell,
                       observe::cell_data(columns::spheres::particles, velocity, spin, radius, group, material, body, broken),
                       time});
  write_surfaces(time);
}

/// The walls of triangles, where they are now; once where none of them moves.
void SpheresRecord::write_surfaces(Real time) {
  const std::vector<methods::spheres::Wall>& walls = model_->stepper->walls().walls();
  const auto has_triangles = [](const methods::spheres::Wall& wall) { return !wall.triangles.empty(); };
  const auto moves = [&](const methods::spheres::Wall& wall) { return has_triangles(wall) && wall.motion.moves(); };
  if (std::ranges::none_of(walls, has_triangles)) return;
  if (surface_files_.size() > 0 && std::ranges::none_of(walls, moves)) return;
  std::vector<Vector3> corners;
  std::vector<std::int32_t> entry;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const methods::spheres::WallPose pose = methods::spheres::WallPose::of(walls[w].motion, time);
    for (const geometry::Triangle& triangle : walls[w].triangles) {
      for (const Vector3& corner : triangle) corners.push_back(pose.out(corner));
      entry.push_back(static_cast<std::int32_t>(model_->case_wall[w]));
    }
  }
  std::vector<std::int32_t> points(corners.size());
  std::iota(points.begin(), points.end(), 0);
  surface_files_.write(
      {observe::Grid::Cell::triangle, corners, points, observe::cell_data(columns::spheres::surfaces, entry), time});
}

/// Share of its bonds that each sphere has lost, by number; 0 where it had none.
std::vector<Real> SpheresRecord::broken_fraction() const {
  const methods::spheres::Bonds& bonds = model_->stepper->bonds();
  std::vector<Real> all(model_->group.size(), 0), broken(all);
  for (std::size_t n = 0; n < bonds.bonds().size(); ++n)
    for (const Index end : {bonds.bonds()[n].first, bonds.bonds()[n].second}) {
      all[static_cast<std::size_t>(end)] += 1;
      broken[static_cast<std::size_t>(end)] += bonds.is_broken(n) ? 1 : 0;
    }
  for (std::size_t i = 0; i < all.size(); ++i) broken[i] = all[i] > 0 ? broken[i] / all[i] : 0;
  return broken;
}

void SpheresRecord::write_fragments() const {
  if (!model_->stepper->bodies().empty()) runs::write_fragments(folder_->fragments(), measure_pieces(*model_));
}

void SpheresRecord::check_motion(Real time) const {
  const Real speed = model_->stepper->largest_speed();
  if (model_->stepper->missed_pairs())
    throw PhysicsError(fmt::format(
        "two spheres came so fast before t = {} s, or one to a wall, that they may have met unseen within a base step of {} s\n"
        "  set contact.margin larger, or time.levels = \"uniform\"; or look at spheres that overlap at the start",
        cases::short_number(time), cases::short_number(model_->steps.step, 4)));
  if (speed < senseless_speed) {
    check_surfaces();
    return check_step(time);
  }
  const Real smallest = model_->steps.smallest(), limit = model_->steps.limit;
  throw PhysicsError(
      fmt::format("the motion of the spheres has diverged at t = {} s: the largest speed is {} m/s, above {} m/s\n"
                  "  the step of {} s is {} times the limit of {} s: set time.stability_fraction = 0.1, or look at spheres that "
                  "overlap at the start",
                  cases::short_number(time), cases::short_number(speed, 3), cases::short_number(senseless_speed, 3),
                  cases::short_number(smallest, 4), cases::short_number(smallest / limit, 3), cases::short_number(limit, 4)));
}

void SpheresRecord::check_step(Real time) const {
  const methods::spheres::StepLoad& load = model_->stepper->step_load();
  if (load.load <= warned_load_) return;
  const cases::SpheresCase& spheres = file_->as<cases::SpheresCase>();
  const Real share = model_->steps.smallest() / model_->steps.limit;
  const std::string words = fmt::format(
      "the contacts of sphere {} of \"{}\" load the step {} times as much as is stable, at t = {} s or before: the motion may "
      "gain energy\n  set time.stability_fraction = {} or less; the step of {} s is {} of the stability limit of single spheres",
      load.sphere + 1, spheres.spheres[static_cast<std::size_t>(model_->group[static_cast<std::size_t>(load.sphere)])].name,
      cases::short_number(load.load, 3), cases::short_number(time, 4), cases::short_number(0.9 * share / std::sqrt(load.load), 2),
      cases::short_number(model_->steps.smallest(), 4), cases::short_number(share, 3));
  if (spheres.time.strict) throw PhysicsError(words);
  if (warns_) fmt::print(stderr, "warning: {}\n", words);
  warned_load_ = std::numeric_limits<Real>::infinity();  // once
}

/// Whether spheres went through walls of triangles: these would push them on.
void SpheresRecord::check_surfaces() const {
  const methods::spheres::SphereStepper& stepper = *model_->stepper;
  const Real step = model_->steps.smallest();
  if (const auto& passage = stepper.passage()) {
    const auto number = static_cast<std::size_t>(passage->sphere);
    throw PhysicsError(fmt::format(
        "sphere {} of \"{}\" went through the wall \"{}\" at t = {} s, at ({}, {}, {}): its centre is beyond the surface\n"
        "  its contact is too soft for its speed, or the step of {} s too long: give stiffer contacts, or a smaller "
        "time.stability_fraction",
        number + 1, file_->as<cases::SpheresCase>().spheres[static_cast<std::size_t>(model_->group[number])].name,
        stepper.walls().walls()[static_cast<std::size_t>(passage->wall)].name, cases::short_number(passage->time, 4),
        cases::short_number(passage->centre.x(), 4), cases::short_number(passage->centre.y(), 4),
        cases::short_number(passage->centre.z(), 4), cases::short_number(step, 4)));
  }
  if (stepper.missed_way() > 0)
    throw PhysicsError(
        fmt::format("a sphere came {} m nearer to a wall in a step of {} s, so that it may have passed one of triangles unseen\n"
                    "  none may go farther in a step than the smallest sphere is wide: set a smaller time.stability_fraction",
                    cases::short_number(stepper.missed_way(), 4), cases::short_number(step, 4)));
}

std::vector<std::pair<std::string, observe::Figure>> SpheresRecord::results(std::int64_t step, Real wall_seconds) const {
  const auto spheres = static_cast<std::int64_t>(model_->group.size());
  const Real lost = energies_.dashpot_work + energies_.sliding_work + energies_.bond_drag + energies_.fracture;
  const methods::spheres::BondedBodies& bodies = model_->stepper->bodies();
  std::vector<std::pair<std::string, observe::Figure>> results = {
      {"particles", spheres},
      {"steps", step},
      {"step", model_->steps.step},
      {"predicted_limit", model_->steps.limit},
      {"particle_steps", model_->stepper->particle_steps()},
      {"contacts", model_->stepper->contacts()},
      {"clumps", model_->clumps},
      {"bonds", model_->bonds},
      {"broken_bonds", model_->stepper->broken_bonds()},
      {"searches", model_->stepper->searches()},
      {"wall_seconds", wall_seconds},
      {"energy_kinetic", energies_.translation + energies_.rotation},
      {"energy_lost", lost},
      {"energy_work", std::max({lost, peak_kinetic_, std::abs(energies_.wall_work), std::abs(energies_.water_work),
                                std::abs(energies_.applied_work)})},
      {"energy_residual", energy_residual()},
      {"step_load", model_->stepper->step_load().load},
      {"peak_speed", largest_speed_}};
  if (const methods::spheres::SphereLevels& levels = model_->stepper->levels(); !levels.is_one()) {
    results.emplace_back("levels", static_cast<std::int64_t>(levels.count()));
    results.emplace_back("smallest_step", model_->steps.smallest());
    results.emplace_back("pair_evaluations", model_->stepper->counts().evaluations);
    results.emplace_back("uniform_evaluations", model_->stepper->counts().uniform_evaluations);
  }
  for (const ShapeVolume& shape : model_->shapes) {
    results.emplace_back("shape_volume_" + shape.shape, shape.volume);
    if (shape.fill) results.emplace_back("shape_fill_" + shape.shape, *shape.fill);
  }
  if (!bodies.empty()) {
    results.emplace_back("bodies", static_cast<std::int64_t>(bodies.count()));
    results.emplace_back("broken_bodies", broken_bodies(bodies));
    results.emplace_back("fragments", count_pieces(bodies));
  }
  return results;
}

std::vector<std::pair<std::string, Real>> SpheresRecord::peak_particle_velocity() const {
  std::vector<std::pair<std::string, Real>> peaks;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks.emplace_back(file_->as<cases::SpheresCase>().gauges[i].name, peaks_[i]);
  return peaks;
}

std::uint64_t SpheresRecord::state_hash() const {
  observe::Hash hash;
  const state::Spheres& spheres = model_->stepper->spheres();
  hash.add(std::as_bytes(std::span(spheres.place)));
  hash.add(std::as_bytes(std::span(spheres.spin)));
  hash.add(std::as_bytes(std::span(spheres.kick)));
  hash.add(std::as_bytes(std::span(spheres.turn)));
  hash.add(std::as_bytes(std::span(model_->stepper->clumps().clumps)));
  hash.add(std::as_bytes(std::span(spheres.number)));
  return hash.value();
}

void SpheresRecord::columns(Archive& archive) {
  files_.columns(archive);
  archive("first_sum", first_sum_);
  archive("largest_speed", largest_speed_);
  archive("peak_kinetic", peak_kinetic_);
  archive("peaks", peaks_);
  auto surfaces = static_cast<std::int64_t>(surface_files_.size());
  archive("wall_snapshots", surfaces);
  if (archive.reading()) kept_surfaces_ = static_cast<std::size_t>(surfaces);
}

}  // namespace sazare::runs
