#include "sazare/methods/spheres/wall_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

WallContacts::WallContacts(ContactTable table, std::vector<Wall> walls, Real reach)
    : table_(std::move(table)), walls_(std::move(walls)), reach_(reach) {
  join_walls();
  for (const Wall& wall : walls_) trees_.emplace_back(wall.triangles, reach);
  poses_.resize(walls_.size());
  move(0);
}

void WallContacts::add_surface(Wall wall) {
  surface_ = walls_.size();
  surface_of_.push_back(static_cast<Index>(surfaces_.size()));
  surfaces_.push_back({{static_cast<Index>(surface_)}, {0}, wall.nodal.complex()});
  walls_.push_back(std::move(wall));
  trees_.emplace_back(std::span<const geometry::Triangle>{}, reach_);  // made anew by every search
  poses_.emplace_back();
}

Real WallContacts::lead(Real time, Real step, std::vector<Vector3> from, std::vector<Vector3> with) {
  return walls_[surface_].nodal.lead(time, step, std::move(from), std::move(with));
}

void WallContacts::add_work_of_surface(Real step) {
  if (surface() == nullptr) return;
  std::vector<geometry::NodeForce> forces;
  for (const auto& tiles : parts_)
    for (const Tile& tile : tiles) forces.insert(forces.end(), tile.on_nodes.begin(), tile.on_nodes.end());
  walls_[surface_].nodal.add_work(forces, step);
}

void WallContacts::move(Real time) {
  if (!stand_still_) time_ = time;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    poses_[w] = WallPose::of(walls_[w].motion, time_);
    if (stand_still_) poses_[w].velocity = poses_[w].spin = Vector3::Zero();
  }
}

/// A triangle of a wall, in the frame of its pose.
geometry::Triangle WallContacts::triangle(std::size_t wall, std::int32_t number) const {
  const auto face = static_cast<std::size_t>(number);
  return wall == surface_ ? walls_[wall].nodal.corners(face, time_) : walls_[wall].triangles[face];
}

/// A rigid surface is touched in the middle of the overlap; a face with nodes on itself, where its shape functions are known.
WallContacts::Ground WallContacts::ground_at(const Point& point, Real radius) const {
  const auto w = static_cast<std::size_t>(point.wall);
  Ground ground;
  if (w == surface_) {
    ground.arm = radius - point.overlap;
    ground.place = point.centre - ground.arm * point.normal;
    ground.face = walls_[w].nodal.point(static_cast<std::size_t>(point.triangle), time_, ground.place);
    ground.velocity = ground.face->velocity();
    ground.spin = ground.face->spin();
    return ground;
  }
  ground.arm = radius - 0.5 * point.overlap;
  ground.place = point.centre - ground.arm * point.normal;
  ground.velocity = poses_[w].velocity_at(ground.place);
  ground.spin = poses_[w].spin;
  return ground;
}

/// Contacts in lanes, one in each.
template <bool rolls>
struct WallContacts::InLanes {
  laws::ContactConstants<Lanes> constants;
  laws::ContactMotion<Lanes> at;
  laws::ContactMemory<Lanes> memory;

  void set(int lane, const laws::ContactConstants<Real>& of, const Point& point, const Touch& touch) {
    constants.normal[lane] = of.normal;
    constants.tangential[lane] = of.tangential;
    constants.normal_damping[lane] = of.normal_damping;
    constants.tangential_damping[lane] = of.tangential_damping;
    constants.friction[lane] = of.friction;
    constants.adhesion[lane] = of.adhesion;
    at.overlap[lane] = point.overlap;
    put(at.normal, lane, point.normal);
    put(memory.sliding, lane, touch.sliding);
    if constexpr (rolls) {
      constants.rolling[lane] = of.rolling;
      constants.twisting[lane] = of.twisting;
      put(memory.rolling, lane, touch.rolling);
      memory.twisting[lane] = touch.twisting;
    }
  }

  void set(int lane, const state::SpherePlace& place, const Vector3& spin, const Point& point, const Ground& ground, Real step) {
    at.radius.product[lane] = place.radius;
    at.mass.product[lane] = place.mass;
    put(at.velocity, lane, place.velocity() - ground.arm * spin.cross(point.normal) - ground.velocity);
    put(at.tilt, lane, 2 / (1 + point.before.dot(point.normal)) * (point.normal - point.before));  // exact for any angle
    at.turn[lane] = step * ground.spin.dot(point.normal);
    if constexpr (rolls) {
      put(at.rolling, lane, place.radius * (spin - ground.spin).cross(point.normal));
      at.twisting[lane] = place.radius * (spin - ground.spin).dot(point.normal);
    }
  }

