#include "sazare/levels/motion/step.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "sazare/core/lane_records.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::motion {

namespace {

/// Returns whether the body would be too fast.
template <int D>
bool step_one(state::Bodies<D>& bodies, Index body, state::Impulse<D> given, const Stride& stride, state::MeanMotion<D>& mean) {
  auto& motion = bodies.motion[at(body)];
  auto& inertia = bodies.inertia[at(body)];
  const Vector<D> centre = motion.position - bodies.pole;
  given = given.about(centre);
  clear_locked(given, bodies.locks[at(body)]);
  if ((motion.velocity + (1 / inertia.mass) * given.linear).squaredNorm() > stride.fastest_squared) return true;
  mean = kick(motion, inertia, bodies.locks[at(body)], given).at(-centre);
  drift(motion, inertia, bodies.locks[at(body)], stride.due, stride.seconds);
  predict(motion, inertia, bodies.locks[at(body)], given);
  return false;
}

/// Bodies in lanes, with all that their step changes.
struct LaneState {
  LaneVector position, velocity, spin, predicted_velocity, predicted_spin, angular_momentum;
  LaneMatrix rotation;
  Lanes w, x, y, z;  ///< orientation
  LaneVector inverse_moments;
  Lanes inverse_mass;
};

/// Spin of an angular momentum, both in the body frame.
LaneVector spin_of(const LaneState& body, const LaneVector& momentum) {
  const LaneVector& inverse = body.inverse_moments;
  return {{momentum[0] * inverse[0], momentum[1] * inverse[1], momentum[2] * inverse[2]}};
}

/// Turns orientation and rotation by 2 atan(|half|) about `half`.
void rotate(LaneState& body, const LaneVector& half) {
  const LaneVector v{{body.x, body.y, body.z}};
  const Lanes w = body.w - dot(half, v);
  const LaneVector u = add_cross(half, v, add_product(body.w, half, v));
  const Lanes scale = inverse_square_root(add_product(w, w, dot(u, u)));
  body.w = w * scale, body.x = u[0] * scale, body.y = u[1] * scale, body.z = u[2] * scale;
  body.rotation = {rotation_of(broadcast(2), body.x, body.y, body.z, body.w)};
}

/// An impulse that bodies receive, or what their momenta gain by their next time.
struct LaneImpulse {
  LaneVector linear, angular;
};

struct LaneMeanMotion {
  LaneVector velocity, spin;
};

/// See kick.hpp; the angular momentum after the kick goes to `own` in the body frame.
LaneMeanMotion kick(LaneState& body, const LaneImpulse& given, LaneVector& own) {
  const LaneVector gained = body.inverse_mass * given.linear, turned = transposed(body.rotation, given.angular);
  own = transposed(body.rotation, body.angular_momentum);
  const Lanes half = broadcast(0.5);
  const LaneMeanMotion mean{add_product(half, gained, body.velocity),
                            body.rotation * spin_of(body, add_product(half, turned, own))};
  body.velocity = body.velocity + gained;
  body.angular_momentum = body.angular_momentum + given.angular;
  own = own + turned;
  return mean;
}

void drift(LaneState& body, const LaneVector& own, Lanes seconds) {
  body.position = body.position + seconds * body.velocity;
  const LaneVector spin = spin_of(body, own), turning = spin_of(body, cross(own, spin));
  body.spin = body.rotation * add_product(0.5 * seconds, turning, spin);
  rotate(body, (0.5 * seconds) * body.spin);
}

void predict(LaneState& body, const LaneImpulse& lead) {
  body.predicted_velocity = body.velocity + body.inverse_mass * lead.linear;
  const LaneVector own = transposed(body.rotation, body.angular_momentum + lead.angular);
  body.predicted_spin = body.rotation * spin_of(body, own);
}

/// What bodies are given and give, in spans of one length.
struct Spans {
  std::span<const Index> which;
  std::span<const state::Impulse<3>> given;
  std::span<const Stride> strides;
  std::span<state::MeanMotion<3>> mean;
};

/// Bodies whose rotation is free, one per lane: where in the spans they are. Side by side, or anywhere.
struct Neighbors {
  std::size_t first;
  std::size_t operator[](std::size_t lane) const { return first + lane; }
};
using Scattered = std::array<std::size_t, lane_count>;

// Whole quads of each record are read and written.
static_assert(sizeof(state::Motion<3>) == 32 * sizeof(Real) && sizeof(state::Inertia<3>) == 8 * sizeof(Real));
static_assert(sizeof(state::Impulse<3>) == 16 * sizeof(Real) && sizeof(state::MeanMotion<3>) == 8 * sizeof(Real));
static_assert(sizeof(Stride) == 4 * sizeof(Real));

/// Four numbers, from number `begin` on, of records of the bodies in lanes.
template <class Record, class Places>
std::array<Lanes, 4> load_row(std::span<const Record> records, const Places& places, std::size_t begin) {
  return load_quads([&](std::size_t lane) { return reinterpret_cast<const Real*>(&records[places[lane]]) + begin; });
}
template <class Record, class Places>
void store_row(const std::array<Lanes, 4>& fields, std::span<Record> records, const Places& places, std::size_t begin) {
  store_quads(fields, [&](std::size_t lane) { return reinterpret_cast<Real*>(&records[places[lane]]) + begin; });
}

/// What the kick does not read of the bodies is left open, and read when the drift needs it: registers are few.
LaneState load(const LanePointers<state::Motion<3>>& motions, const LanePointers<state::Inertia<3>>& inertias) {
  const auto m = load_records<12>(motions);
  const auto v = load_quad(motions, 18);
  const auto l = load_quad(motions, 20);
  const auto i = load_quad(inertias, 4);
  LaneState body;
  body.position = {{m[0], m[1], m[2]}};
  body.rotation = {{LaneVector{{m[3], m[4], m[5]}}, LaneVector{{m[6], m[7], m[8]}}, LaneVector{{m[9], m[10], m[11]}}}};
  body.velocity = {{v[0], v[1], v[2]}};
  body.angular_momentum = {{l[1], l[2], l[3]}};
  body.inverse_moments = {{i[0], i[1], i[2]}};
  body.inverse_mass = 1.0 / i[3];
  return body;
}

void load_orientation(LaneState& body, const LanePointers<state::Inertia<3>>& inertias) {
  const auto q = load_quad(inertias, 0);
  body.x = q[0], body.y = q[1], body.z = q[2], body.w = q[3];
}

void store(const LaneState& body, const Lanes& now, const Lanes& due, const LanePointers<state::Motion<3>>& motions,
           const LanePointers<state::Inertia<3>>& inertias) {
  const LaneVector &p = body.position, &v = body.velocity, &s = body.spin, &l = body.angular_momentum;
  const LaneVector &u = body.predicted_velocity, &t = body.predicted_spin;
  const LaneMatrix& r = body.rotation;
  store_quad({p[0], p[1], p[2], r[0][0]}, motions, 0);
  store_quad({r[0][1], r[0][2], r[1][0], r[1][1]}, motions, 4);
  store_quad({r[1][2], r[2][0], r[2][1], r[2][2]}, motions, 8);
  store_quad({u[0], u[1], u[2], t[0]}, motions, 12);
  store_quad({t[1], t[2], v[0], v[1]}, motions, 16);
  store_quad({v[2], l[0], l[1], l[2]}, motions, 20);
  store_quad({s[0], s[1], s[2], now}, motions, 24);
  store_quad({due, Lanes{}, Lanes{}, Lanes{}}, motions, 28);  // with what is unused, which checkpoints hold too
  store_quad({body.x, body.y, body.z, body.w}, inertias, 0);
}

/// Translations of bodies that are locked, one axis in a bit.
template <class Places>
LongLanes locked_axes(const state::Bodies<3>& bodies, std::span<const Index> which, const Places& places) {
  std::uint64_t locked = 0;  // a byte each
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    locked |= std::uint64_t{bodies.locks[at(which[places[lane]])].translation} << 8 * lane;
  return spread_bytes(locked);
}

/// What bodies are given, from number `begin` of its record on, about their centres and without what their locks take up.
template <class Places>
LaneImpulse load_impulse(std::span<const state::Impulse<3>> given, const Places& places, std::size_t begin,
                         const LaneVector& centre, const LongLanes& locked) {
  const auto first = load_row(given, places, begin), last = load_row(given, places, begin + 4);
  const LaneVector linear{{first[0], first[1], first[2]}}, about_pole{{first[3], last[0], last[1]}};
  return {state::without(locked, linear), add_cross(linear, centre, about_pole)};
}

/// Returns in which lanes a body would be too fast: then none has moved. Numbers of lanes never pass through memory one by one:
/// what loads them together would wait until everything before is done.
template <class Places>
[[gnu::flatten]] LaneMask step_batch(state::Bodies<3>& bodies, const Spans& spans, const Places& places) {
  LanePointers<state::Motion<3>> motions;
  LanePointers<state::Inertia<3>> inertias;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    motions[lane] = &bodies.motion[at(spans.which[places[lane]])];
    inertias[lane] = &bodies.inertia[at(spans.which[places[lane]])];
  }
  const LongLanes locked = locked_axes(bodies, spans.which, places);
  LaneState body = load(motions, inertias);
  const LaneVector centre = body.position - broadcast(bodies.pole);
  LaneVector own;
  const auto [mean_velocity, mean_spin] = kick(body, load_impulse(spans.given, places, 0, centre, locked), own);
  const auto [now, due, seconds, fastest_squared] = load_row(spans.strides, places, 0);
  const LaneMask too_fast = dot(body.velocity, body.velocity) > fastest_squared;
  if (any(too_fast)) return too_fast;
  const LaneVector at_pole = add_cross(centre, mean_spin, mean_velocity);
  store_row({at_pole[0], at_pole[1], at_pole[2], mean_spin[0]}, spans.mean, places, 0);
  store_row({mean_spin[1], mean_spin[2], Lanes{}, Lanes{}}, spans.mean, places, 4);
  load_orientation(body, inertias);
  drift(body, own, seconds);
  predict(body, load_impulse(spans.given, places, 8, centre, locked));
  store(body, now, due, motions, inertias);
  return too_fast;
}

