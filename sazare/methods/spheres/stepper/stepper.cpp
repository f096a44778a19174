#include "sazare/methods/spheres/stepper/stepper.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr std::size_t serial_below_clumps = 500;
constexpr std::int64_t steps_between_cuts = 64;  // cuts follow the spheres, which move little meanwhile

Real smallest_radius(const state::Spheres& spheres) {
  Real smallest = std::numeric_limits<Real>::infinity();
  for (const auto& place : spheres.place) smallest = std::min(smallest, place.radius);
  return smallest;
}

Real largest_radius(const state::Spheres& spheres) {
  Real largest = 0;
  for (const auto& place : spheres.place) largest = std::max(largest, place.radius);
  return largest;
}

/// Whoever touches across a neck stays among those that are kept, with room to go farther apart before all are sought anew.
SphereRules covering_necks(SphereRules rules, const ContactTable& table, const state::Spheres& spheres) {
  const Real most = 2 * table.longest_neck(largest_radius(spheres));
  rules.margin = std::max(rules.margin, most);
  rules.wall_margin = std::max(rules.wall_margin, most);
  return rules;
}

/// All spheres of a clump have the finest level among them.
std::vector<std::int8_t> one_level_each(const state::Clumps& clumps, std::vector<std::int8_t> level) {
  if (level.empty()) return level;
  const auto level_of = [&](const state::ClumpMember& member) -> std::int8_t& {
    return level[static_cast<std::size_t>(member.sphere)];
  };
  for (std::size_t c = 0; c < clumps.clumps.size(); ++c) {
    std::int8_t finest = 0;
    for (const auto& member : clumps.members_of(c)) finest = std::max(finest, level_of(member));
    for (const auto& member : clumps.members_of(c)) level_of(member) = finest;
  }
  return level;
}

}  // namespace

SphereStepper::SphereStepper(state::Spheres spheres, const methods::spheres::ContactTable& table,
                             std::vector<methods::spheres::Wall> walls, const SphereRules& rules, methods::spheres::Bonds bonds,
                             state::Clumps clumps, methods::spheres::BondedBodies bodies)
    : spheres_(std::move(spheres)),
      walls_(table, std::move(walls), largest_radius(spheres_) + covering_necks(rules, table, spheres_).wall_margin),
      bonds_(std::move(bonds)),
      clumps_(std::move(clumps)),
      bodies_(std::move(bodies)),
      rules_(covering_necks(rules, table, spheres_)),
      levels_(one_level_each(clumps_, rules.level), table, rules.step),
      smallest_radius_(smallest_radius(spheres_)) {
  if (!clumps_.empty()) body_.assign(spheres_.size(), -1);
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    for (const auto& member : clumps_.members_of(c)) body_[static_cast<std::size_t>(member.sphere)] = static_cast<Index>(c);
  if (!bonds_.empty()) spheres_.turn.resize(spheres_.size());  // those that are given stay
  for (const state::SphereKick& kick : spheres_.kick)
    drives_ = drives_ || (!(kick.inverse_mass > 0) &&
                          (kick.vx != 0 || kick.vy != 0 || kick.vz != 0 || kick.wx != 0 || kick.wy != 0 || kick.wz != 0));
}

void SphereStepper::start() {
  find_pairs();
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    place_members(clumps_.clumps[c], clumps_.members_of(c), place_, spheres_);
  evaluate_now();
  for (state::Clump& clump : clumps_.clumps) methods::spheres::kick(clump, {-1 * clump.impulse_ahead, -1 * clump.turning_ahead});
  levels_.count_anew();
  visit_own([&](std::size_t i) {
    const Vector3 back = half_kick(i), turn_back = half_turning_kick(i);
    state::SphereKick& kick = spheres_.kick[i];
    kick.vx -= back.x();
    kick.vy -= back.y();
    kick.vz -= back.z();
    kick.wx -= turn_back.x();
    kick.wy -= turn_back.y();
    kick.wz -= turn_back.z();
    largest_speed_ = std::max(largest_speed_, spheres_.place[i].velocity().norm());
  });
  if (ranks_ != nullptr) largest_speed_ = ranks_->largest(largest_speed_);
  works_.begin(motion_energies().carried);
}

