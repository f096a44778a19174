/// A base step of spheres that have time levels, tick by tick.

#include <limits>

#include "sazare/engine/sphere_stepper.hpp"

namespace sazare::engine {

namespace {

/// What pairs are kept for, over what two spheres may come nearer in a base step at their present speeds.
constexpr Real margin_over_way = 16;
/// Pairs are found anew before a base step in which so many times this way might lead beyond this share of the margin. What is
/// left of it is for spheres that are hit within the base step.
constexpr Real way_ahead = 2, usable_share = 0.75;

}  // namespace

/// Paces follow from pairs, so these are found where all spheres are in phase, and early enough to last for a base step.
void SphereStepper::find_level_pairs() {
  find_drift();
  SphereSpeeds speeds;
  for (const state::SpherePlace& place : spheres_.place) speeds.take({(place.velocity() - drift_).norm(), 0, 0});
  margin_ = std::max(rules_.margin, margin_over_way * rules_.step * (speeds.first + speeds.second));
  find_walls(levels_.find(spheres_, margin_));
  approach_ = 0;
  ++searches_;
}

void SphereStepper::evaluate_levels(std::int64_t tick) {
  walls_.move(time() + static_cast<Real>(tick) * levels_.tick_seconds());
  levels_.evaluate(tick, spheres_, walls_, approach_);
  levels_.book(tick, sums_);
  for (std::size_t level = static_cast<std::size_t>(levels_.coarsest_due(tick)); level < levels_.count(); ++level)
    for (const auto& load : walls_.loads(level)) wall_work_ += load.work;
}

void SphereStepper::advance_levels() {
  settle();
  largest_speed_ = 0;
  SphereSpeeds speeds;
  for (std::int64_t tick = 0; tick < levels_.ticks(); ++tick) {
    if (tick > 0) evaluate_levels(tick);
    speeds = levels_.kick(tick, spheres_, {rules_.gravity, drift_, drives_});
    wall_work_ += levels_.driven_work();
    largest_speed_ = speeds.first <= std::numeric_limits<Real>::max() ? std::max(largest_speed_, speeds.largest)
                                                                      : std::numeric_limits<Real>::infinity();
    approach_ += levels_.tick_seconds() * (speeds.first + speeds.second);
    wall_approach_ += levels_.tick_seconds() * (speeds.largest + walls_.largest_speed(wall_radius_ + rules_.wall_margin));
  }
  settled_ = false;
  ++step_;
  missed_pairs_ = missed_pairs_ || approach_ > margin_ || (!walls_.walls().empty() && wall_approach_ > rules_.wall_margin);
  seek_in_time(speeds);
}

/// Finds anew what the next base step may need.
void SphereStepper::seek_in_time(const SphereSpeeds& speeds) {
  const Real way = way_ahead * rules_.step * (speeds.first + speeds.second),
             wall_way = way_ahead * rules_.step * (speeds.largest + walls_.largest_speed(wall_radius_ + rules_.wall_margin));
  if (approach_ + way > usable_share * margin_)
    find_pairs();
  else if (!walls_.walls().empty() && wall_approach_ + wall_way > usable_share * rules_.wall_margin)
    find_walls({});
}

}  // namespace sazare::engine
