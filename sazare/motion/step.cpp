#include "sazare/motion/step.hpp"

#include "sazare/core/lane_records.hpp"
#include "sazare/motion/kick.hpp"

namespace sazare::motion {

namespace {

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// Returns whether the body would be too fast.
template <int D>
bool step_one(state::Bodies<D>& bodies, Index body, state::Impulse<D> given, const Stride& stride, state::MeanMotion<D>& mean) {
  auto& motion = bodies.motion[at(body)];
  auto& inertia = bodies.inertia[at(body)];
  clear_locked(given, bodies.locks[at(body)]);
  if ((motion.velocity + (1 / inertia.mass) * given.linear).squaredNorm() > stride.fastest_squared) return true;
  mean = kick(motion, inertia, bodies.locks[at(body)], given);
  drift(motion, inertia, bodies.locks[at(body)], stride.due, stride.seconds);
  foresee(motion, inertia, bodies.locks[at(body)], given);
  return false;
}

/// Bodies in lanes, with all that their step changes.
struct LaneState {
  LaneVector position, velocity, spin, foreseen_velocity, foreseen_spin, angular_momentum;
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
  body.rotation = rotation_of(broadcast(2), body.x, body.y, body.z, body.w);
}

struct LaneImpulse {
  LaneVector linear, angular, linear_lead, angular_lead;
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

void foresee(LaneState& body, const LaneImpulse& given) {
  body.foreseen_velocity = body.velocity + body.inverse_mass * given.linear_lead;
  const LaneVector own = transposed(body.rotation, body.angular_momentum + given.angular_lead);
  body.foreseen_spin = body.rotation * spin_of(body, own);
}

/// Bodies whose rotation is free, one per lane; idle lanes repeat the first.
struct Batch {
  std::array<Index, lane_count> body{};
  std::array<std::size_t, lane_count> place{};  ///< in the spans
  int count = 0;

