#include "sazare/methods/spheres/wall_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr Real same_plane = 1e-6;     // of a radius: a point that little before a tangent plane lies in it
constexpr Real same_direction = 0.9;  // cosine between the normals of one contact at two steps

}  // namespace

WallContacts::WallContacts(ContactTable table, std::vector<Wall> walls, Real reach)
    : table_(std::move(table)), walls_(std::move(walls)), reach_(reach) {
  for (const Wall& wall : walls_) grids_.emplace_back(wall.triangles, reach);
  poses_.resize(walls_.size());
  move(0);
}

void WallContacts::add_surface(Wall wall) {
  surface_ = walls_.size();
  walls_.push_back(std::move(wall));
  grids_.emplace_back(std::span<const geometry::Triangle>{}, reach_);  // made anew by every search
  poses_.emplace_back();
}

Real WallContacts::lead(Real time, Real step, std::vector<Vector3> from, std::vector<Vector3> with) {
  return walls_[surface_].nodal.lead(time, step, std::move(from), std::move(with));
}

void WallContacts::book_surface(Real step) {
  if (surface() == nullptr) return;
  std::vector<terms::NodeForce> forces;
  for (const auto& blocks : parts_)
    for (const Block& block : blocks) forces.insert(forces.end(), block.on_nodes.begin(), block.on_nodes.end());
  walls_[surface_].nodal.book(forces, step);
}

void WallContacts::move(Real time) {
  if (!stand_still_) time_ = time;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    poses_[w] = WallPose::of(walls_[w].motion, time_);
    if (stand_still_) poses_[w].velocity = poses_[w].spin = Vector3::Zero();
  }
}

/// Of all parts, by part and sphere.
std::vector<WallContacts::Touch> WallContacts::touches() const {
  std::vector<Touch> all;
  for (const auto& blocks : parts_)
    for (const Block& block : blocks) all.insert(all.end(), block.touches.begin(), block.touches.end());
  return all;
}

void WallContacts::find(const state::Spheres& spheres, Real time, Real margin, std::span<const Index> places_before,
                        const Parts& parts) {
  move(time);
  if (surface() != nullptr) {
    std::vector<geometry::Triangle> now;
    for (std::size_t face = 0; face < surface()->face_count(); ++face) now.push_back(surface()->corners(face, time));
    grids_[surface_] = geometry::TriangleGrid(now, reach_);
  }
  std::vector<Touch> kept = touches();
  if (!places_before.empty()) {
    std::vector<Index> place(places_before.size());
    for (std::size_t n = 0; n < place.size(); ++n) place[static_cast<std::size_t>(places_before[n])] = static_cast<Index>(n);
    for (Touch& touch : kept) touch.sphere = place[static_cast<std::size_t>(touch.sphere)];
    std::ranges::stable_sort(kept, {}, &Touch::sphere);
  }
  const std::size_t block_count = (spheres.size() + neighbors::block_size - 1) / neighbors::block_size;
  Block empty;
  empty.loads.resize(walls_.size());
  parts_.assign(parts.count, std::vector<Block>(block_count, empty));
  const auto block_of = [&](std::size_t sphere) -> Block& {
    const std::size_t part = parts.of.empty() ? 0 : static_cast<std::size_t>(parts.of[sphere]);
    return parts_[part][sphere / neighbors::block_size];
  };
  for (const Touch& touch : kept) block_of(static_cast<std::size_t>(touch.sphere)).touches.push_back(touch);
  parallel::parallel_for(block_count, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * neighbors::block_size; i < std::min(end * neighbors::block_size, spheres.size()); ++i) {
      const state::SpherePlace& place = spheres.place[i];
      auto& near = block_of(i).near;
      const Real reach = place.radius + margin;
      for (std::size_t w = 0; w < walls_.size(); ++w) {
        const Wall& wall = walls_[w];
        const Vector3 centre = poses_[w].into(spheres.box.wrapped(place.centre()));
        const auto sphere = static_cast<Index>(i), number = static_cast<Index>(w);
        if (wall.is_plane()) {
          if ((centre - wall.point).dot(wall.normal) < reach) near.push_back({sphere, number, -1});
          continue;
        }
        for (const std::int32_t t : grids_[w].near(centre))
          if ((geometry::nearest_point(triangle(w, t), centre) - centre).norm() < reach) near.push_back({sphere, number, t});
      }
    }
  });
}

/// A triangle of a wall, in the frame of its pose.
geometry::Triangle WallContacts::triangle(std::size_t wall, std::int32_t number) const {
  const auto face = static_cast<std::size_t>(number);
  return wall == surface_ ? walls_[wall].nodal.corners(face, time_) : walls_[wall].triangles[face];
}

