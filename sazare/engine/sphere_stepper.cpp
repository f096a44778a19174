#include "sazare/engine/sphere_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::engine {

namespace {

constexpr std::size_t serial_below = 2;  // blocks

Real largest_radius(const state::Spheres& spheres) {
  Real largest = 0;
  for (const auto& place : spheres.place) largest = std::max(largest, place.radius);
  return largest;
}

}  // namespace

SphereStepper::SphereStepper(state::Spheres spheres, methods::spheres::ContactTable table,
                             std::vector<methods::spheres::Wall> walls, const SphereRules& rules)
    : spheres_(std::move(spheres)),
      pairs_(table),
      walls_(std::move(table), std::move(walls), largest_radius(spheres_) + rules.wall_margin),
      rules_(rules) {}

Vector3 SphereStepper::acceleration(std::size_t sphere) const {
  const state::SphereLoad& load = loads_.of(sphere);
  const Real inverse = spheres_.kick[sphere].inverse_mass;
  return inverse * Vector3(load.fx, load.fy, load.fz) + (inverse > 0 ? rules_.gravity : Vector3(Vector3::Zero()));
}

Vector3 SphereStepper::angular_acceleration(std::size_t sphere) const {
  const state::SphereLoad& load = loads_.of(sphere);
  return spheres_.kick[sphere].inverse_inertia * Vector3(load.mx, load.my, load.mz);
}

Vector3 SphereStepper::velocity(std::size_t sphere) const {
  const state::SphereKick& kick = spheres_.kick[sphere];
  return Vector3(kick.vx, kick.vy, kick.vz) + 0.5 * rules_.step * acceleration(sphere);
}

Vector3 SphereStepper::spin(std::size_t sphere) const {
  const state::SphereKick& kick = spheres_.kick[sphere];
  return Vector3(kick.wx, kick.wy, kick.wz) + 0.5 * rules_.step * angular_acceleration(sphere);
}

void SphereStepper::start() {
  find_pairs();
  settle();
  sums_.dashpot_work = sums_.sliding_work = wall_work_ = 0;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Vector3 back = 0.5 * rules_.step * acceleration(i), turn_back = 0.5 * rules_.step * angular_acceleration(i);
    state::SphereKick& kick = spheres_.kick[i];
    kick.vx -= back.x();
    kick.vy -= back.y();
    kick.vz -= back.z();
    kick.wx -= turn_back.x();
    kick.wy -= turn_back.y();
    kick.wz -= turn_back.z();
    largest_speed_ = std::max(largest_speed_, spheres_.place[i].velocity().norm());
  }
}

void SphereStepper::find_pairs() {
  const std::vector<Index> places_before = pairs_.find(spheres_, rules_.margin);
  loads_.arrange(pairs_.pairs());
  find_walls(places_before);
  Real mass = 0;
  drift_ = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    drift_ += spheres_.place[i].mass * spheres_.place[i].velocity();
    mass += spheres_.place[i].mass;
  }
  if (mass > 0) drift_ /= mass;
  approach_ = 0;
  ++searches_;
}

void SphereStepper::find_walls(std::span<const Index> places_before) {
  if (walls_.walls().empty()) return;
  walls_.find(spheres_, time(), rules_.wall_margin, places_before);
  wall_radius_ = 0;
  for (const auto& wall : walls_.walls())
    if (wall.motion.moves())
      for (const auto& place : spheres_.place) wall_radius_ = std::max(wall_radius_, (place.centre() - wall.motion.pivot).norm());
  wall_approach_ = 0;
}

SphereStepper::Speeds SphereStepper::kick_and_drift(std::size_t block, const state::SphereLoad* loads) {
  const Real h = rules_.step, half = 0.5 * h;
  const Vector3 gravity = rules_.gravity;
  Real first = 0, second = 0, largest = 0;
  const std::size_t begin = loads_.begin_of(block);
  for (std::size_t i = begin; i < loads_.end_of(block); ++i) {
    state::SphereKick& kick = spheres_.kick[i];
    state::SpherePlace& place = spheres_.place[i];
    state::SphereSpin& spin = spheres_.spin[i];
    const state::SphereLoad& load = loads[i - begin];
    const Real inverse = kick.inverse_mass, falls = inverse > 0 ? 1 : 0;
    const Real ax = inverse * load.fx + falls * gravity.x(), ay = inverse * load.fy + falls * gravity.y(),
               az = inverse * load.fz + falls * gravity.z();
    const Real bx = kick.inverse_inertia * load.mx, by = kick.inverse_inertia * load.my, bz = kick.inverse_inertia * load.mz;
    kick.vx += h * ax;
    kick.vy += h * ay;
    kick.vz += h * az;
    kick.wx += h * bx;
    kick.wy += h * by;
    kick.wz += h * bz;
    place.x += h * kick.vx;
    place.y += h * kick.vy;
    place.z += h * kick.vz;
    place.vx = kick.vx + half * ax;
    place.vy = kick.vy + half * ay;
    place.vz = kick.vz + half * az;
    spin.x = kick.wx + half * bx;
    spin.y = kick.wy + half * by;
    spin.z = kick.wz + half * bz;
    const Real ux = kick.vx - drift_.x(), uy = kick.vy - drift_.y(), uz = kick.vz - drift_.z();
    const Real square = ux * ux + uy * uy + uz * uz;
    second = std::max(second, std::min(first, square));
    first = square <= first ? first : square;  // what is no number stays
    largest = std::max(largest, kick.vx * kick.vx + kick.vy * kick.vy + kick.vz * kick.vz);
  }
  return {std::sqrt(first), std::sqrt(second), std::sqrt(largest)};
}