/// Bodies that do not stand side by side in the spans, or too few for a batch.
class Stragglers {
public:
  Stragglers(state::Bodies<3>& bodies, const Spans& spans, std::vector<std::size_t>& too_fast)
      : bodies_(bodies), spans_(spans), too_fast_(too_fast) {}

  void add(std::size_t place) {
    places_[count_] = place;
    if (++count_ == lane_count) step();
  }

  /// Steps those there are; idle lanes repeat the first.
  void step() {
    while (count_ > 0) {
      for (auto lane = count_; lane < lane_count; ++lane) places_[lane] = places_[0];
      const LaneMask left = step_batch(bodies_, spans_, places_);
      const std::size_t count = std::exchange(count_, 0);
      if (!any(left)) return;
      for (std::size_t lane = 0; lane < count; ++lane)
        if (left[static_cast<int>(lane)] != 0)
          too_fast_.push_back(places_[lane]);
        else
          places_[count_++] = places_[lane];
    }
  }

private:
  state::Bodies<3>& bodies_;
  const Spans& spans_;
  std::vector<std::size_t>& too_fast_;
  Scattered places_;
  std::size_t count_ = 0;
};

/// Whether none of a batch of bodies has its rotation locked.
bool turn_freely(const state::Bodies<3>& bodies, std::span<const Index> which) {
  unsigned locked = 0;
  for (const Index body : which) locked |= bodies.locks[at(body)].rotation;
  return locked == 0;
}

}  // namespace

