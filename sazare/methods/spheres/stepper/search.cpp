/// Which spheres may touch: pairs and walls are found anew in time.

#include <limits>

#include "sazare/core/large_tables.hpp"
#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

namespace {

/// What pairs are kept for, over what two spheres may come nearer in a base step of several levels at their present speeds.
constexpr Real margin_over_way = 16;
/// Pairs are found anew before a base step of several levels in which so many times this way might lead beyond this share of the
/// margin. What is left of it is for spheres that are hit within the base step.
constexpr Real way_ahead = 2, usable_share = 0.75;
/// Steps after which a search looks at the step again: contacts change more slowly, and a look costs as much as a step or two.
constexpr std::int64_t steps_between_looks = 128;

}  // namespace

/// Active levels follow from pairs, so with several levels these are found where all spheres are in phase, and early enough to
/// last for the next base step. Returns whether pairs were found.
bool SphereStepper::seek_in_time(const SphereSpeeds& speeds) {
  const bool is_one = levels_.is_one(), has_walls = !walls_.walls().empty();
  missed_pairs_ = missed_pairs_ || (!is_one && (approach_ > margin_ || (has_walls && wall_approach_ > rules_.wall_margin)));
  const Real ahead = is_one ? 0 : way_ahead * rules_.step, share = is_one ? 1 : usable_share;
  if (approach_ + ahead * (speeds.first + speeds.second) >= share * margin_) {
    find_pairs();
    return true;
  }
  const bool is_near = wall_approach_ + wall_approach_in(ahead, speeds) >= share * rules_.wall_margin;
  if (has_walls && (is_near || may_pass_unseen(speeds))) find_walls({});
  return false;
}

/// With one step for all: whether a sphere might go through a surface in the next one that no list has by then.
bool SphereStepper::may_pass_unseen(const SphereSpeeds& speeds) const {
  return levels_.is_one() && walls_.have_surfaces() &&
         wall_approach_ + wall_approach_in(rules_.step, speeds) > rules_.wall_margin + smallest_radius_;
}

/// Whether several ranks share the spheres and each knows a part of them: bonds, clumps and bonded bodies ask for all.
bool SphereStepper::knows_part() const { return ranks_ != nullptr && bonds_.empty() && clumps_.empty() && bodies_.empty(); }

void SphereStepper::find_pairs() {
  walls_.look_back(spheres_, time());  // before spheres change their places
  if (ranks_ != nullptr && !knows_part()) ranks_->share(spheres_, parallel::To::all, parallel::Topic::search);
  bonds_.collect(ranks_.get());  // before tiles change their owners
  if (ranks_ != nullptr) share_bodies();
  if (step_ >= looked_at_step_ + steps_between_looks) look_at_step();
  find_drift();
  margin_ = margin_for_step();
  const std::vector<Index> new_place =
      knows_part() ? levels_.find_among_ranks(spheres_, margin_) : levels_.find(spheres_, margin_, together());
  find_places();
  suppress_within_bodies();
  bonds_.drop_broken();
  arrange();
  for (std::size_t level = 0; level < levels_.count() && !bonds_.empty(); ++level) {
    const auto& links = bonds_.links(level);
    for (std::size_t link = 0; link < links.first.size(); ++link)
      levels_.suppress(spheres_, links.first[link], links.ends.second[link]);
  }
  wake_broken_within_pieces();
  find_walls(new_place);
  approach_ = 0;
  tile_approach_.assign(levels_.is_one() ? levels_.loads(0).tiles() : 0, 0);
  ++searches_;
  ask_for_large_pages();
}

/// What steps go through stands on as few pages as can be: a processor knows the places of few.
void SphereStepper::ask_for_large_pages() const {
  LargePages pages;
  const auto add = [&](std::size_t begin, std::size_t end) {
    pages.add(std::span(spheres_.place).subspan(begin, end - begin));
    pages.add(std::span(spheres_.spin).subspan(begin, end - begin));
    pages.add(std::span(spheres_.kick).subspan(begin, end - begin));
  };
  if (knows_part())
    for (const std::size_t tile : ranks_->owners().own()) add(tile * neighbors::tile_size, ranks_->end_of(tile));
  else
    add(0, spheres_.size());
  levels_.add_to(pages);
  pages.ask();
}

