#include "sazare/methods/spheres/plane_contacts.hpp"

#include <algorithm>
#include <cstring>

#include "sazare/core/lane_records.hpp"
#include "sazare/methods/spheres/load_rows.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr Real tiny = 1e-30;  // an overlap at which nothing of the law fails [m]

template <class Numbers>
Numbers where(const LaneMask& mask, const Numbers& numbers) {
  return select(mask, numbers, Numbers{});
}

/// Where a plane is and how it moves, in every lane.
struct PlaneInLanes {
  LaneVector point, normal, pivot, velocity, spin;

  PlaneInLanes(const Wall& wall, const WallPose& pose)
      : point(broadcast(pose.out(wall.point))),
        normal(broadcast(pose.direction_out(wall.normal))),
        pivot(broadcast(pose.pivot + pose.shift)),
        velocity(broadcast(pose.velocity)),
        spin(broadcast(pose.spin)) {}
};

template <class Law, bool rolls>
class PlaneKernel {
public:
  explicit PlaneKernel(const PlaneTask& task)
      : task_(task), plane_(task.wall, task.pose), box_(task.spheres.box), step_(broadcast(task.step)) {
    const auto& one = task.table.of(0, task.wall.material);
    constants_ = {
        broadcast(one.normal),   broadcast(one.tangential), broadcast(one.normal_damping), broadcast(one.tangential_damping),
        broadcast(one.friction), broadcast(one.rolling),    broadcast(one.twisting),       broadcast(one.adhesion)};
  }

  [[gnu::flatten]] void evaluate(PlaneRow& row) {
    for (std::size_t n = 0; n < row.group_count(); ++n) {
      AtPlane meeting;
      const bool touches = meet(row, n, meeting);
      if constexpr (Law::adheres) note_parted(row, n, meeting.touch);
      if (touches)
        press(row, n, meeting);
      else
        forget(row, n);
    }
  }

  ContactSums sums() const {
    return {.elastic = sums_[of_elastic],
            .sliding = sums_[of_sliding],
            .dashpot_work = task_.step * sums_[of_dashpots] + parting_loss_,
            .sliding_work = task_.step * sums_[of_sliders],
            .contacts = touching_};
  }
  WallLoad on_plane() const {
    return {-Vector3(sums_[of_pushes], sums_[of_pushes + 1], sums_[of_pushes + 2]),
            {sums_[of_moments], sums_[of_moments + 1], sums_[of_moments + 2]},
            task_.step * sums_[of_power]};
  }

private:
  /// Some spheres at the plane.
  struct AtPlane {
    LaneMask touch;  ///< those that count
    laws::ContactMotion<Lanes> at;
    Lanes radius, arm;          ///< from the centres to where they touch [m]
    LaneVector foot, velocity;  ///< of the plane there: from its pivot [m], and [m/s]
  };

  /// Where and how fast a group meets the plane. Returns whether any of it touches; if none does nothing more is known.
  bool meet(PlaneRow& row, std::size_t n, AtPlane& meeting) {
    const Index* const sphere = row.group(n).sphere.data();
    const state::SpherePlace* const places = task_.spheres.place.data();
    const state::SphereSpin* const spins = task_.spheres.spin.data();
    const auto place = load_quads([&](std::size_t lane) { return &places[sphere[lane]].x; });
    const LaneVector centre = box_.wrapped({place[0], place[1], place[2]});
    const Lanes radius = place[3], overlap = radius - dot(centre - plane_.point, plane_.normal);
    meeting.touch = overlap > 0.0;
    if constexpr (Law::adheres) {
      if (task_.table.materials > 1) look_up(row.group(n));
      meeting.touch |= (row.touching(n) > 0.0) & Law::holds(constants_, overlap, laws::Reduced<Lanes>::alone(radius));
    }
    meeting.touch &= lane_numbers() < static_cast<std::int64_t>(row.size() - n * lane_count);
    if (!any(meeting.touch)) return false;
    const auto motion = load_quads([&](std::size_t lane) { return &places[sphere[lane]].vx; }),
               turn = load_quads([&](std::size_t lane) { return &spins[sphere[lane]].x; });
    const LaneVector spin{turn[0], turn[1], turn[2]};
    laws::ContactMotion<Lanes>& at = meeting.at;
    at.overlap = Law::adheres ? select(meeting.touch, overlap, broadcast(tiny)) : maximum(overlap, broadcast(tiny));
    at.radius = laws::Reduced<Lanes>::alone(radius);
    at.mass = laws::Reduced<Lanes>::alone(motion[3]);
    at.normal = plane_.normal;
    at.step = step_;
    at.tilt = step_ * cross(plane_.spin, plane_.normal);
    at.turn = step_ * dot(plane_.spin, plane_.normal);
    meeting.radius = radius;
    meeting.arm = radius - 0.5 * at.overlap;
    meeting.foot = subtract_product(meeting.arm, plane_.normal, centre) - plane_.pivot;
    meeting.velocity = plane_.velocity + cross(plane_.spin, meeting.foot);
    at.velocity = subtract_product(meeting.arm, cross(spin, plane_.normal), {motion[0], motion[1], motion[2]}) - meeting.velocity;
    if constexpr (rolls) {
      const LaneVector turns = spin - plane_.spin;
      at.rolling = radius * cross(turns, plane_.normal);
      at.twisting = radius * dot(turns, plane_.normal);
    }
    return true;
  }

