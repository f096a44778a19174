#include "sazare/methods/rectangles/face_links.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include "sazare/core/lane_math.hpp"
#include "sazare/geometry/plane/outline_contact.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::rectangles {

namespace {

using laws::FaceFormula;
using laws::FaceMotion;
constexpr std::size_t band_packs = 64;             // packs of a group that are evaluated together
constexpr std::size_t serial_below = 4;            // bands
constexpr std::size_t serial_damaged_below = 512;  // links

/// Reads both elements of links, one by one (`T` Real) or in lanes.
template <class T>
class Reader {
public:
  Reader(const Index* first, const Index* second) : first_(first), second_(second) {}

  T of_first(const state::Column& column) const { return first_.of(column.data()); }
  T of_second(const state::Column& column) const { return second_.of(column.data()); }

private:
  struct Place {
    explicit Place(const Index* of) : place(at(*of)) {}
    Real of(const Real* column) const { return column[place]; }
    std::size_t place;
  };
  using Places = std::conditional_t<std::is_same_v<T, Real>, Place, LanePlaces>;

  Places first_, second_;
};

/// `turned` makes of an element's rotation (cosine and sine) the direction n that it has turned.
template <FaceFormula formula, class T, class Turned>
laws::FacePair<T> pair_of(const state::Particles<2>& particles, const Reader<T>& reader, const VectorOf<T, 2>& start_offset,
                          const Turned& turned, bool is_wall) {
  laws::FacePair<T> pair;
  for (int i = 0; i < 2; ++i) {
    const state::Column &displacement = particles.displacement[at(i)], &velocity = particles.velocity[at(i)];
    pair.apart[i] = start_offset[i] + (reader.of_second(displacement) - reader.of_first(displacement));
    pair.approach[i] = reader.of_first(velocity) - reader.of_second(velocity);
  }
  const T first_spin = reader.of_first(particles.velocity[2]), second_spin = reader.of_second(particles.velocity[2]);
  pair.spin_sum = first_spin + second_spin;
  pair.spin_difference = first_spin - second_spin;
  if constexpr (formula != FaceFormula::exact) pair.turn = reader.of_first(particles.angle) - reader.of_second(particles.angle);
  if (formula == FaceFormula::exact || is_wall) {
    pair.first_axis = turned(reader.of_first(particles.rotation[0]), reader.of_first(particles.rotation[1]));
    pair.second_axis = turned(reader.of_second(particles.rotation[0]), reader.of_second(particles.rotation[1]));
  }
  return pair;
}

}  // namespace

/// Faces of a group of a lattice: all the same.
struct FaceLinks::LatticeFaces {
  const laws::FaceSprings& springs;
  int axis = 0;

  template <class T>
  const laws::FaceSprings& at(std::size_t) const {
    return springs;
  }
  template <class T>
  auto turned_by(std::size_t) const {
    return [this](const T& c, const T& s) { return axis == 0 ? VectorOf<T, 2>{c, s} : VectorOf<T, 2>{-s, c}; };
  }
};

/// Faces of a group of a packing.
struct FaceLinks::PackingFaces {
  const FacetColumns& columns;
  const laws::FaceSprings& kind;
  std::size_t begin = 0;  ///< link of the first facet

  template <class T>
  laws::Facet<T> at(std::size_t link) const {
    const std::size_t i = link - begin;
    const T half_face = load<T>(columns.half_face, i), stiffness = load<T>(columns.stiffness, i);
    const T damping = load<T>(columns.damping, i);
    return {load<T>(columns.first_reach, i),
            load<T>(columns.second_reach, i),
            load<T>(columns.first_shift, i),
            load<T>(columns.second_shift, i),
            half_face,
            kind.normal * stiffness,
            kind.shear * stiffness,
            kind.normal_damping * damping,
            kind.shear_damping * damping,
            kind.tension_limit * half_face,
            kind.cohesion_limit * half_face,
            kind.friction};
  }
  template <class T>
  auto turned_by(std::size_t link) const {
    const T x = load<T>(columns.direction[0], link - begin), y = load<T>(columns.direction[1], link - begin);
    return [x, y](const T& c, const T& s) { return VectorOf<T, 2>{c * x - s * y, s * x + c * y}; };
  }

private:
  template <class T>
  static T load(const state::Column& column, std::size_t i) {
    if constexpr (std::is_same_v<T, Real>)
      return column[i];
    else
      return load_lanes(&column[i]);
  }
};