/// A rigid wall is touched in the middle of the overlap; a face with nodes on itself, where its shape functions are known.
WallContacts::Ground WallContacts::ground_at(const Point& point, const Vector3& centre, Real radius) const {
  const auto w = static_cast<std::size_t>(point.wall);
  Ground ground;
  if (w == surface_) {
    ground.arm = radius - point.overlap;
    ground.place = centre - ground.arm * point.normal;
    ground.face = walls_[w].nodal.point(static_cast<std::size_t>(point.triangle), time_, ground.place);
    ground.velocity = ground.face->velocity();
    ground.spin = table_.rolls ? ground.face->spin() : Vector3(Vector3::Zero());
    return ground;
  }
  ground.arm = radius - 0.5 * point.overlap;
  ground.place = centre - ground.arm * point.normal;
  ground.velocity = poses_[w].velocity_at(ground.place);
  ground.spin = poses_[w].spin;
  return ground;
}

void WallContacts::find_touches(const state::SpherePlace& place, std::span<const Near> near, std::vector<Point>& points) const {
  points.clear();
  for (const Near& one : near) {
    const auto w = static_cast<std::size_t>(one.wall);
    const Wall& wall = walls_[w];
    const Vector3 centre = poses_[w].into(place.centre());
    if (wall.is_plane()) {
      const Real distance = (centre - wall.point).dot(wall.normal);
      if (distance < place.radius)
        points.push_back({one.wall, -1, place.radius - distance, centre - distance * wall.normal, wall.normal});
      continue;
    }
    const Vector3 foot = geometry::nearest_point(triangle(w, one.triangle), centre);
    const Real distance = (centre - foot).norm();
    if (distance < place.radius && distance > 0)
      points.push_back({one.wall, one.triangle, place.radius - distance, foot, (centre - foot) / distance});
  }
  if (points.size() > 1) keep_those_in_front(place.radius, points);
  for (Point& point : points) point.normal = poses_[static_cast<std::size_t>(point.wall)].direction_out(point.normal);
}

/// Of the points of a wall the deepest one, and those in front of the tangent planes of the points kept before.
void WallContacts::keep_those_in_front(Real radius, std::vector<Point>& points) {
  std::ranges::stable_sort(
      points, [](const Point& a, const Point& b) { return a.wall != b.wall ? a.wall < b.wall : a.overlap > b.overlap; });
  std::size_t kept = 0;
  for (const Point& point : points) {
    const bool counts = std::all_of(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(kept), [&](const Point& before) {
      return before.wall != point.wall || (point.place - before.place).dot(before.normal) > same_plane * radius;
    });
    if (counts) points[kept++] = point;
  }
  points.resize(kept);
}

template <laws::ContactModel model, bool rolls>
ContactSums WallContacts::push(const state::Spheres& spheres, const Point& point, Touch& touch, Real step, Block& block,
                               state::SphereLoad& load) const {
  const auto i = static_cast<std::size_t>(touch.sphere), w = static_cast<std::size_t>(point.wall);
  const state::SpherePlace& place = spheres.place[i];
  const Vector3 centre = spheres.box.wrapped(place.centre()), spin = spheres.spin[i].spin();
  const Ground ground = ground_at(point, centre, place.radius);
  laws::ContactMotion<Real> at;
  at.overlap = point.overlap;
  at.radius = laws::Reduced<Real>::alone(place.radius);
  at.mass = laws::Reduced<Real>::alone(place.mass);
  at.normal = triple(point.normal);
  at.velocity = triple(place.velocity() - ground.arm * spin.cross(point.normal) - ground.velocity);
  if constexpr (rolls) at.rolling = triple(Vector3(place.radius * (spin - ground.spin).cross(point.normal)));
  at.step = step;
  laws::ContactMemory<Real> memory{triple(touch.sliding), triple(touch.rolling)};
  const auto& constants = table_.of(static_cast<Index>(spheres.spin[i].material), walls_[w].material);
  const auto force = laws::contact_force<model, rolls>(constants, at, memory);
  touch.sliding = vector(memory.sliding);
  touch.rolling = vector(memory.rolling);
  const Vector3 push = force.normal * point.normal + vector(force.friction);
  Vector3 moment = -ground.arm * point.normal.cross(push), rolling_moment = Vector3::Zero();
  if constexpr (rolls) {
    rolling_moment = -place.radius * point.normal.cross(vector(force.rolling));
    moment -= rolling_moment;
  }
  load.fx += push.x();
  load.fy += push.y();
  load.fz += push.z();
  load.mx += moment.x();
  load.my += moment.y();
  load.mz += moment.z();
  const Vector3 foot = ground.place - poses_[w].pivot - poses_[w].shift;
  block.loads[w] +=
      {-push, rolling_moment - foot.cross(push), step * (push.dot(ground.velocity) - rolling_moment.dot(ground.spin))};
  if (ground.face) {
    const auto forces = ground.face->on_corners(-push, rolling_moment);
    for (std::size_t k = 0; k < 3; ++k) block.on_nodes.push_back({ground.face->nodes[k], forces[k]});
  }
  return {force.elastic_energy, force.sliding_energy, step * force.dashpot_power, step * force.sliding_power, 1};
}