/// Evaluates what is due at a tick of a base step.
void SphereStepper::evaluate(std::int64_t tick) {
  walls_.move(time_of(tick));
  spend([&] { levels_.evaluate(tick, scene(tick)); });
  if (ranks_ != nullptr && !clumps_.empty()) clump_border_->bring_loads(levels_.coarsest_due(tick), water_);
  add_work(tick);
}

/// Adds up what the evaluation of a tick has given.
void SphereStepper::add_work(std::int64_t tick) {
  const std::size_t coarsest = levels_.coarsest_due(tick);
  const std::int64_t broken = levels_.add_work(tick, works_);
  if (bonds_.may_break() && (ranks_ == nullptr ? broken > 0 : ranks_->any(broken > 0))) part_broken(coarsest);
  if (walls_.have_surfaces())
    for (std::size_t level = coarsest; level < levels_.count(); ++level) walls_.note_passages(level);
  walls_.add_work_of_surface(rules_.step);
}

void SphereStepper::evaluate_now() {
  if (evaluated_) return;
  evaluate(0);
  agree_on_passage();
  hold_clumps();
  evaluated_ = true;
}

void SphereStepper::apply(std::vector<Vector3> forces) {
  if (!has_begun()) return applied_.set(std::move(forces));  // `start` evaluates them
  evaluate_now();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Index number = spheres_.number[i];
    const Vector3 more = forces[static_cast<std::size_t>(number)] - applied_.of(number);
    const Real work = levels_.add_to_load(spheres_, i, more) * more.dot(spheres_.place[i].velocity());
    works_.twice_applied_work += 2 * work;
    works_.applied_work_now += work;
  }
  applied_.set(std::move(forces));
  hold_clumps();
}

/// What the momenta of clumps lack at a base step whose forces are kept.
void SphereStepper::hold_clumps() {
  for (std::size_t active_level = 0; active_level < clumps_at_active_level_.size(); ++active_level) {
    const auto loads = levels_.acting_until_now(active_level);
    const SphereFlight flight{levels_.step(active_level), rules_.gravity, drift_};
    for (const Index clump : clumps_at_active_level_[active_level]) {
      const auto c = static_cast<std::size_t>(clump);
      works_.carried_energy += carry_water(clumps_.clumps[c], clumps_.members_of(c));
      gather(clumps_.clumps[c], clumps_.members_of(c), loads, flight, place_);
    }
  }
}

/// A clump carries along what its spheres do. Returns ContactSums::carried_energy.
Real SphereStepper::carry_water(state::Clump& clump, std::span<const state::ClumpMember> members) const {
  if (water_.empty()) return 0;
  Real added_mass = 0;
  for (const state::ClumpMember& member : members) added_mass += water_.added_mass(member.sphere);
  const Real square = methods::spheres::velocity(clump).squaredNorm();
  return 0.5 * square * (added_mass - std::exchange(clump.added_mass, added_mass));
}

/// Kicks all that are due at a tick, and moves them. Returns the speeds of all.
SphereSpeeds SphereStepper::kick(std::int64_t tick) {
  levels_.kick(tick, spheres_, {rules_.gravity, drift_, drives_}, works_.wall_work);
  for (std::size_t active_level = levels_.coarsest_due(tick); active_level < clumps_at_active_level_.size(); ++active_level)
    kick_clumps(active_level, tick);
  return levels_.speeds();
}

/// The clumps of an active level with their spheres.
void SphereStepper::kick_clumps(std::size_t active_level, std::int64_t tick) {
  const std::vector<Index>& which = clumps_at_active_level_[active_level];
  const auto loads = levels_.acting(active_level, tick);
  const SphereFlight flight{levels_.step(active_level), rules_.gravity, drift_};
  clumps_carried_.resize(which.size());
  parallel::parallel_for(which.size(), serial_below_clumps, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const auto c = static_cast<std::size_t>(which[n]);
      state::Clump& clump = clumps_.clumps[c];
      const auto members = clumps_.members_of(c);
      clumps_carried_[n] = carry_water(clump, members);
      methods::spheres::kick(clump, gather(clump, members, loads, flight, place_));
      drift(clump, flight.step);
      place_members(clump, members, place_, spheres_);
    }
  });
  for (const Real gained : clumps_carried_) works_.carried_energy += gained;
  SphereSpeeds speeds;
  for (const Index c : which) {
    const state::Clump& clump = clumps_.clumps[static_cast<std::size_t>(c)];
    const Real turning = turning_speed(clump, clumps_.members_of(static_cast<std::size_t>(c)));
    const Vector3& moves = clump.velocity;
    speeds.take({(moves - drift_).norm() + turning, 0, moves.norm() + turning});
  }
  levels_.take(active_level, speeds);
}

