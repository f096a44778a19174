#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/blocks/run/block_fragments.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

Fragment piece(Real volume) {
  Fragment fragment;
  fragment.volume = volume;
  fragment.size = std::cbrt(6 * volume / std::numbers::pi);
  return fragment;
}

TEST(PassingSize, OfEqualPiecesIsTheirSize) {
  const std::vector<Fragment> pieces(4, piece(0.25));
  EXPECT_DOUBLE_EQ(passing_size(pieces, 0.5), pieces[0].size);
  EXPECT_DOUBLE_EQ(passing_size(pieces, 0.8), pieces[0].size);
}

TEST(PassingSize, LiesOnTheLineBetweenTwoSizes) {
  const std::vector<Fragment> pieces = {piece(0.6), piece(0.3), piece(0.1)};
  // 40 % of the volume is in the two smaller ones, all of it in the three.
  const Real expected = pieces[1].size + (pieces[0].size - pieces[1].size) * (0.5 - 0.4) / 0.6;
  EXPECT_NEAR(passing_size(pieces, 0.5), expected, 1e-14);
}

TEST(PassingSize, OfOnePieceIsItsSize) {
  const std::vector<Fragment> one = {piece(1)};
  EXPECT_DOUBLE_EQ(passing_size(one, 0.5), one[0].size);
}

TEST(PassingSize, WithoutPiecesIsZero) { EXPECT_EQ(passing_size({}, 0.5), 0); }

TEST(Fragments, AnUnbrokenBodyIsOne) {
  const BlocksModel model = test::block_model(test::block_case());
  const Index elements = model.simulation->bodies().size();
  const FragmentMap map = find_fragments(elements, *model.joints);
  EXPECT_EQ(map.count, 1);
  EXPECT_EQ(map.of_element, std::vector<Index>(static_cast<std::size_t>(elements), 0));
}

TEST(Fragments, WithoutJointsEveryElementIsOne) {
  const BlocksModel model = test::block_model(test::loose_case());
  EXPECT_EQ(find_fragments(model.simulation->bodies().size(), *model.joints).count, model.simulation->bodies().size());
}

TEST(Fragments, OfAnUnbrokenBodyHaveItsMassAndVolume) {
  BlocksModel model = test::block_model(test::block_case());
  const auto& bodies = model.simulation->bodies();
  levels::Snapshot<3> moved = model.simulation->snapshot();
  for (auto& pose : moved.pose) pose.position += Vector3(3, 0, 4);
  for (auto& velocity : moved.velocity) velocity = Vector3(1, 2, 3);
  const auto pieces = measure_fragments(find_fragments(bodies.size(), *model.joints), model.mesh, bodies, moved);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(pieces[0].volume, 0.4 * 0.3 * 0.3, 1e-12);
  EXPECT_NEAR(pieces[0].mass, 2390 * 0.4 * 0.3 * 0.3, 1e-9);
  EXPECT_NEAR(pieces[0].throw_distance, 5, 1e-12);
  EXPECT_LT((pieces[0].center - Vector3(3.2, 0.15, 4.15)).norm(), 1e-12);
  EXPECT_LT((pieces[0].velocity - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(pieces[0].elements, bodies.size());
}

TEST(Fragments, AreSortedLargestFirst) {
  BlocksModel model = test::block_model(test::loose_case());
  const auto& bodies = model.simulation->bodies();
  const auto pieces =
      measure_fragments(find_fragments(bodies.size(), *model.joints), model.mesh, bodies, model.simulation->snapshot());
  for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_GE(pieces[i - 1].volume, pieces[i].volume);
}

}  // namespace
}  // namespace sazare::runs