WallContacts::Push WallContacts::push_of_table() const {
  using enum laws::ContactModel;
  if (table_.model == hertz) return table_.rolls ? &WallContacts::push<hertz, true> : &WallContacts::push<hertz, false>;
  return table_.rolls ? &WallContacts::push<linear, true> : &WallContacts::push<linear, false>;
}

ContactSums WallContacts::evaluate(const state::Spheres& spheres, const Task& task) {
  ContactSums sums;
  Block& block = parts_[task.part][task.block];
  std::swap(block.before, block.touches);
  block.touches.clear();
  std::fill(block.loads.begin(), block.loads.end(), WallLoad{});
  block.on_nodes.clear();
  const Push push_one = push_of_table();
  std::vector<Point> points;
  auto remembered = block.before.begin();
  for (auto from = block.near.begin(); from != block.near.end();) {
    const Index sphere = from->sphere;
    const auto to = std::find_if(from, block.near.end(), [&](const Near& one) { return one.sphere != sphere; });
    state::SpherePlace place = spheres.place[static_cast<std::size_t>(sphere)];
    if (spheres.box.repeats()) {
      const Vector3 within = spheres.box.wrapped(place.centre());
      place.x = within.x();
      place.y = within.y();
      place.z = within.z();
    }
    find_touches(place, {from, to}, points);
    from = to;
    while (remembered != block.before.end() && remembered->sphere < sphere) ++remembered;
    for (const Point& point : points) {
      Touch touch{sphere, point.wall, point.normal, Vector3::Zero(), Vector3::Zero()};
      for (auto old = remembered; old != block.before.end() && old->sphere == sphere; ++old)
        if (old->wall == point.wall && old->normal.dot(point.normal) > same_direction) {
          touch.sliding = old->sliding;
          touch.rolling = old->rolling;
          old->wall = -1;  // each goes on once
          break;
        }
      state::SphereLoad& load = task.own[static_cast<std::size_t>(sphere) - task.block * neighbors::block_size];
      sums += (this->*push_one)(spheres, point, touch, task.step, block, load);
      block.touches.push_back(touch);
    }
  }
  return sums;
}

std::vector<WallLoad> WallContacts::loads(std::size_t part) const {
  std::vector<WallLoad> total(walls_.size());
  if (part >= parts_.size()) return total;
  for (const Block& block : parts_[part])
    for (std::size_t w = 0; w < total.size(); ++w) total[w] += block.loads[w];
  return total;
}

std::vector<WallLoad> WallContacts::loads() const {
  std::vector<WallLoad> total = loads(0);
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    const std::vector<WallLoad> more = loads(part);
    for (std::size_t w = 0; w < total.size(); ++w) total[w] += more[w];
  }
  return total;
}

Real WallContacts::largest_speed(Real radius) const {
  Real largest = 0;
  for (const WallPose& pose : poses_) largest = std::max(largest, pose.velocity.norm() + pose.spin.norm() * radius);
  if (surface() != nullptr) largest = std::max(largest, surface()->largest_speed());
  return largest;
}

void WallContacts::columns(Archive& archive) {
  std::vector<Touch> all = touches();
  std::vector<std::uint64_t> counts;
  for (const auto& blocks : parts_)
    for (const Block& block : blocks) counts.push_back(block.touches.size());
  archive("touches", all);
  archive("counts", counts);
  if (surface() != nullptr) archive.folder("surface", [&] { walls_[surface_].nodal.columns(archive); });
  if (!archive.reading()) return;
  // All in one part: `find`, which follows, hands out what is touched.
  parts_.assign(1, std::vector<Block>(counts.size()));
  auto next = all.begin();
  for (std::size_t b = 0; b < counts.size(); ++b) {
    parts_[0][b].loads.resize(walls_.size());
    parts_[0][b].touches.assign(next, next + static_cast<std::ptrdiff_t>(counts[b]));
    next += static_cast<std::ptrdiff_t>(counts[b]);
  }
}

}  // namespace sazare::methods::spheres