  static void put(LaneVector& numbers, int lane, const Vector3& vector) {
    for (int axis = 0; axis < 3; ++axis) numbers[axis][lane] = vector[axis];
  }
  static Vector3 get(const LaneVector& numbers, int lane) { return {numbers[0][lane], numbers[1][lane], numbers[2][lane]}; }
};

/// Forces at as many points as there are lanes, or fewer, from one on; what is too much repeats the first and does not count.
template <class Law, bool rolls>
ContactSums WallContacts::push(const state::Spheres& spheres, std::size_t begin, const Task& task, Tile& tile) const {
  const int count = static_cast<int>(std::min<std::size_t>(lane_count, tile.points.size() - begin));
  InLanes<rolls> lanes;
  std::optional<laws::SlipBands<Lanes>> bands;  // of a law that slips in part
  if constexpr (Law::slips_in_part) bands.emplace();
  std::array<Ground, lane_count> grounds;
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t n = begin + static_cast<std::size_t>(lane < count ? lane : 0);
    const Point& point = tile.points[n];
    const auto i = static_cast<std::size_t>(tile.touches[n].sphere);
    Ground& ground = grounds[static_cast<std::size_t>(lane)] = ground_at(point, spheres.place[i].radius);
    lanes.set(lane,
              table_.of(static_cast<Index>(spheres.spin[i].material), walls_[static_cast<std::size_t>(point.wall)].material),
              point, tile.touches[n]);
    lanes.set(lane, spheres.place[i], spheres.spin[i].spin(), point, ground, task.step);
    if constexpr (Law::slips_in_part)
      visit_numbers(*bands, tile.bands[n], [lane](Lanes& in_lanes, const Real& number) { in_lanes[lane] = number; });
  }
  lanes.at.radius.sum = lanes.at.mass.sum = broadcast(1);
  lanes.at.step = broadcast(task.step);
  const auto forces = laws::contact_force<Law, rolls>(lanes.constants, lanes.at, lanes.memory, bands ? &*bands : nullptr);
  const auto some = std::span(tile.points).subspan(begin, static_cast<std::size_t>(count));
  Lanes spring{};
  if (std::ranges::any_of(some, [](const Point& point) { return point.count != point.share; }))
    spring = Law::force(lanes.constants, Law::width(lanes.constants, lanes.at.overlap, lanes.at.radius), lanes.at.overlap,
                        lanes.at.radius);
  ContactSums sums;
  for (int lane = 0; lane < count; ++lane) {
    const std::size_t n = begin + static_cast<std::size_t>(lane);
    Touch& touch = tile.touches[n];
    const Point& point = tile.points[n];
    const Vector3& normal = point.normal;
    if constexpr (Law::slips_in_part)
      visit_numbers(*bands, tile.bands[n], [lane](const Lanes& in_lanes, Real& number) { number = in_lanes[lane]; });
    else
      touch.sliding = lanes.get(lanes.memory.sliding, lane);
    Vector3 force = point.share * (forces.normal[lane] * normal + lanes.get(forces.friction, lane));
    if (point.count != point.share) force += (point.count - point.share) * spring[lane] * normal;
    Vector3 turning = Vector3::Zero();
    if constexpr (rolls) {
      touch.rolling = lanes.get(lanes.memory.rolling, lane);
      touch.twisting = lanes.memory.twisting[lane];
      turning = -point.share * spheres.place[static_cast<std::size_t>(touch.sphere)].radius *
                (normal.cross(lanes.get(forces.rolling, lane)) + forces.twisting[lane] * normal);
    }
    deliver(n, grounds[static_cast<std::size_t>(lane)], force, turning, task, tile);
    if (!point.slope.isZero(0))
      deliver_at_centre(n, grounds[static_cast<std::size_t>(lane)], -forces.elastic_energy[lane] * point.slope, task, tile);
    sums += {point.count * forces.elastic_energy[lane], point.share * forces.sliding_energy[lane],
             task.step * point.share * forces.dashpot_power[lane], task.step * point.share * forces.sliding_power[lane],
             point.share > 0 ? 1 : 0};
  }
  return sums;
}

