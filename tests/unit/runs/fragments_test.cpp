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
  fragment.mass = 2500 * volume;
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

TEST(PassingSize, WithoutPiecesIsNoNumber) { EXPECT_TRUE(std::isnan(passing_size({}, 0.5))); }

TEST(PassingSize, CountsMassAndNotVolume) {
  std::vector<Fragment> pieces = {piece(0.6), piece(0.3), piece(0.1)};
  pieces[2].mass = 2500 * 0.9;  // now half of the mass is in it
  EXPECT_NEAR(passing_size(pieces, 0.5), pieces[2].size, 1e-14);
}

/// Four pieces, one element each, of which the first is the largest; they are at rest.
struct Pieces {
  FragmentMap map{4, {0, 1, 2, 3}};
  std::vector<Fragment> largest_first = {piece(0.5), piece(0.3), piece(0.2), piece(0.1)};

  explicit Pieces(const std::array<Real, 4>& thrown) {
    for (std::size_t i = 0; i < 4; ++i) {
      largest_first[i].number = static_cast<Index>(i);
      largest_first[i].throw_distance = thrown[i];
    }
  }
  std::vector<bool> staying(std::vector<Index> anchored) {
    mark_staying(map, anchored, largest_first);
    std::vector<bool> stay;
    for (const Fragment& fragment : largest_first) stay.push_back(fragment.stays);
    return stay;
  }
};

TEST(Staying, AreThoseThatHangOnABoundary) {
  EXPECT_EQ(Pieces({1, 1, 1, 1}).staying({2}), (std::vector<bool>{false, false, true, false}));
}

TEST(Staying, IsTheLargestWhereItHardlyMoves) {
  // By mass the others have moved (0.3 x 1 + 0.2 x 2 + 0.1 x 5) / 0.6 = 2: half of it is 1.
  EXPECT_EQ(Pieces({0.99, 1, 2, 5}).staying({}), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(Pieces({1.01, 1, 2, 5}).staying({}), (std::vector<bool>{false, false, false, false}));
}

TEST(Staying, IsABodyThatIsWhole) {
  FragmentMap map{1, {0, 0}};
  std::vector<Fragment> whole = {piece(1)};
  whole[0].throw_distance = 3;
  mark_staying(map, {}, whole);
  EXPECT_TRUE(whole[0].stays);
  EXPECT_TRUE(detached(whole).empty());
}

TEST(Staying, DetachedAreTheOthersInTheirOrder) {
  Pieces pieces({0, 1, 2, 5});
  pieces.staying({2});
  const std::vector<Fragment> loose = detached(pieces.largest_first);
  ASSERT_EQ(loose.size(), 2u);
  EXPECT_EQ(loose[0].number, 1);
  EXPECT_EQ(loose[1].number, 3);
}

TEST(Staying, ElementsAreAnchoredByLocksAlongAllAxesAndByFacesThatHold) {
  BlocksModel model = test::block_model(test::block_case());
  const auto& bodies = model.simulation->bodies();
  cases::BlocksCase blocks;
  EXPECT_TRUE(anchored_elements(blocks, nullptr, bodies).empty());
  state::Bodies<3> locked = bodies;
  locked.locks[3].translation = 7;
  locked.locks[4].translation = 3;
  EXPECT_EQ(anchored_elements(blocks, nullptr, locked), std::vector<Index>{3});
  std::vector<methods::blocks::OuterFace> faces(3);
  for (std::size_t i = 0; i < 3; ++i) {
    faces[i].body = static_cast<Index>(6 - 2 * i);
    faces[i].boundary = static_cast<Index>(i);
    faces[i].springs.corner_area = 1;
    for (auto& corner : faces[i].springs.corners) corner = Vector3::Zero();
    faces[i].normal = Vector3::UnitX();
  }
  const methods::blocks::OuterFaces outer(faces, std::vector<methods::blocks::MovingGround>(3), bodies);
  blocks.boundaries.resize(3);
  blocks.boundaries[0].kind = cases::BoundaryKind::absorbing;
  blocks.boundaries[1].kind = cases::BoundaryKind::frictionless;
  blocks.boundaries[2].kind = cases::BoundaryKind::prescribed;
  EXPECT_EQ(anchored_elements(blocks, &outer, locked), (std::vector<Index>{2, 3, 6}));
}

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
  const auto pieces = measure_fragments(find_fragments(bodies.size(), *model.joints), model.mesh, bodies, moved, bodies.start);
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
  const auto pieces = measure_fragments(find_fragments(bodies.size(), *model.joints), model.mesh, bodies,
                                        model.simulation->snapshot(), bodies.start);
  for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_GE(pieces[i - 1].volume, pieces[i].volume);
}

}  // namespace
}  // namespace sazare::runs