FaceLinks::FaceLinks(const state::Particles<2>& particles, std::vector<FaceKind> kinds, std::vector<FaceLink> links,
                     std::vector<FacetLink> facets)
    : kinds_(std::move(kinds)) {
  add_lattice(links);
  lattice_end_ = links_.size();
  add_facets(facets);
  const std::size_t n = links_.size();
  for (const FaceLink& link : links_) {
    first_.push_back(link.first);
    second_.push_back(link.second);
    slip_.push_back(link.slip);
    for (std::size_t axis = 0; axis < 2; ++axis)
      start_offset_[axis].push_back(particles.start[axis][at(link.second)] - particles.start[axis][at(link.first)]);
  }
  for (Group& group : groups_) share_start_offset(group);
  std::size_t packs = 0;
  for (const Group& group : groups_) packs = std::max(packs, (group.end - group.begin) / lane_count);
  bands_ = (packs + band_packs - 1) / band_packs;
  dashpot_loss_.assign(bands_ * groups_.size() * lane_count, 0);
  for (state::Column& column : last_rate_) column.assign(n, 0);
  for (state::Column* column : {&slots_.force_x, &slots_.force_y, &slots_.first_moment, &slots_.second_moment})
    column->assign(n + 1, 0);
  yields_.assign(n, 0);
  open_.assign(n, 0);
  damaged_of_.assign(n, none);
  if (lattice_end_ > 0) make_face_table(particles.padded());
  if (lattice_end_ < n) make_facet_table(particles.padded());
}

void FaceLinks::add_lattice(const std::vector<FaceLink>& links) {
  std::map<std::pair<Index, int>, std::vector<FaceLink>> sorted;
  for (const FaceLink& link : links) sorted[{link.kind, link.axis}].push_back(link);
  for (auto& [key, list] : sorted) {
    const std::size_t begin = links_.size();
    links_.insert(links_.end(), list.begin(), list.end());
    pad(key.first, key.second, begin);
  }
}

/// Fills the lanes of a group that begins here.
void FaceLinks::pad(Index kind, int axis, std::size_t begin) {
  const std::size_t unpadded = links_.size();
  while (links_.size() % lane_count != 0) links_.push_back({0, 0, axis, kind, 0});
  whole_.resize(links_.size() / lane_count, all_lanes);
  if (links_.size() > unpadded) whole_.back() = static_cast<LaneBits>(all_lanes >> (links_.size() - unpadded));
  groups_.push_back({kind, axis, begin, links_.size(), false});
}

/// Links of one lattice began alike but for round-off, which need not be read link by link.
void FaceLinks::share_start_offset(Group& group) {
  const Vector<2> common = {start_offset_[0][group.begin], start_offset_[1][group.begin]};
  const Real near = 1e-12 * std::hypot(common[0], common[1]);
  group.shares_start_offset = true;
  for (std::size_t i = group.begin; i < group.end && group.shares_start_offset; ++i)
    group.shares_start_offset = is_padding(static_cast<Index>(i)) || (std::abs(start_offset_[0][i] - common[0]) <= near &&
                                                                      std::abs(start_offset_[1][i] - common[1]) <= near);
  for (std::size_t i = group.begin; i < group.end && group.shares_start_offset; ++i)
    for (std::size_t axis = 0; axis < 2; ++axis) start_offset_[axis][i] = common[static_cast<int>(axis)];
}

