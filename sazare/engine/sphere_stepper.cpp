#include "sazare/engine/sphere_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/core/large_tables.hpp"
#include "sazare/engine/clump_motion.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::engine {

namespace {

constexpr std::size_t serial_below = 2;  // blocks
constexpr std::size_t serial_below_clumps = 500;
constexpr std::int64_t steps_between_cuts = 64;  // cuts follow the spheres, which move little meanwhile

Real largest_radius(const state::Spheres& spheres) {
  Real largest = 0;
  for (const auto& place : spheres.place) largest = std::max(largest, place.radius);
  return largest;
}

}  // namespace

SphereStepper::SphereStepper(state::Spheres spheres, methods::spheres::ContactTable table,
                             std::vector<methods::spheres::Wall> walls, const SphereRules& rules, methods::spheres::Bonds bonds,
                             state::Clumps clumps, methods::spheres::BondedBodies bodies)
    : spheres_(std::move(spheres)),
      pairs_(table),
      walls_(std::move(table), std::move(walls), largest_radius(spheres_) + rules.wall_margin),
      bonds_(std::move(bonds)),
      clumps_(std::move(clumps)),
      bodies_(std::move(bodies)),
      rules_(rules) {
  put_on_large_pages(spheres_.place);
  put_on_large_pages(spheres_.spin);
  put_on_large_pages(spheres_.kick);
  if (std::ranges::any_of(rules_.level, [](std::int8_t level) { return level > 0; }))
    levels_ = {std::move(rules_.level), pairs_.table(), rules_.step};
  if (!clumps_.empty()) body_.assign(spheres_.size(), -1);
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    for (std::size_t m = clumps_.begin_of(c); m < clumps_.end_of(c); ++m)
      body_[static_cast<std::size_t>(clumps_.members[m].sphere)] = static_cast<Index>(c);
  if (!bonds_.empty()) spheres_.turn.resize(spheres_.size());  // those that are given stay
  for (const state::SphereKick& kick : spheres_.kick)
    drives_ = drives_ || (!(kick.inverse_mass > 0) &&
                          (kick.vx != 0 || kick.vy != 0 || kick.vz != 0 || kick.wx != 0 || kick.wy != 0 || kick.wz != 0));
}

void SphereStepper::start() {
  find_pairs();
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    place_members(clumps_, c, Vector3::Zero(), rules_.step, place_, spheres_);
  settle();
  for (state::Clump& clump : clumps_.clumps) kick(clump, rules_.gravity, -0.5 * rules_.step);
  sums_.dashpot_work = sums_.bond_drag = wall_work_ = 0;
  sums_.sliding_work = sums_.sliding;  // what sliders hold at the beginning is not lost
  levels_.count_anew();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Vector3 back = half_kick(i), turn_back = half_turning_kick(i);
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
  if (!levels_.empty()) return find_level_pairs();
  loads_ = {};
  const std::vector<Index> places_before = pairs_.find(spheres_, rules_.margin);
  rest_bodies();
  arrange_bonds();
  find_walls(places_before);
  find_drift();
  approach_ = 0;
  ++searches_;
}

