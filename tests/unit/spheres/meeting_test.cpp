#include "sazare/methods/spheres/meeting.hpp"

#include <gtest/gtest.h>

namespace sazare::methods::spheres {
namespace {

/// Every number of every sphere another one; differences of radii and masses are not exact.
state::Spheres some_spheres() {
  state::Spheres spheres;
  for (int n = 0; n < 40; ++n) {
    spheres.add(Vector3(1.0 * n, 2.5 * n + 0.25, -1.0 * n * n), 0.1 + 0.003 * n, 2500 + 7 * n, n % 3);
    spheres.set_motion(spheres.size() - 1, {0.1 * n, 1.0 - n, 0.5 * n * n}, {3.0 * n, -0.5 * n, 11.0 - n});
  }
  return spheres;
}

TEST(meeting, has_both_spheres_of_each_pair_in_its_lane) {
  const state::Spheres spheres = some_spheres();
  const auto first = [](std::size_t lane) { return SphereAt::at(static_cast<Index>((5 * lane + 3) % 40)); };
  const auto second = [](std::size_t lane) { return SphereAt::at(static_cast<Index>((11 * lane + 17) % 40)); };
  const Meeting meeting = meeting_of(spheres.place.data(), first, second);
  const LaneVector spin = spins_of(spheres.spin.data(), first), second_spin = spins_of(spheres.spin.data(), second);
  Lanes a, b;
  for (int lane = 0; lane < lane_count; ++lane) {
    a[lane] = 0.25 * lane;
    b[lane] = 2.0 - lane;
  }
  const LaneVector sum = sum_of_spins(spheres.spin.data(), first, a, second, b);
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto one = static_cast<std::size_t>(first(static_cast<std::size_t>(lane)).place()),
               other = static_cast<std::size_t>(second(static_cast<std::size_t>(lane)).place());
    const auto in_lane = [&](const LaneVector& numbers) { return Vector3(numbers[0][lane], numbers[1][lane], numbers[2][lane]); };
    EXPECT_EQ(in_lane(meeting.apart), spheres.place[other].centre() - spheres.place[one].centre());
    EXPECT_EQ(in_lane(meeting.velocity), spheres.place[other].velocity() - spheres.place[one].velocity());
    EXPECT_EQ(meeting.radius[lane], spheres.place[one].radius);
    EXPECT_EQ(meeting.second_radius[lane], spheres.place[other].radius);
    EXPECT_EQ(meeting.mass[lane], spheres.place[one].mass);
    EXPECT_EQ(meeting.second_mass[lane], spheres.place[other].mass);
    EXPECT_EQ(in_lane(spin), spheres.spin[one].spin());
    EXPECT_EQ(in_lane(second_spin), spheres.spin[other].spin());
    const Vector3 together = 0.25 * lane * spheres.spin[one].spin() + (2.0 - lane) * spheres.spin[other].spin();
    EXPECT_LT((in_lane(sum) - together).norm(), 1e-14 * (1 + together.norm()));
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