void FaceLinks::make_face_table(std::size_t elements) {
  for (auto& column : face_) column.assign(elements, count());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (is_padding(static_cast<Index>(i)) || is_facet(i)) continue;
    face_[at(links_[i].axis)][at(links_[i].first)] = static_cast<Index>(i);
    face_[at(links_[i].axis + 2)][at(links_[i].second)] = static_cast<Index>(i);
  }
}

void FaceLinks::evaluate(const state::Particles<2>& particles, Real elapsed) {
  opened_.clear();
  std::atomic<bool> any_yields = false;
  parallel::parallel_for(bands_, serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t band = begin; band < end; ++band)
      for (std::size_t group = 0; group < groups_.size(); ++group)
        if (evaluate_whole(particles, group, band, elapsed)) any_yields.store(true, std::memory_order_relaxed);
  });
  if (any_yields) damage_those_that_yield();
  evaluate_damaged(particles, elapsed);
}

/// Links of a band of all groups lie near one another, since groups follow their elements: what one group has read of an element
/// is still in the cache when the next one does.
bool FaceLinks::evaluate_whole(const state::Particles<2>& particles, std::size_t number, std::size_t band, Real elapsed) {
  const Group& group = groups_[number];
  const FaceKind& kind = kinds_[at(group.kind)];
  const std::size_t packs = (group.end - group.begin) / lane_count;
  const Part part{group.begin + packs * band / bands_ * lane_count, group.begin + packs * (band + 1) / bands_ * lane_count,
                  &dashpot_loss_[(band * groups_.size() + number) * lane_count], elapsed, group.shares_start_offset};
  if (group.axis == FaceLink::own_direction)
    return evaluate_whole<FaceFormula::exact>(particles, kind.springs, PackingFaces{facets_, kind.springs, lattice_end_}, part);
  const LatticeFaces faces{kind.springs, group.axis};
  switch (kind.formula) {
    case FaceFormula::exact:
      return evaluate_whole<FaceFormula::exact>(particles, kind.springs, faces, part);
    case FaceFormula::small:
      return evaluate_whole<FaceFormula::small>(particles, kind.springs, faces, part);
    default:
      return evaluate_whole<FaceFormula::older>(particles, kind.springs, faces, part);
  }
}