  void add(Index each, std::size_t its_place) {
    body[at(count)] = each;
    place[at(count)] = its_place;
    ++count;
  }
  void fill_idle_lanes() {
    for (auto lane = at(count); lane < lane_count; ++lane) {
      body[lane] = body[0];
      place[lane] = place[0];
    }
  }
};

// Whole quads of each record are read and written.
static_assert(sizeof(state::Motion<3>) == 32 * sizeof(Real) && sizeof(state::Inertia<3>) == 8 * sizeof(Real));
static_assert(sizeof(state::Impulse<3>) == 16 * sizeof(Real) && sizeof(state::MeanMotion<3>) == 8 * sizeof(Real));

/// What the kick does not read of the bodies is left open.
LaneState load(const LanePointers<state::Motion<3>>& motions, const LanePointers<state::Inertia<3>>& inertias) {
  const auto m = load_records<12>(motions);
  const auto v = load_quad(motions, 18);
  const auto l = load_quad(motions, 20);
  const auto i = load_records<8>(inertias);
  LaneState body;
  body.position = {{m[0], m[1], m[2]}};
  body.rotation = {{LaneVector{{m[3], m[4], m[5]}}, LaneVector{{m[6], m[7], m[8]}}, LaneVector{{m[9], m[10], m[11]}}}};
  body.velocity = {{v[0], v[1], v[2]}};
  body.angular_momentum = {{l[1], l[2], l[3]}};
  body.x = i[0], body.y = i[1], body.z = i[2], body.w = i[3];
  body.inverse_moments = {{i[4], i[5], i[6]}};
  body.inverse_mass = 1.0 / i[7];
  return body;
}

void store(const LaneState& body, const LongLanes& kicked, const LongLanes& due, const LanePointers<state::Motion<3>>& motions,
           const LanePointers<state::Inertia<3>>& inertias) {
  const LaneVector &p = body.position, &v = body.velocity, &s = body.spin, &l = body.angular_momentum;
  const LaneVector &u = body.foreseen_velocity, &t = body.foreseen_spin;
  const LaneMatrix& r = body.rotation;
  store_quad({p[0], p[1], p[2], r[0][0]}, motions, 0);
  store_quad({r[0][1], r[0][2], r[1][0], r[1][1]}, motions, 4);
  store_quad({r[1][2], r[2][0], r[2][1], r[2][2]}, motions, 8);
  store_quad({u[0], u[1], u[2], t[0]}, motions, 12);
  store_quad({t[1], t[2], v[0], v[1]}, motions, 16);
  store_quad({v[2], l[0], l[1], l[2]}, motions, 20);
  store_quad({s[0], s[1], s[2], reinterpret_cast<Lanes>(kicked)}, motions, 24);
  store_quad({reinterpret_cast<Lanes>(due), Lanes{}, Lanes{}, Lanes{}}, motions, 28);
  store_quad({body.x, body.y, body.z, body.w}, inertias, 0);
}

/// Removes what the locks of bodies take up. Few have any.
void clear_locked(LaneImpulse& given, const state::Bodies<3>& bodies, const Batch& batch) {
  std::array<unsigned, lane_count> locked;
  unsigned all = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) all |= locked[lane] = bodies.locks[at(batch.body[lane])].translation;
  if (all == 0) return;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (int axis = 0; axis < 3; ++axis)
      if (locked[lane] >> axis & 1)
        given.linear[axis][static_cast<int>(lane)] = given.linear_lead[axis][static_cast<int>(lane)] = 0;
}

/// Returns in which lanes a body would be too fast: then none has moved.
[[gnu::flatten]] LaneMask step_batch(state::Bodies<3>& bodies, const Batch& batch, std::span<const state::Impulse<3>> given,
                                     std::span<const Stride> strides, std::span<state::MeanMotion<3>> mean) {
  LanePointers<state::Motion<3>> motions;
  LanePointers<state::Inertia<3>> inertias;
  LanePointers<const state::Impulse<3>> impulses;
  LanePointers<state::MeanMotion<3>> means;
  Lanes seconds, fastest_squared;
  LongLanes kicked, due;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto i = static_cast<int>(lane);
    motions[lane] = &bodies.motion[at(batch.body[lane])];
    inertias[lane] = &bodies.inertia[at(batch.body[lane])];
    impulses[lane] = &given[batch.place[lane]];
    means[lane] = &mean[batch.place[lane]];
    const Stride& stride = strides[batch.place[lane]];
    seconds[i] = stride.seconds;
    fastest_squared[i] = stride.fastest_squared;
    due[i] = stride.due;
    kicked[i] = motions[lane]->due;
  }
  const auto f = load_records<16>(impulses);
  LaneImpulse impulse{{{f[0], f[1], f[2]}}, {{f[3], f[4], f[5]}}, {{f[8], f[9], f[10]}}, {{f[11], f[12], f[13]}}};
  clear_locked(impulse, bodies, batch);
  LaneState body = load(motions, inertias);
  LaneVector own;
  const auto [mean_velocity, mean_spin] = kick(body, impulse, own);
  const LaneMask too_fast = dot(body.velocity, body.velocity) > fastest_squared;
  if (any(too_fast)) return too_fast;
  drift(body, own, seconds);
  foresee(body, impulse);
  store(body, kicked, due, motions, inertias);
  store_quad({mean_velocity[0], mean_velocity[1], mean_velocity[2], mean_spin[0]}, means, 0);
  store_quad({mean_spin[1], mean_spin[2], Lanes{}, Lanes{}}, means, 4);
  return too_fast;
}

/// Takes the bodies in some lanes out.
Batch without(const LaneMask& lanes, const Batch& batch) {
  Batch rest;
  for (int lane = 0; lane < batch.count; ++lane)
    if (lanes[lane] == 0) rest.add(batch.body[at(lane)], batch.place[at(lane)]);
  return rest;
}

}  // namespace

void step(state::Bodies<3>& bodies, std::span<const Index> which, std::span<const state::Impulse<3>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<3>> mean, std::vector<std::size_t>& too_fast) {
  Batch batch;
  const auto flush = [&] {
    while (batch.count > 0) {
      batch.fill_idle_lanes();
      const LaneMask left = step_batch(bodies, batch, given, strides, mean);
      if (!any(left)) break;
      for (int lane = 0; lane < batch.count; ++lane)
        if (left[lane] != 0) too_fast.push_back(batch.place[at(lane)]);
      batch = without(left, batch);
    }
    batch.count = 0;
  };
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (bodies.locks[at(which[i])].rotation != 0) {
      if (step_one(bodies, which[i], given[i], strides[i], mean[i])) too_fast.push_back(i);
      continue;
    }
    batch.add(which[i], i);
    if (batch.count == lane_count) flush();
  }
  flush();
}

void step(state::Bodies<2>& bodies, std::span<const Index> which, std::span<const state::Impulse<2>> given,
          std::span<const Stride> strides, std::span<state::MeanMotion<2>> mean, std::vector<std::size_t>& too_fast) {
  for (std::size_t i = 0; i < which.size(); ++i)
    if (step_one(bodies, which[i], given[i], strides[i], mean[i])) too_fast.push_back(i);
}

}  // namespace sazare::motion