void step(state::Bodies<3>& bodies, std::span<const Index> which, std::span<const state::Impulse<3>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<3>> mean, std::vector<std::size_t>& too_fast) {
  const Spans spans{which, given, strides, mean};
  Stragglers stragglers(bodies, spans, too_fast);
  for (std::size_t first = 0; first < which.size(); first += lane_count) {
    const auto some = which.subspan(first, std::min<std::size_t>(lane_count, which.size() - first));
    if (some.size() == lane_count && turn_freely(bodies, some)) {
      const LaneMask left = step_batch(bodies, spans, Neighbors{first});
      if (!any(left)) continue;
      for (std::size_t lane = 0; lane < lane_count; ++lane)
        if (left[static_cast<int>(lane)] != 0)
          too_fast.push_back(first + lane);
        else
          stragglers.add(first + lane);
      continue;
    }
    for (std::size_t i = first; i < first + some.size(); ++i) {
      if (bodies.locks[at(which[i])].rotation == 0)
        stragglers.add(i);
      else if (step_one(bodies, which[i], given[i], strides[i], mean[i]))
        too_fast.push_back(i);
    }
  }
  stragglers.step();
}

void step(state::Bodies<2>& bodies, std::span<const Index> which, std::span<const state::Impulse<2>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<2>> mean, std::vector<std::size_t>& too_fast) {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (step_one(bodies, which[i], given[i], strides[i], mean[i])) too_fast.push_back(i);
}

}  // namespace sazare::motion
