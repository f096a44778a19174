/// The parts of a stepper that several ranks need.

#include <algorithm>
#include <utility>

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

namespace {

/// What a rank has seen of spheres that went through surfaces.
struct PassageSeen {
  std::int64_t tile = -1;  ///< below 0 where none did
  Passage passage;
};

/// What all ranks have added up.
struct RowPart {
  WorkSums works;
  MotionEnergies motion;
};

}  // namespace

void SphereStepper::share(const parallel::Ranks& ranks, Division division) {
  ranks_ = std::make_shared<RankTiles>(ranks, division, spheres_.size());
  levels_.share(*ranks_);
  clump_border_ = std::make_shared<ClumpBorder>(ranks);
}

/// What travels in steps from now on.
void SphereStepper::plan_borders() {
  levels_.plan_border(!spheres_.turn.empty());
  if (clumps_.empty()) return;
  ClumpBorder::Scene scene{place_, {}, {}};
  for (std::size_t level = 0; level < levels_.count(); ++level) {
    scene.loads.push_back(&levels_.loads(level));
    scene.spheres.push_back(levels_.pairs(level).pairs().first.size() - 1);
  }
  clump_border_->plan(ranks_->owners(), clumps_, std::move(scene));
}

parallel::Sent SphereStepper::expected_to_send() const {
  parallel::Sent all = ranks_->border().expected();
  all.bytes += clump_border_->expected().bytes;
  all.messages += clump_border_->expected().messages;
  return all;
}

/// The rank that moves a sphere, or the clump of which it is.
int SphereStepper::owner_of_body(std::size_t sphere) const {
  const Index clump = clump_at_.empty() ? -1 : clump_at_[sphere];
  return clump >= 0 ? clump_border_->owner(static_cast<std::size_t>(clump))
                    : ranks_->owners().owner_of_sphere(static_cast<Index>(sphere));
}

/// A tick of this rank's spheres. Returns the speeds of all.
SphereSpeeds SphereStepper::advance_own(std::int64_t tick) {
  if (tick > 0 || !evaluated_) evaluate(tick);
  SphereSpeeds own;
  spend([&] { own = kick(tick); });
  if (!clumps_.empty()) clump_border_->show(clumps_, spheres_, levels_.coarsest_due(tick));
  std::vector<SphereSpeeds> by_tile(levels_.is_one() ? levels_.loads(0).tiles() : 0);
  levels_.take_speeds(by_tile);
  ranks_->border().show_motion(spheres_, by_tile, levels_.coarsest_due(tick));
  SphereSpeeds all;
  for (const SphereSpeeds& of : ranks_->from_all(own, parallel::Topic::changes)) all.take(of);
  agree_on_passage();
  measure(all);
  if (clumps_.empty())
    measure_tiles(by_tile);
  else  // which tile holds which clump's speed is not known
    for (Real& approach : tile_approach_) approach += levels_.tick_seconds() * (all.first + all.second);
  return all;
}

/// All ranks take the earliest passage, and of these the first one in the order of tiles.
void SphereStepper::agree_on_passage() {
  if (ranks_ == nullptr || !walls_.have_surfaces()) return;
  const auto order = [](const PassageSeen& seen) { return std::pair(seen.passage.time, seen.tile); };
  PassageSeen own, first;
  if (walls_.passage()) own = {walls_.passage_tile(), *walls_.passage()};
  for (const PassageSeen& seen : ranks_->from_all(own, parallel::Topic::changes))
    if (seen.tile >= 0 && (first.tile < 0 || order(seen) < order(first))) first = seen;
  if (first.tile >= 0) walls_.agree_on(first.passage, first.tile);
}

void SphereStepper::survey(bool with_motion) {
  if (ranks_ == nullptr) return;
  evaluate_now();
  look_at_step();
  const RowPart own{works_, motion_energies()};
  surveyed_counts_ = levels_.all_counts();
  surveyed_ = {};
  for (const RowPart& part : ranks_->to_first(own, parallel::Topic::rows)) {
    surveyed_.works += part.works;
    surveyed_.motion += part.motion;
  }
  walls_.survey(*ranks_);
  if (with_motion) collect_motion(parallel::Topic::rows);
}

/// Motion and kept loads of all spheres, to the first rank.
void SphereStepper::collect_motion(parallel::Topic topic) {
  ranks_->share(spheres_, parallel::To::first, topic);
  levels_.collect_loads();
  clump_border_->share(clumps_, parallel::To::first, topic);
  share_added_masses(topic);
}

/// Clumps, and what spheres carry along of the water, to all ranks.
void SphereStepper::share_bodies() {
  clump_border_->share(clumps_, parallel::To::all, parallel::Topic::search);
  share_added_masses(parallel::Topic::search);
}

void SphereStepper::share_added_masses(parallel::Topic topic) {
  if (water_.empty()) return;
  struct AddedMass {
    Index number = 0;
    Real mass = 0;
  };
  std::vector<AddedMass> own;
  visit_own([&](std::size_t i) { own.push_back({spheres_.number[i], water_.added_mass(spheres_.number[i])}); });
  for (const AddedMass& of : ranks_->join(own, topic)) water_.set_added_mass(of.number, of.mass);
}

void SphereStepper::collect() {
  if (ranks_ == nullptr) return;
  collect_motion(parallel::Topic::state);
  levels_.collect();
  surveyed_counts_ = levels_.all_counts();
  levels_.take_counts(surveyed_counts_);
  walls_.collect(*ranks_);
  bonds_.collect(ranks_.get());
  auto approach = ranks_->collect<Real>(tile_approach_.size(), [&](std::size_t tile) { return tile_approach_[tile]; });
  if (ranks_->ranks().is_first()) tile_approach_ = std::move(approach);
  const auto works = ranks_->to_first(works_, parallel::Topic::state);
  collected_works_ = WorkSums{};
  for (const WorkSums& part : works) *collected_works_ += part;
  surveyed_.works = *collected_works_;
}

}  // namespace sazare::methods::spheres