/// Where the spheres stand, by number.
std::vector<Index> SphereStepper::places() const {
  std::vector<Index> place(spheres_.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[static_cast<std::size_t>(spheres_.number[i])] = static_cast<Index>(i);
  return place;
}

/// Spheres of one clump never touch, nor do those of one piece of a bonded body.
void SphereStepper::rest_bodies() {
  if (!clumps_.empty() || !bodies_.empty()) place_ = places();
  if (!bodies_.empty()) rest_pieces();
  if (clumps_.empty()) return;
  std::vector<Index> body(spheres_.size());
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = body_[static_cast<std::size_t>(spheres_.number[i])];
  pairs_.rest_within(body);
}

void SphereStepper::rest_pieces() {
  std::vector<Index> piece(spheres_.size());
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = bodies_.piece(spheres_.number[i]);
  pairs_.rest_within(piece);
}

/// Where bonds stand after the spheres have been sorted; bonded spheres have no contact.
void SphereStepper::arrange_bonds() {
  if (!bonds_.empty()) {
    bonds_.drop_broken();
    bonds_.arrange(places());
    for (std::size_t link = 0; link < bonds_.first().size(); ++link)
      pairs_.rest(bonds_.first()[link], bonds_.links().second[link]);
  }
  loads_.arrange(pairs_.pairs(), bonds_.links());
  share_out();
  pairs_.write_to(loads_);
  wake_broken_within_pieces();
}

void SphereStepper::find_walls(std::span<const Index> places_before) {
  if (walls_.walls().empty()) return;
  const auto level = levels_.by_place(spheres_);
  walls_.find(spheres_, time(), rules_.wall_margin, places_before, {levels_.count(), level});
  wall_radius_ = 0;
  for (const auto& wall : walls_.walls())
    if (wall.motion.moves())
      for (const auto& place : spheres_.place) wall_radius_ = std::max(wall_radius_, (place.centre() - wall.motion.pivot).norm());
  wall_approach_ = 0;
}

/// A bond that has broken where others still join its spheres leaves a contact.
void SphereStepper::wake_broken_within_pieces() {
  if (bodies_.empty()) return;
  for (const auto& bond : bonds_.bonds()) {
    if (bond.gone == 0 || bodies_.piece(bond.first) < 0 || bodies_.piece(bond.first) != bodies_.piece(bond.second)) continue;
    pairs_.wake(place_[static_cast<std::size_t>(bond.first)], place_[static_cast<std::size_t>(bond.second)], 0, loads_);
  }
}

/// Moves the spheres at some places of a block.
SphereSpeeds SphereStepper::move(std::size_t block, std::span<const methods::spheres::PlaceRange> places,
                                 const state::SphereLoad* loads) {
  SphereSpeeds speeds;
  for (const auto& range : places) {
    const std::size_t begin = loads_.begin_of(block) + range.begin, end = loads_.begin_of(block) + range.end;
    speeds.take(kick_and_drift(spheres_, begin, end, loads + range.begin, {rules_.step, rules_.gravity, drift_}));
    if (!spheres_.turn.empty()) turn(spheres_, begin, end, rules_.step);
    if (drives_) book_driven(begin, end, loads + range.begin);
  }
  return speeds;
}

/// The same sums, however blocks are cut.
void SphereStepper::book_driven(std::size_t begin, std::size_t end, const state::SphereLoad* loads) {
  constexpr std::size_t together = methods::spheres::LoadTable::together;
  for (std::size_t first = begin; first < end; first += together)
    driven_work_[first / together] =
        work_of_driven(spheres_, first, std::min(first + together, end), loads + (first - begin), rules_.step);
}

void SphereStepper::measure() {
  SphereSpeeds all;
  for (const SphereSpeeds& one : speeds_) all.take(one);
  for (const Real work : driven_work_) wall_work_ += work;
  largest_speed_ = all.first <= std::numeric_limits<Real>::max() ? all.largest : std::numeric_limits<Real>::infinity();
  approach_ += rules_.step * (all.first + all.second);
  wall_approach_ += rules_.step * (all.largest + walls_.largest_speed(wall_radius_ + rules_.wall_margin));
}

/// What a block's contacts and its kick will need.
ComingLines SphereStepper::coming(std::size_t block) const {
  const std::size_t begin = loads_.begin_of(block), count = loads_.end_of(block) - begin;
  ComingLines coming = pairs_.coming(spheres_, loads_, block);
  if (!reads_rows_ahead()) coming.add(std::span(spheres_.kick).subspan(begin, count));
  return coming;
}

/// The forces of a block; the next one, before `end`, comes to the cache meanwhile.
methods::spheres::ContactSums SphereStepper::evaluate(std::size_t block, std::size_t end, state::SphereLoad* loads) {
  loads_.clear(block, loads);
  const ComingLines next = block + 1 < end ? coming(block + 1) : ComingLines{};
  auto sums = pairs_.evaluate(spheres_, {block, approach_, rules_.step, loads_, loads, next});
  if (!walls_.walls().empty()) sums += walls_.evaluate(spheres_, {block, rules_.step, loads});
  if (!bonds_.empty()) sums += bonds_.evaluate(spheres_, {block, rules_.step, pairs_.table(), loads_, loads});
  return sums;
}

void SphereStepper::gather_clumps() {
  parallel::parallel_for(clumps_.clumps.size(), serial_below_clumps, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) gather_loads(clumps_, c, loads_, place_);
  });
}