  /// The law, whose forces go to the loads.
  void press(PlaneRow& row, std::size_t n, const AtPlane& meeting) {
    if (!Law::adheres && task_.table.materials > 1) look_up(row.group(n));
    laws::ContactMemory<Lanes> memory;
    memory.sliding = row.group(n).sliding;
    if constexpr (rolls) {
      memory.rolling = row.turning(n).rolling;
      memory.twisting = row.turning(n).twisting;
    }
    laws::SlipBands<Lanes>* bands = nullptr;
    if constexpr (Law::slips_in_part) bands = &row.bands_of_group(n);
    const auto force = laws::contact_force<Law, rolls>(constants_, meeting.at, memory, bands);
    if constexpr (Law::slips_in_part)
      keep_where(meeting.touch, *bands);
    else
      row.group(n).sliding = where(meeting.touch, memory.sliding);
    LaneVector turning{};
    if constexpr (rolls) {
      row.turning(n) = {where(meeting.touch, memory.rolling), where(meeting.touch, memory.twisting)};
      turning = where(meeting.touch,
                      Lanes(-meeting.radius) * add_product(force.twisting, plane_.normal, cross(plane_.normal, force.rolling)));
    }
    const LaneVector push = where(meeting.touch, add_product(force.normal, plane_.normal, force.friction));
    deliver(row.group(n), meeting, push, turning);
    const LaneVector about_pivot = turning - cross(meeting.foot, push);
    add_up(meeting.touch, {push[0], push[1], push[2], about_pivot[0], about_pivot[1], about_pivot[2],
                           dot(push, meeting.velocity) - dot(turning, plane_.spin), force.elastic_energy, force.sliding_energy,
                           force.dashpot_power, force.sliding_power});
  }

  /// What is summed over the spheres that touch: on them and, about its pivot, on the plane.
  enum Sum : std::size_t { of_pushes, of_moments = 3, of_power = 6, of_elastic, of_sliding, of_dashpots, of_sliders, sum_count };

  /// One sphere after the other: in which lane one stands depends on who else is near, which a run that is resumed finds anew.
  void add_up(const LaneMask& touch, const std::array<Lanes, sum_count>& numbers) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (touch[lane] == 0) continue;
      ++touching_;
      for (std::size_t n = 0; n < sum_count; ++n) sums_[n] += numbers[n][lane];
    }
  }

  /// Keeps which spheres touch now, and adds up the energy dissipated by those that have parted.
  void note_parted(PlaneRow& row, std::size_t n, const LaneMask& touch) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (touch[lane] != 0 || !(row.touching(n)[lane] > 0)) continue;
      const auto sphere = static_cast<std::size_t>(row.group(n).sphere[static_cast<std::size_t>(lane)]);
      parting_loss_ += task_.table.parting_loss(static_cast<Index>(task_.spheres.spin[sphere].material), task_.wall.material,
                                                task_.spheres.place[sphere].radius);
    }
    row.touching(n) = where(touch, broadcast(1));
  }

  /// What does not touch forgets its bands.
  static void keep_where(const LaneMask& touch, laws::SlipBands<Lanes>& bands) {
    for (LaneVector& stretch : bands.stretch) stretch = where(touch, stretch);
    bands.width = where(touch, bands.width);
    bands.inner = where(touch, bands.inner);
  }

  static void forget(PlaneRow& row, std::size_t n) {
    row.group(n).sliding = {};
    if constexpr (Law::slips_in_part) row.bands_of_group(n) = {};
    if constexpr (rolls) row.turning(n) = {};
  }

  /// The constants of spheres of several materials.
  [[gnu::noinline]] void look_up(const PlaneRow::Group& group) {
    std::array<const Real*, lane_count> from;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto material = static_cast<Index>(task_.spheres.spin[static_cast<std::size_t>(group.sphere[lane])].material);
      from[lane] = task_.table.numbers(material * task_.table.materials + task_.wall.material);
    }
    const auto numbers = load_quads([&](std::size_t lane) { return from[lane]; }),
               more = load_quads([&](std::size_t lane) { return from[lane] + 4; });
    constants_ = {numbers[0], numbers[1], numbers[2], numbers[3], more[0], more[1], more[2], more[3]};
  }

  /// Forces and the moments that resist turning, to the spheres.
  void deliver(const PlaneRow::Group& group, const AtPlane& meeting, const LaneVector& force, const LaneVector& turning) {
    const LoadRows rows(force, subtract_product(meeting.arm, cross(plane_.normal, force), LaneVector{} - turning));
    state::SphereLoad* const loads = task_.own - task_.own_begin;
    for (std::size_t lane = 0; lane < lane_count; ++lane) rows.add(lane, &loads[group.sphere[lane]]);
  }

  const PlaneTask task_;
  PlaneInLanes plane_;
  BoxLanes<Lanes> box_;
  Lanes step_;
  laws::ContactConstants<Lanes> constants_;
  std::array<Real, sum_count> sums_{};
  Real parting_loss_ = 0;  ///< [J]
  std::int64_t touching_ = 0;
};