template <FaceFormula formula, class Faces>
bool FaceLinks::evaluate_whole(const state::Particles<2>& particles, const laws::FaceSprings& kind, const Faces& faces,
                               const Part& part) {
  const Real count = kind.count(), squares = kind.square_sum(), last = kind.last_place();
  const Real elapsed = part.elapsed;
  bool any_yields = false;
  Lanes loss{};
  VectorOf<Lanes, 2> start_offset = {broadcast(start_offset_[0][part.begin]), broadcast(start_offset_[1][part.begin])};
  for (std::size_t i = part.begin; i < part.end; i += lane_count) {
    if (whole_[i / lane_count] == 0) continue;
    const LaneMask active = mask_of(whole_[i / lane_count]);
    if (!part.shares_start_offset) start_offset = {load_lanes(&start_offset_[0][i]), load_lanes(&start_offset_[1][i])};
    const auto& springs = faces.template at<Lanes>(i);
    const auto pair = pair_of<formula>(particles, Reader<Lanes>(&first_[i], &second_[i]), start_offset,
                                       faces.template turned_by<Lanes>(i), springs.is_wall());
    const auto motion = laws::face_motion<formula>(pair, springs);
    const Lanes slip = load_lanes(&slip_[i]);
    const Lanes elastic = laws::elastic_shear(formula, slip, motion.shear, motion.shear_rate, elapsed);
    const LaneMask yields = active & laws::yields(springs, motion, elastic, last);
    const LaneMask stays = active & ~yields;
    if (any(yields)) {
      any_yields = true;
      for (std::size_t lane = 0; lane < lane_count; ++lane) yields_[i + lane] = yields[lane] != 0 ? 1 : 0;
    }
    if constexpr (formula != FaceFormula::exact) store_lanes(&slip_[i], select(stays, elastic, slip));
    const Lanes normal = count * (springs.normal * motion.closing + springs.normal_damping * motion.closing_rate);
    const Lanes tilt = squares * (springs.normal * motion.slope + springs.normal_damping * motion.slope_rate);
    const Lanes shear = count * (springs.shear * elastic + springs.shear_damping * motion.shear_rate);
    const auto force = laws::face_force(motion, normal, tilt, shear);
    store_lanes(&slots_.force_x[i], select(stays, force.force[0], Lanes{}));
    store_lanes(&slots_.force_y[i], select(stays, force.force[1], Lanes{}));
    store_lanes(&slots_.first_moment[i], select(stays, force.first_moment, Lanes{}));
    store_lanes(&slots_.second_moment[i], select(stays, force.second_moment, Lanes{}));
    // The work of the dashpots' last forces, by the mean of the rates before and after.
    const std::array<Lanes, 3> rate = {motion.closing_rate, motion.slope_rate, motion.shear_rate};
    const auto normal_damping = springs.normal_damping * count, shear_damping = springs.shear_damping * count;
    const std::array damping = {normal_damping, springs.normal_damping * squares, shear_damping};
    Lanes power{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Lanes before = load_lanes(&last_rate_[k][i]);
      power += 0.5 * damping[k] * before * (before + rate[k]);
      store_lanes(&last_rate_[k][i], select(stays, rate[k], Lanes{}));
    }
    loss += select(active, elapsed * power, Lanes{});
  }
  store_lanes(part.loss, load_lanes(part.loss) + loss);
  return any_yields;
}

/// In the order of the links, whoever found them.
void FaceLinks::damage_those_that_yield() {
  for (auto found = std::ranges::find(yields_, 1); found != yields_.end(); found = std::find(found, yields_.end(), 1)) {
    *found = 0;
    damage(static_cast<Index>(found - yields_.begin()));
  }
}

void FaceLinks::damage(Index number) {
  whole_[at(number) / lane_count] &= static_cast<LaneBits>(~(1u << at(number) % lane_count));
  damaged_of_[at(number)] = static_cast<Index>(damaged_.size());
  damaged_.push_back(number);
  first_spring_.push_back(static_cast<Index>(springs_.size()));
  springs_.insert(springs_.end(), kind_of(number).springs.places.size(), {slip_[at(number)], 0, 0, true, true});
  damaged_loss_.push_back({});
  just_opened_.push_back(0);
}

laws::FaceMotion<Real> FaceLinks::motion_of(const state::Particles<2>& particles, std::size_t number) const {
  const FaceKind& kind = kinds_[at(links_[number].kind)];
  const Reader<Real> reader(&first_[number], &second_[number]);
  const Vector<2> start_offset = {start_offset_[0][number], start_offset_[1][number]};
  const auto by = [&]<FaceFormula formula>(const auto& faces) {
    const auto& springs = faces.template at<Real>(number);
    return laws::face_motion<formula>(
        pair_of<formula>(particles, reader, start_offset, faces.template turned_by<Real>(number), springs.is_wall()), springs);
  };
  if (is_facet(number)) return by.template operator()<FaceFormula::exact>(PackingFaces{facets_, kind.springs, lattice_end_});
  const LatticeFaces faces{kind.springs, links_[number].axis};
  switch (kind.formula) {
    case FaceFormula::exact:
      return by.template operator()<FaceFormula::exact>(faces);
    case FaceFormula::small:
      return by.template operator()<FaceFormula::small>(faces);
    default:
      return by.template operator()<FaceFormula::older>(faces);
  }
}

void FaceLinks::evaluate_damaged(const state::Particles<2>& particles, Real elapsed) {
  if (damaged_.empty()) return;
  parallel::parallel_for(damaged_.size(), serial_damaged_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place)
      if (!is_open(damaged_[place])) evaluate_damaged(particles, place, elapsed);
  });
  close_energy_balance();
}