/// After all others have moved: clumps with their spheres, and how fast these were.
void SphereStepper::move_clumps() {
  parallel::parallel_for(clumps_.clumps.size(), serial_below_clumps, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      kick(clumps_.clumps[c], rules_.gravity, rules_.step);
      drift(clumps_.clumps[c], rules_.step);
      place_members(clumps_, c, rules_.gravity, rules_.step, place_, spheres_);
    }
  });
  SphereSpeeds speeds;
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c) {
    const Real turning = turning_speed(clumps_, c);
    speeds.take(
        {(vector(clumps_.clumps[c].velocity) - drift_).norm() + turning, 0, vector(clumps_.clumps[c].velocity).norm() + turning});
  }
  speeds_.push_back(speeds);
}

void SphereStepper::kick_kept() {
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const methods::spheres::PlaceRange all{0, loads_.end_of(block) - loads_.begin_of(block)};
      speeds_[block] = move(block, {&all, 1}, loads_.kept(block));
    }
  });
}

/// Adds up the sums of the blocks.
void SphereStepper::book() {
  methods::spheres::ContactSums now;
  for (const auto& one : block_sums_) now += one;
  now.dashpot_work += sums_.dashpot_work;
  now.sliding_work += sums_.sliding_work;
  now.bond_drag += sums_.bond_drag;
  now.fracture += sums_.fracture;
  const std::int64_t broken_before = sums_.broken;
  sums_ = now;
  sums_.broken += broken_before;
  if (now.broken > 0) part_broken();
  for (const auto& load : walls_.loads()) wall_work_ += load.work;
  walls_.book_surface(rules_.step);
}

/// Spheres whose bond has broken may touch from the next step on; those of one piece when it has parted.
void SphereStepper::part_broken() {
  std::vector<Index> torn;
  for (std::size_t block = 0; block < loads_.blocks(); ++block)
    for (const auto& [link, allowed_overlap] : bonds_.broken(block)) {
      bonds_.note_broken(link);
      const Index first = bonds_.first()[link], second = bonds_.links().second[link];
      const Index body = bodies_.empty() ? -1 : bodies_.of(spheres_.number[static_cast<std::size_t>(first)]);
      if (body >= 0 && body == bodies_.of(spheres_.number[static_cast<std::size_t>(second)])) torn.push_back(body);
      pairs_.wake(first, second, allowed_overlap, loads_);
    }
  std::ranges::sort(torn);
  torn.erase(std::unique(torn.begin(), torn.end()), torn.end());
  for (const Index body : torn) part_pieces(body);
}