/// All that follows from pairs and from where spheres stand.
void SphereStepper::arrange() {
  if (!bonds_.empty()) bonds_.arrange(place_, {levels_.count(), levels_.by_number()});
  levels_.arrange(bonds_);
  if (ranks_ != nullptr) plan_borders();
  share_out();
  clump_at_.assign(clumps_.empty() ? 0 : spheres_.size(), -1);
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    for (const auto& member : clumps_.members_of(c))
      clump_at_[static_cast<std::size_t>(place_[static_cast<std::size_t>(member.sphere)])] = static_cast<Index>(c);
  clumps_at_active_level_.assign(levels_.count(), {});
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c) {
    if (!owns_clump(c)) continue;
    const Index member = clumps_.members_of(c).front().sphere;
    const auto place = static_cast<std::size_t>(place_[static_cast<std::size_t>(member)]);
    clumps_at_active_level_[levels_.active_level(place)].push_back(static_cast<Index>(c));
  }
}

/// The mean velocity, from which speeds are seen.
void SphereStepper::find_drift() {
  auto all = sum_own<MassFlow>([this](std::size_t i, MassFlow& part) {
    const state::SpherePlace& place = spheres_.place[i];
    part.mass += place.mass;
    part.momentum += Vector3(place.mass * place.velocity());
  });
  if (ranks_ != nullptr) all = ranks_->sum(all, parallel::Topic::search);
  const Real mass = all.mass.value();
  drift_ = all.momentum.value();
  if (mass > 0) drift_ /= mass;
}

/// For how far pairs are to be found [m].
Real SphereStepper::margin_for_step() const {
  if (levels_.is_one()) return rules_.margin;
  SphereSpeeds own, speeds;
  visit_own([&](std::size_t i) { own.take({(spheres_.place[i].velocity() - drift_).norm(), 0, 0}); });
  if (ranks_ == nullptr)
    speeds = own;
  else
    for (const SphereSpeeds& of : ranks_->from_all(own, parallel::Topic::search)) speeds.take(of);
  return std::max(rules_.margin, margin_over_way * rules_.step * (speeds.first + speeds.second));
}

/// Where the spheres stand, by number.
void SphereStepper::find_places() {
  if (clumps_.empty() && bodies_.empty() && bonds_.empty()) return;
  place_.resize(spheres_.size());
  for (std::size_t i = 0; i < place_.size(); ++i) place_[static_cast<std::size_t>(spheres_.number[i])] = static_cast<Index>(i);
}

/// Which spheres have active levels that go together.
SphereLevels::Together SphereStepper::together() {
  SphereLevels::Together together;
  if (levels_.is_one()) return together;
  find_places();
  for (const auto& bond : bonds_.bonds())
    if (bond.gone == 0)
      together.bonded.push_back({place_[static_cast<std::size_t>(bond.first)], place_[static_cast<std::size_t>(bond.second)]});
  if (!clumps_.empty()) together.body = by_place([&](Index number) { return body_[static_cast<std::size_t>(number)]; });
  return together;
}

/// Spheres of one clump never touch, nor do those of one piece of a bonded body.
void SphereStepper::suppress_within_bodies() {
  if (!bodies_.empty()) levels_.suppress_within(by_place([&](Index number) { return bodies_.piece(number); }));
  if (!clumps_.empty()) levels_.suppress_within(by_place([&](Index number) { return body_[static_cast<std::size_t>(number)]; }));
}

/// A bond that has broken where others still join its spheres leaves a contact.
void SphereStepper::wake_broken_within_pieces() {
  if (bodies_.empty()) return;
  for (const auto& bond : bonds_.bonds()) {
    if (bond.gone == 0 || bodies_.piece(bond.first) < 0 || bodies_.piece(bond.first) != bodies_.piece(bond.second)) continue;
    levels_.activate(spheres_, place_[static_cast<std::size_t>(bond.first)], place_[static_cast<std::size_t>(bond.second)], 0);
  }
}

void SphereStepper::find_walls(std::span<const Index> new_place) {
  if (walls_.walls().empty()) return;
  if (new_place.empty()) walls_.look_back(spheres_, time());
  const auto level = levels_.by_place(spheres_);
  walls_.find(spheres_, time(), rules_.wall_margin, new_place, {levels_.count(), level, ranks_.get()});
  wall_radius_ = 0;
  for (const auto& wall : walls_.walls())
    if (wall.motion.moves())
      visit_own(
          [&](std::size_t i) { wall_radius_ = std::max(wall_radius_, (spheres_.place[i].centre() - wall.motion.pivot).norm()); });
  if (ranks_ != nullptr) wall_radius_ = ranks_->largest(wall_radius_);
  agree_on_passage();
  wall_approach_ = 0;
}

}  // namespace sazare::methods::spheres