void FaceLinks::evaluate_damaged(const state::Particles<2>& particles, std::size_t place, Real elapsed) {
  const std::size_t number = at(damaged_[place]);
  const FaceKind& kind = kinds_[at(links_[number].kind)];
  const FaceMotion<Real> motion = motion_of(particles, number);
  if (is_facet(number))
    advance_damaged(kind, PackingFaces{facets_, kind.springs, lattice_end_}.at<Real>(number), motion, place, elapsed);
  else
    advance_damaged(kind, kind.springs, motion, place, elapsed);
}

template <class Face>
void FaceLinks::advance_damaged(const FaceKind& kind, const Face& face, const FaceMotion<Real>& motion, std::size_t place,
                                Real elapsed) {
  const std::size_t number = at(damaged_[place]);
  Real normal = 0, tilt = 0, shear = 0;
  bool joined = false;
  SpringLosses& loss = damaged_loss_[place];
  for (std::size_t i = 0; i < kind.springs.places.size(); ++i) {
    laws::SpringState& spring = springs_[at(first_spring_[place]) + i];
    const Real xi = kind.springs.places[i];
    const laws::SpringForce force = laws::advance_spring(spring, face, kind.formula, motion, xi, elapsed);
    normal += force.normal;
    tilt += xi * force.normal;
    shear += force.shear;
    joined = joined || spring.joined;
    loss.dashpot += force.dashpot_loss;
    loss.friction += force.friction_loss;
    loss.fracture += force.fracture_loss;
  }
  const laws::FaceForce<Real> force = laws::face_force(motion, normal, tilt, shear);
  slots_.force_x[number] = force.force[0];
  slots_.force_y[number] = force.force[1];
  slots_.first_moment[number] = force.first_moment;
  slots_.second_moment[number] = force.second_moment;
  just_opened_[place] = joined ? 0 : 1;
}

/// Takes links that have opened out of the list.
void FaceLinks::close_energy_balance() {
  for (std::size_t place = 0; place < damaged_.size(); ++place) {
    if (just_opened_[place] == 0 || is_open(damaged_[place])) continue;
    open_[at(damaged_[place])] = 1;
    opened_.push_back(damaged_[place]);
    ++open_links_;
  }
  std::ranges::sort(opened_);
}

laws::Facet<Real> FaceLinks::springs_of(Index number) const {
  const laws::FaceSprings& of = kind_of(number).springs;
  if (is_facet(at(number))) return PackingFaces{facets_, of, lattice_end_}.at<Real>(at(number));
  return {
      of.first_reach,   of.second_reach,   0,          0, of.half_face, of.normal, of.shear, of.normal_damping, of.shear_damping,
      of.tension_limit, of.cohesion_limit, of.friction};
}

void FaceLinks::gather(std::size_t pack, std::array<Lanes, 3>& sum) const {
  const auto take = [&](const Index* links, bool comes_first) {
    const LanePlaces slots(links);
    const Lanes x = slots.of(slots_.force_x.data()), y = slots.of(slots_.force_y.data());
    if (comes_first) {
      sum[0] -= x;
      sum[1] -= y;
      sum[2] += slots.of(slots_.first_moment.data());
    } else {
      sum[0] += x;
      sum[1] += y;
      sum[2] += slots.of(slots_.second_moment.data());
    }
  };
  for (std::size_t face = 0; face < 4 && lattice_end_ > 0; ++face) take(&face_[face][pack * lane_count], face < 2);
  if (facet_rows_.empty()) return;
  const FacetRows& rows = facet_rows_[pack];
  const Index* const table = &facet_table_[rows.begin];
  for (std::size_t row = 0; row < rows.first + rows.second; ++row) take(table + row * lane_count, row < rows.first);
}

}  // namespace sazare::methods::rectangles
