#include "sazare/laws/soil/overlay_pack.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sazare/laws/soil/overlay_plasticity.hpp"

namespace sazare::laws {
namespace {

constexpr Elasticity elastic{4e7, 6e7};

/// Two soils, by turns, and a lane without any.
BackboneCurve curve_of(int lane) { return hyperbolic_curve(4e7, lane % 2 == 0 ? 1e-3 : 4e-4, 1e9, lane % 2 == 0 ? 30 : 12); }

PartsOfPack parts_of_lanes(std::size_t most) {
  PartsOfPack pack;
  pack.share.assign(most, Lanes{});
  pack.yield_strain.assign(most, broadcast(std::numeric_limits<Real>::infinity()));
  for (int lane = 0; lane + 1 < lane_count; ++lane) {
    const auto parts = OverlayModel<4>(elastic, curve_of(lane)).parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      pack.share[i][lane] = parts[i].shear_modulus / elastic.shear_modulus;
      pack.yield_strain[i][lane] = parts[i].yield_strain;
    }
  }
  return pack;
}

/// A path that turns often, in small steps, deviatoric: xx, yy, zz and shear strains.
template <int N>
std::vector<typename OverlayModel<N>::Column> path_of(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<Real> normal;
  std::vector<typename OverlayModel<N>::Column> path;
  typename OverlayModel<N>::Column now = OverlayModel<N>::Column::Zero();
  for (int branch = 0; branch < 12; ++branch) {
    typename OverlayModel<N>::Column way;
    for (Real& part : way) part = normal(generator);
    way.template head<3>().array() -= way.template head<3>().mean();
    way *= 4e-5 / OverlayModel<N>::shear_of(way);
    for (int step = 0; step < 40 + 5 * branch; ++step) path.push_back(now += way);
  }
  return path;
}

/// Parts that were passed over because they could not yield have not yielded.
template <int D>
void expect_the_same_as_looking_at_every_part() {
  constexpr int N = D == 2 ? 4 : 6;
  const PartsOfPack parts = parts_of_lanes(30);
  std::vector<Real> memory(OverlayPack<D>::rows(30) * lane_count, 0);
  std::array<std::vector<typename OverlayModel<N>::Column>, lane_count> paths;
  std::array<std::vector<Real>, lane_count> memories;
  std::array<OverlayModel<N>, lane_count> laws;
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto at = static_cast<std::size_t>(lane);
    paths[at] = path_of<N>(static_cast<unsigned>(lane + 1));
    laws[at] = {elastic, curve_of(lane)};
    memories[at].assign(laws[at].memory_size(), 0);
  }
  typename OverlayPack<D>::Deviator flowed{};
  for (std::size_t step = 0; step < paths[0].size(); ++step) {
    typename OverlayPack<D>::Deviator strain{};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const auto& to = paths[lane][step];
      strain[0][static_cast<int>(lane)] = to[0];
      strain[1][static_cast<int>(lane)] = to[1];
      for (std::size_t k = 2; k < strain.size(); ++k) strain[k][static_cast<int>(lane)] = to[static_cast<int>(k) + 1];
      std::vector<Real> after(memories[lane].size());
      laws[lane].respond(to, memories[lane], after, nullptr);
      memories[lane] = after;
    }
    typename OverlayPack<D>::Deviator flow;
    OverlayPack<D>::advance(parts, strain, LaneMask(~LaneMask{}), memory.data(), flow);
    for (std::size_t k = 0; k < flow.size(); ++k) flowed[k] += flow[k];
  }
  const auto mean = OverlayPack<D>::mean_plastic(memory.data());
  for (std::size_t lane = 0; lane + 1 < lane_count; ++lane) {
    typename OverlayModel<N>::Column expected = OverlayModel<N>::Column::Zero();
    for (std::size_t i = 0; i < laws[lane].parts().size(); ++i) {
      const auto own = Eigen::Map<const typename OverlayModel<N>::Column>(memories[lane].data() + i * N);
      expected += laws[lane].parts()[i].shear_modulus / elastic.shear_modulus * own;
      EXPECT_NEAR(OverlayPack<D>::plastic(memory.data(), i)[2][static_cast<int>(lane)], own[3], 1e-14) << lane << ' ' << i;
    }
    EXPECT_GT(expected.norm(), 1e-4);
    EXPECT_NEAR(mean[0][static_cast<int>(lane)], expected[0], 1e-14);
    EXPECT_NEAR(mean[1][static_cast<int>(lane)], expected[1], 1e-14);
    for (std::size_t k = 2; k < mean.size(); ++k) {
      EXPECT_NEAR(mean[k][static_cast<int>(lane)], expected[static_cast<int>(k) + 1], 1e-14);
      EXPECT_NEAR(flowed[k][static_cast<int>(lane)], expected[static_cast<int>(k) + 1], 1e-14);
    }
  }
  for (const Lanes& number : mean) EXPECT_EQ(number[lane_count - 1], 0);
}

TEST(overlay_pack, does_what_looking_at_every_part_does) {
  expect_the_same_as_looking_at_every_part<2>();
  expect_the_same_as_looking_at_every_part<3>();
}

TEST(overlay_pack, leaves_points_without_a_strain_alone) {
  const PartsOfPack parts = parts_of_lanes(30);
  std::vector<Real> memory(OverlayPack<2>::rows(30) * lane_count, 0);
  LaneMask moves = ~LaneMask{};
  moves[1] = 0;
  OverlayPack<2>::Deviator flow;
  EXPECT_TRUE(OverlayPack<2>::advance(parts, {Lanes{}, Lanes{}, broadcast(2e-3)}, moves, memory.data(), flow));
  EXPECT_GT(flow[2][0], 1e-4);
  EXPECT_EQ(flow[2][1], 0);
  EXPECT_TRUE(OverlayPack<2>::advance(parts, {Lanes{}, Lanes{}, broadcast(2e-3)}, LaneMask(~LaneMask{}), memory.data(), flow));
  EXPECT_GT(flow[2][1], 1e-4);
}

}  // namespace
}  // namespace sazare::laws