/// Pairs that two pieces part from now on may touch: they push beyond the overlap they have.
void SphereStepper::part_pieces(Index body) {
  const auto range = bodies_.spheres(body);
  std::vector<Index> before;
  for (Index sphere = range.begin; sphere < range.end; ++sphere) before.push_back(bodies_.piece(sphere));
  const auto was_in = [&](Index sphere) { return before[static_cast<std::size_t>(sphere - range.begin)]; };
  bodies_.find_pieces(body, bonds_);
  const auto& pairs = pairs_.pairs();
  for (Index sphere = range.begin; sphere < range.end; ++sphere) {
    const auto i = static_cast<std::size_t>(place_[static_cast<std::size_t>(sphere)]);
    for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) {
      const auto j = static_cast<std::size_t>(pairs.other[p]);
      const Index other = spheres_.number[j];
      if (bodies_.of(other) != body || was_in(sphere) != was_in(other) || bodies_.piece(sphere) == bodies_.piece(other)) continue;
      const state::SpherePlace &one = spheres_.place[i], &next = spheres_.place[j];
      const Real overlap = one.radius + next.radius - spheres_.box.nearest(next.centre() - one.centre()).norm();
      pairs_.wake(static_cast<Index>(i), static_cast<Index>(j), overlap, loads_);
    }
  }
}

void SphereStepper::settle() {
  if (settled_) return;
  if (!levels_.empty()) {
    evaluate_levels(0);
    settled_ = true;
    return;
  }
  walls_.move(time());
  block_sums_.resize(loads_.blocks());
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) block_sums_[block] = evaluate(block, end, loads_.kept(block));
  });
  parallel::parallel_for(loads_.blocks(), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) loads_.gather(block, loads_.kept(block));
  });
  gather_clumps();
  book();
  settled_ = true;
}

void SphereStepper::advance() {
  if (!levels_.empty()) return advance_levels();
  block_sums_.resize(loads_.blocks());
  speeds_.resize(loads_.blocks());
  if (drives_) driven_work_.resize(spheres_.size() / methods::spheres::LoadTable::together + 1);
  if (!clumps_.empty()) settle();
  if (settled_) {
    kick_kept();
    if (!clumps_.empty()) move_clumps();
  } else {
    walls_.move(time());
    walk();
    book();
  }
  settled_ = false;
  ++step_;
  measure();
  if (approach_ >= rules_.margin)
    find_pairs();
  else if (!walls_.walls().empty() && wall_approach_ >= rules_.wall_margin)
    find_walls({});
  else if (step_ % steps_between_cuts == 0)
    balance();
}

void SphereStepper::columns(Archive& archive) {
  archive("steps", step_);
  int settled = settled_ ? 1 : 0;
  archive("settled", settled);
  settled_ = settled != 0;
  archive("searches", searches_);
  archive.folder("spheres", [&] { spheres_.columns(archive); });
  archive.folder("pairs", [&] { pairs_.columns(archive); });
  archive.folder("clumps", [&] { clumps_.columns(archive); });
  if (archive.reading() && (!clumps_.empty() || !bodies_.empty())) place_ = places();
  archive.folder("bonds", [&] { bonds_.columns(archive); });
  if (archive.reading()) {
    bodies_.find_pieces(bonds_);
    if (!bonds_.empty()) bonds_.arrange(places());
    if (levels_.empty()) {
      loads_.arrange(pairs_.pairs(), bonds_.links());
      share_out();
    }
  }
  if (settled_ && levels_.empty()) loads_.columns(archive);
  levels_.columns(archive, settled_);
  archive.folder("walls", [&] { walls_.columns(archive); });
  if (archive.reading()) find_walls({});
  for (int axis = 0; axis < 3; ++axis) archive("drift" + std::to_string(axis), drift_[axis]);
  archive("approach", approach_);
  if (!levels_.empty()) archive("margin", margin_);
  archive("largest_speed", largest_speed_);
  archive("contacts", sums_.contacts);
  archive("elastic", sums_.elastic);
  archive("sliding", sums_.sliding);
  archive("dashpot_work", sums_.dashpot_work);
  archive("sliding_work", sums_.sliding_work);
  archive("bond_energy", sums_.bonds);
  archive("bond_drag", sums_.bond_drag);
  archive("fracture", sums_.fracture);
  archive("broken_bonds", sums_.broken);
  archive("wall_work", wall_work_);
}

}  // namespace sazare::engine