void SphereStepper::measure() {
  Speeds all;
  for (const Speeds& one : speeds_) {
    all.second = std::max({all.second, std::min(all.first, one.first), one.second});
    all.first = one.first <= all.first ? all.first : one.first;
    all.largest = std::max(all.largest, one.largest);
  }
  largest_speed_ = all.first <= std::numeric_limits<Real>::max() ? all.largest : std::numeric_limits<Real>::infinity();
  approach_ += rules_.step * (all.first + all.second);
  wall_approach_ += rules_.step * (all.largest + walls_.largest_speed(wall_radius_ + rules_.wall_margin));
}

methods::spheres::ContactSums SphereStepper::evaluate(std::size_t block, state::SphereLoad* loads) {
  loads_.clear(block, loads);
  auto sums = pairs_.evaluate(spheres_, {block, approach_, rules_.step, loads_, loads});
  if (!walls_.walls().empty()) sums += walls_.evaluate(spheres_, block, rules_.step, loads);
  return sums;
}

/// Forces and kicks of some blocks, each while it is in the cache. A block that others look at, before this range, waits for them
/// all.
void SphereStepper::walk(std::size_t begin, std::size_t end) {
  std::vector<state::SphereLoad> passing(neighbors::block_size);
  for (std::size_t block = begin; block < end; ++block) {
    waits_[block] = loads_.first_visitor(block) < begin ? 1 : 0;
    state::SphereLoad* const loads = waits_[block] != 0 ? loads_.kept(block) : passing.data();
    block_sums_[block] = evaluate(block, loads);
    if (waits_[block] != 0) continue;
    loads_.gather(block, loads);
    speeds_[block] = kick_and_drift(block, loads);
  }
}

void SphereStepper::kick_those_that_waited() {
  std::vector<std::size_t> late;
  for (std::size_t block = 0; block < waits_.size(); ++block)
    if (waits_[block] != 0) late.push_back(block);
  parallel::parallel_for(late.size(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      loads_.gather(late[n], loads_.kept(late[n]));
      speeds_[late[n]] = kick_and_drift(late[n], loads_.kept(late[n]));
    }
  });
}

void SphereStepper::kick_kept() {
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) speeds_[block] = kick_and_drift(block, loads_.kept(block));
  });
}

/// Adds up the sums of the blocks.
void SphereStepper::book() {
  methods::spheres::ContactSums now;
  for (const auto& one : block_sums_) now += one;
  now.dashpot_work += sums_.dashpot_work;
  now.sliding_work += sums_.sliding_work;
  sums_ = now;
  for (const auto& load : walls_.loads()) wall_work_ += load.work;
}

void SphereStepper::settle() {
  if (settled_) return;
  walls_.move(time());
  block_sums_.resize(loads_.blocks());
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) block_sums_[block] = evaluate(block, loads_.kept(block));
  });
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) loads_.gather(block, loads_.kept(block));
  });
  book();
  settled_ = true;
}

void SphereStepper::advance() {
  block_sums_.resize(loads_.blocks());
  speeds_.resize(loads_.blocks());
  if (settled_) {
    kick_kept();
  } else {
    walls_.move(time());
    waits_.assign(loads_.blocks(), 0);
    parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) { walk(begin, end); });
    kick_those_that_waited();
    book();
  }
  settled_ = false;
  ++step_;
  measure();
  if (approach_ >= rules_.margin)
    find_pairs();
  else if (!walls_.walls().empty() && wall_approach_ >= rules_.wall_margin)
    find_walls({});
}

SphereEnergies SphereStepper::energies() const {
  SphereEnergies energies;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (!(spheres_.kick[i].inverse_mass > 0)) continue;
    energies.translation += 0.5 * spheres_.place[i].mass * velocity(i).squaredNorm();
    energies.rotation += 0.5 * spheres_.inertia(i) * spin(i).squaredNorm();
    energies.potential -= spheres_.place[i].mass * rules_.gravity.dot(spheres_.place[i].centre());
  }
  energies.elastic = sums_.elastic;
  energies.sliding = sums_.sliding;
  energies.dashpot_work = sums_.dashpot_work;
  energies.sliding_work = sums_.sliding_work - sums_.sliding;
  energies.wall_work = wall_work_;
  return energies;
}

Vector3 SphereStepper::momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i) total += spheres_.place[i].mass * velocity(i);
  return total;
}

Vector3 SphereStepper::angular_momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    total += spheres_.place[i].mass * spheres_.place[i].centre().cross(velocity(i)) + spheres_.inertia(i) * spin(i);
  return total;
}

void SphereStepper::columns(Archive& archive) {
  archive("steps", step_);
  int settled = settled_ ? 1 : 0;
  archive("settled", settled);
  settled_ = settled != 0;
  archive("searches", searches_);
  archive.folder("spheres", [&] { spheres_.columns(archive); });
  archive.folder("pairs", [&] { pairs_.columns(archive); });
  if (archive.reading()) loads_.arrange(pairs_.pairs());
  loads_.columns(archive);
  archive.folder("walls", [&] { walls_.columns(archive); });
  if (archive.reading()) find_walls({});
  for (int axis = 0; axis < 3; ++axis) archive("drift" + std::to_string(axis), drift_[axis]);
  archive("approach", approach_);
  archive("largest_speed", largest_speed_);
  archive("contacts", sums_.contacts);
  archive("elastic", sums_.elastic);
  archive("sliding", sums_.sliding);
  archive("dashpot_work", sums_.dashpot_work);
  archive("sliding_work", sums_.sliding_work);
  archive("wall_work", wall_work_);
}

}  // namespace sazare::engine