/// A force and the moment that resists turning at a point, to its sphere and back to its wall.
void WallContacts::deliver(std::size_t n, const Ground& ground, const Vector3& force, const Vector3& turning, const Task& task,
                           Tile& tile) const {
  const Point& point = tile.points[n];
  const auto w = static_cast<std::size_t>(point.wall);
  const Vector3 moment = -ground.arm * point.normal.cross(force) - turning;
  state::SphereLoad& load = task.own[static_cast<std::size_t>(tile.touches[n].sphere) - task.tile * neighbors::tile_size];
  load.fx += force.x();
  load.fy += force.y();
  load.fz += force.z();
  load.mx += moment.x();
  load.my += moment.y();
  load.mz += moment.z();
  const Vector3 foot = ground.place - poses_[w].pivot - poses_[w].shift;
  tile.loads[w] += {-force, turning - foot.cross(force), task.step * (force.dot(ground.velocity) - turning.dot(ground.spin))};
  if (!ground.face) return;
  const auto forces = ground.face->on_corners(-force, turning);
  for (std::size_t k = 0; k < 3; ++k) tile.on_nodes.push_back({ground.face->nodes[k], forces[k]});
}

/// A force that does not turn the sphere, and back to its wall.
void WallContacts::deliver_at_centre(std::size_t n, const Ground& ground, const Vector3& force, const Task& task,
                                     Tile& tile) const {
  const Point& point = tile.points[n];
  const auto w = static_cast<std::size_t>(point.wall);
  state::SphereLoad& load = task.own[static_cast<std::size_t>(tile.touches[n].sphere) - task.tile * neighbors::tile_size];
  load.fx += force.x();
  load.fy += force.y();
  load.fz += force.z();
  const Vector3 arm = point.centre - ground.place, moment = arm.cross(force);
  tile.loads[w] += {-force, -(point.centre - poses_[w].pivot - poses_[w].shift).cross(force),
                    task.step * (force.dot(ground.velocity) + moment.dot(ground.spin))};
  if (!ground.face) return;
  const auto forces = ground.face->on_corners(-force, -moment);
  for (std::size_t k = 0; k < 3; ++k) tile.on_nodes.push_back({ground.face->nodes[k], forces[k]});
}

WallContacts::Push WallContacts::push_of_table() const {
  return visit_law(table_, []<class Law, class Rolls>(Law, Rolls) -> Push { return &WallContacts::push<Law, Rolls::value>; });
}

/// Where the spheres of a tile touch surfaces, each with what it remembers.
void WallContacts::touch_anew(const state::Spheres& spheres, Tile& tile) const {
  std::swap(tile.before, tile.touches);
  std::swap(tile.bands_before, tile.bands);
  tile.touches.clear();
  tile.bands.clear();
  tile.points.clear();
  const bool repeats = spheres.box.repeats();
  const Vector3 inverse = spheres.box.inverse();
  auto remembered = tile.before.begin();
  for (auto from = tile.near.begin(); from != tile.near.end();) {
    const Index sphere = from->sphere;
    const auto to = std::find_if(from, tile.near.end(), [&](const Near& one) { return one.sphere != sphere; });
    const state::SpherePlace& place = spheres.place[static_cast<std::size_t>(sphere)];
    const std::size_t begin = tile.points.size();
    find_points(spheres, repeats ? spheres.box.wrapped(place.centre(), inverse) : place.centre(), {from, to}, tile);
    from = to;
    while (remembered != tile.before.end() && remembered->sphere < sphere) ++remembered;
    const auto others = std::find_if(remembered, tile.before.end(), [&](const Touch& old) { return old.sphere != sphere; });
    take_points(sphere, begin, {remembered, others}, tile);
  }
  if (table_.adheres()) note_parted(spheres, tile);
}

/// Adds up the energy dissipated by touches that have ended. One that merges with a deeper one nearby counts the same.
void WallContacts::note_parted(const state::Spheres& spheres, Tile& tile) const {
  for (const Touch& old : tile.before) {
    if (old.wall < 0 || !(old.share > 0)) continue;
    const auto sphere = static_cast<std::size_t>(old.sphere);
    tile.parting_loss += table_.parting_loss(static_cast<Index>(spheres.spin[sphere].material),
                                             walls_[static_cast<std::size_t>(old.wall)].material, spheres.place[sphere].radius);
  }
}