template <class Law, bool rolls>
ContactSums evaluate_as(PlaneRow& row, const PlaneTask& task, WallLoad& on_plane) {
  PlaneKernel<Law, rolls> kernel(task);
  kernel.evaluate(row);
  on_plane += kernel.on_plane();
  return kernel.sums();
}

}  // namespace

ContactSums evaluate_plane(PlaneRow& row, const PlaneTask& task, WallLoad& on_plane) {
  return visit_law(task.table,
                   [&]<class Law, class Rolls>(Law, Rolls) { return evaluate_as<Law, Rolls::value>(row, task, on_plane); });
}

void PlaneRow::add(Index sphere, const Remembered& remembered, bool adheres) {
  const std::size_t lane = size_ % lane_count;
  if (lane == 0) {
    groups_.emplace_back();
    if (remembered.rolls) turning_.emplace_back();
    if (remembered.bands) bands_.emplace_back();
    if (adheres) touching_.emplace_back();
  }
  auto& spheres = groups_.back().sphere;
  std::fill(spheres.begin() + static_cast<std::ptrdiff_t>(lane), spheres.end(), sphere);
  ++size_;
}

laws::ContactMemory<Real> PlaneRow::memory(std::size_t n) const {
  const auto lane = static_cast<int>(n % lane_count);
  const auto get = [lane](const LaneVector& of) { return Vector3(of[0][lane], of[1][lane], of[2][lane]); };
  const Vector3 sliding = get(groups_[n / lane_count].sliding);
  if (turning_.empty()) return {sliding, Vector3::Zero(), 0};
  const Turning& turning = turning_[n / lane_count];
  return {sliding, get(turning.rolling), turning.twisting[lane]};
}

laws::SlipBands<Real> PlaneRow::bands(std::size_t n) const {
  laws::SlipBands<Real> alone;
  if (bands_.empty()) return alone;
  visit_numbers(bands_[n / lane_count], alone,
                [lane = n % lane_count](const Lanes& in_lanes, Real& number) { number = in_lanes[lane]; });
  return alone;
}

bool PlaneRow::remembers(std::size_t n) const {
  if (!touching_.empty()) return touching_[n / lane_count][static_cast<int>(n % lane_count)] > 0;
  if (!bands_.empty()) return bands_[n / lane_count].width[static_cast<int>(n % lane_count)] > 0;
  const laws::ContactMemory<Real> memory = this->memory(n), nothing;
  return std::memcmp(&memory, &nothing, sizeof(memory)) != 0;
}

void PlaneRow::remember(Index sphere, const laws::ContactMemory<Real>& memory, const laws::SlipBands<Real>& bands) {
  const auto next = std::ranges::upper_bound(groups_, sphere, {}, [](const Group& group) { return group.sphere.front(); });
  if (next == groups_.begin()) return;
  Group& group = *(next - 1);
  const auto found = std::ranges::find(group.sphere, sphere);
  if (found == group.sphere.end()) return;
  const auto lane = static_cast<int>(found - group.sphere.begin());
  const auto put = [lane](LaneVector& numbers, const Vector3& value) {
    for (int axis = 0; axis < 3; ++axis) numbers[axis][lane] = value[axis];
  };
  put(group.sliding, memory.sliding);
  const auto number = static_cast<std::size_t>(next - 1 - groups_.begin());
  if (!touching_.empty()) touching_[number][lane] = 1;
  if (!bands_.empty())
    visit_numbers(bands_[number], bands, [lane](Lanes& in_lanes, const Real& value) { in_lanes[lane] = value; });
  if (turning_.empty()) return;
  Turning& turning = turning_[number];
  put(turning.rolling, memory.rolling);
  turning.twisting[lane] = memory.twisting;
}

}  // namespace sazare::methods::spheres