/// How fast all went in the last tick, and how much nearer they may have come.
void SphereStepper::measure(const SphereSpeeds& speeds) {
  const Real seconds = levels_.tick_seconds();
  largest_speed_ = speeds.first <= std::numeric_limits<Real>::max() ? std::max(largest_speed_, speeds.largest)
                                                                    : std::numeric_limits<Real>::infinity();
  approach_ += seconds * (speeds.first + speeds.second);
  const Real way = wall_approach_in(seconds, speeds);
  wall_approach_ += way;
  // A surface beyond the margin is in no list; a centre that is nearer to it than its radius has touched it first.
  if (levels_.is_one() && wall_approach_ > rules_.wall_margin + smallest_radius_ && walls_.have_surfaces())
    missed_way_ = std::max(missed_way_, way);
}

/// How much nearer spheres may have come in the last step that one tile looks at: the fast ones are elsewhere for most.
void SphereStepper::measure_tiles(std::span<const SphereSpeeds> by_tile) {
  for (std::size_t tile = 0; tile < tile_approach_.size(); ++tile) {
    SphereSpeeds speeds = by_tile[tile];
    for (const Index visited : levels_.loads(0).visited_by(tile)) speeds.take(by_tile[static_cast<std::size_t>(visited)]);
    tile_approach_[tile] += rules_.step * (speeds.first + speeds.second);
  }
}

/// How much nearer a sphere and a wall may come [m].
Real SphereStepper::wall_approach_in(Real seconds, const SphereSpeeds& speeds) const {
  return seconds * (speeds.largest + walls_.largest_speed(wall_radius_ + rules_.wall_margin));
}

void SphereStepper::advance() {
  largest_speed_ = 0;
  SphereSpeeds speeds;
  if (can_walk()) {
    speeds = walk();
    measure(speeds);
    measure_tiles(speeds_);
  } else {
    for (std::int64_t tick = 0; tick < levels_.ticks(); ++tick) {
      if (ranks_ != nullptr) {
        speeds = advance_own(tick);
        continue;
      }
      if (tick > 0 || !evaluated_) evaluate(tick);
      speeds = kick(tick);
      measure(speeds);
      for (Real& approach : tile_approach_) approach += levels_.tick_seconds() * (speeds.first + speeds.second);
    }
  }
  evaluated_ = false;
  ++step_;
  if (!seek_in_time(speeds) && step_ % steps_between_cuts == 0) balance();
}

void SphereStepper::columns(Archive& archive) {
  archive("steps", step_);
  int evaluated = evaluated_ ? 1 : 0;
  archive("evaluated", evaluated);
  evaluated_ = evaluated != 0;
  archive("searches", searches_);
  archive.folder("spheres", [&] { spheres_.columns(archive); });
  levels_.columns(archive);
  archive.folder("clumps", [&] { clumps_.columns(archive); });
  if (!archive.reading() && ranks_ == nullptr) bonds_.collect(nullptr);
  archive.folder("bonds", [&] { bonds_.columns(archive); });
  if (archive.reading()) {
    if (ranks_ != nullptr) levels_.keep_own();
    find_places();
    bodies_.find_pieces(bonds_);
    arrange();
    ask_for_large_pages();
  }
  if (evaluated_) levels_.load_columns(archive);
  water_.columns(archive);
  applied_.columns(archive);
  archive.folder("walls", [&] { walls_.columns(archive); });
  if (archive.reading()) find_walls({});
  for (int axis = 0; axis < 3; ++axis) archive("drift" + std::to_string(axis), drift_[axis]);
  archive("approach", approach_);
  archive("tile_approach", tile_approach_);
  archive("margin", margin_);
  archive("largest_speed", largest_speed_);
  archive.folder("works", [&] { (collected_works_ ? *collected_works_ : works_).columns(archive); });
  if (ranks_ != nullptr && archive.reading() && !ranks_->ranks().is_first()) works_ = {};  // the first one has what was
  collected_works_.reset();
  levels_.forget_collected();
  archive("step_load", step_load_.load);
  archive("step_load_sphere", step_load_.sphere);
  archive("looked_at_step", looked_at_step_);
}

}  // namespace sazare::methods::spheres