ContactSums WallContacts::evaluate(const state::Spheres& spheres, const Task& task) {
  Tile& tile = parts_[task.part][task.tile];
  std::fill(tile.loads.begin(), tile.loads.end(), WallLoad{});
  tile.on_nodes.clear();
  tile.passage.reset();
  tile.parting_loss = 0;
  ContactSums sums;
  const std::size_t begin_of_tile = task.tile * neighbors::tile_size;
  for (std::size_t w = 0; w < tile.planes.size(); ++w)
    if (tile.planes[w].size() > 0)
      sums += evaluate_plane(tile.planes[w], {spheres, table_, walls_[w], poses_[w], task.step, task.own, begin_of_tile},
                             tile.loads[w]);
  touch_anew(spheres, tile);
  const Push push_some = push_of_table();
  for (std::size_t begin = 0; begin < tile.points.size(); begin += lane_count)
    sums += (this->*push_some)(spheres, begin, task, tile);
  sums.dashpot_work += tile.parting_loss;
  for (const WallLoad& load : tile.loads) sums.wall_work += load.work;
  return sums;
}

std::vector<WallLoadSums> WallContacts::load_sums() const {
  std::vector<WallLoadSums> total(walls_.size());
  for (const auto& tiles : parts_)
    for (const Tile& tile : tiles)
      for (std::size_t w = 0; w < total.size(); ++w) total[w] += tile.loads[w];
  return total;
}

std::vector<WallLoad> WallContacts::loads() const {
  std::vector<WallLoad> total;
  for (const WallLoadSums& sums : surveyed_.empty() ? load_sums() : surveyed_) total.push_back(sums.load());
  return total;
}

Real WallContacts::largest_speed(Real radius) const {
  Real largest = 0;
  for (const WallPose& pose : poses_) largest = std::max(largest, pose.velocity.norm() + pose.spin.norm() * radius);
  if (surface() != nullptr) largest = std::max(largest, surface()->largest_speed());
  return largest;
}

void WallContacts::survey(const RankTiles& ranks) {
  surveyed_ = load_sums();
  for (std::size_t w = 0; w < surveyed_.size(); ++w) {
    const std::vector<WallLoadSums> parts = ranks.to_first(std::exchange(surveyed_[w], {}), parallel::Topic::rows);
    for (const WallLoadSums& part : parts) surveyed_[w] += part;
  }
}

void WallContacts::collect(const RankTiles& ranks) {
  collected_.clear();
  for (const auto& tiles : parts_) {
    std::vector<Kept> of_part = ranks.collect<Kept>(tiles.size(), [&](std::size_t tile) { return kept_by(tiles[tile]); });
    std::ranges::move(of_part, std::back_inserter(collected_));
  }
}

void WallContacts::columns(Archive& archive) {
  std::vector<Kept> by_tile = std::exchange(collected_, {});
  if (by_tile.empty())
    for (const auto& tiles : parts_)
      for (const Tile& tile : tiles) by_tile.push_back(kept_by(tile));
  Kept all;
  std::vector<std::uint64_t> counts;
  for (const Kept& of_tile : by_tile) {
    all.add(of_tile);
    counts.push_back(of_tile.touches.size());
  }
  archive("touches", all.touches);
  archive("counts", counts);
  if (table_.slips_in_part()) archive("bands", all.bands);
  if (surface() != nullptr) archive.folder("surface", [&] { walls_[surface_].nodal.columns(archive); });
  if (!archive.reading()) return;
  // All in one part: `find`, which follows, hands out what is touched.
  parts_.assign(1, std::vector<Tile>(counts.size()));
  std::ptrdiff_t next = 0;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    const std::ptrdiff_t begin = next;
    next += static_cast<std::ptrdiff_t>(counts[b]);
    parts_[0][b].loads.resize(walls_.size());
    parts_[0][b].touches.assign(all.touches.begin() + begin, all.touches.begin() + next);
    if (table_.slips_in_part()) parts_[0][b].bands.assign(all.bands.begin() + begin, all.bands.begin() + next);
  }
}

}  // namespace sazare::methods::spheres
