#include "sazare/geometry/plane/outline_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sazare::geometry {
namespace {

using enum OutlineKind;

Outline outline(OutlineKind kind, Real x, Real y, Real half_width, Real half_height, Real angle = 0) {
  return {kind, all_faces, {x, y}, {std::cos(angle), std::sin(angle)}, half_width, half_height};
}

TEST(outline_contact, square_flat_on_square_touches_at_both_ends) {
  const Overlap found = overlap(outline(rectangle, 0, 0, 1, 1), outline(rectangle, 0, 1.9, 1, 1));
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.normal.y(), 1, 1e-15);
  EXPECT_NEAR(found.points[0].depth, 0.1, 1e-14);
  EXPECT_NEAR(std::abs(found.points[0].place.x() - found.points[1].place.x()), 2, 1e-14);
  EXPECT_NEAR(found.share, 1, 1e-14);
}

TEST(outline_contact, shifted_squares_share_a_part_of_their_faces) {
  const Overlap found = overlap(outline(rectangle, 0, 0, 1, 1), outline(rectangle, 0.5, 1.9, 1, 1));
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.share, 0.75, 1e-14);
}

TEST(outline_contact, is_the_same_seen_from_either_side) {
  const Outline one = outline(rectangle, 0, 0, 1, 0.5, 0.2), other = outline(rectangle, 0.3, 1.2, 0.7, 0.7, 0.9);
  const Overlap found = overlap(one, other), back = overlap(other, one);
  ASSERT_EQ(found.count, 1);
  ASSERT_EQ(back.count, 1);
  EXPECT_NEAR((found.normal + back.normal).norm(), 0, 1e-14);
  EXPECT_NEAR(found.points[0].depth, back.points[0].depth, 1e-14);
  EXPECT_NEAR((found.points[0].place - back.points[0].place).norm(), 0, 1e-14);
}

TEST(outline_contact, does_not_change_when_all_is_turned) {
  const auto found_at = [](Real angle) {
    const Real c = std::cos(angle), s = std::sin(angle);
    return overlap(outline(rectangle, 0, 0, 1, 1, angle),
                   outline(rectangle, 0.4 * c - 1.95 * s, 0.4 * s + 1.95 * c, 1, 1, angle + 0.1));
  };
  const Overlap plain = found_at(0);
  ASSERT_GT(plain.count, 0);
  for (const Real angle : {0.7, 1.9, -2.5}) {
    const Overlap found = found_at(angle);
    ASSERT_EQ(found.count, plain.count);
    EXPECT_NEAR(found.points[0].depth, plain.points[0].depth, 1e-13);
  }
}

TEST(outline_contact, corner_on_wall) {
  const Outline floor = outline(wall, 0, 0, 5, 0);
  const Overlap found = overlap(outline(rectangle, 0.3, std::sqrt(2.0) - 0.01, 1, 1, std::numbers::pi / 4), floor);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(found.normal.y(), -1, 1e-15);  // from the square to the wall
  EXPECT_NEAR(found.points[0].depth, 0.01, 1e-14);
  EXPECT_NEAR(found.points[0].place.x(), 0.3, 1e-14);
  EXPECT_EQ(overlap(floor, outline(rectangle, 0, -0.5, 1, 1)).count, 0);   // below the wall
  EXPECT_EQ(overlap(floor, outline(rectangle, 6.5, 0.9, 1, 1)).count, 0);  // beside it
  EXPECT_EQ(overlap(floor, outline(rectangle, 5.5, 0.9, 1, 1)).count, 2);  // over its end
  EXPECT_NEAR(overlap(floor, outline(rectangle, 5.5, 0.9, 1, 1)).share, 0.25, 1e-14);
}

TEST(outline_contact, faces_that_are_covered_do_not_catch) {
  // A square that slides over the joint of two others, deeper into them than its side is beyond the joint.
  Outline sliding = outline(rectangle, 1.0005, 1.99, 1, 1), right = outline(rectangle, 3, 0, 1, 1);
  EXPECT_NEAR(std::abs(overlap(right, sliding).normal.x()), 1, 1e-14);
  right.exposed = all_faces & ~4;
  const Overlap found = overlap(right, sliding);
  EXPECT_NEAR(found.normal.y(), 1, 1e-14);
  EXPECT_NEAR(found.points[0].depth, 0.01, 1e-14);
}

TEST(outline_contact, circles) {
  const Outline ball = outline(circle, 0, 0, 1, 1);
  Overlap found = overlap(ball, outline(circle, 0, 1.9, 1, 1));
  EXPECT_NEAR(found.points[0].depth, 0.1, 1e-14);
  EXPECT_NEAR(found.normal.y(), 1, 1e-14);
  found = overlap(ball, outline(rectangle, 0.3, 1.9, 1, 1));
  EXPECT_NEAR(found.normal.y(), 1, 1e-14);
  EXPECT_NEAR(found.points[0].depth, 0.1, 1e-14);
  found = overlap(ball, outline(rectangle, 1.7, 1.7, 1, 1));  // its corner at (0.7, 0.7)
  EXPECT_NEAR(found.points[0].depth, 1 - 0.7 * std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(found.normal.x(), std::sqrt(0.5), 1e-14);
  found = overlap(ball, outline(wall, 0, -0.95, 5, 0));
  EXPECT_NEAR(found.normal.y(), -1, 1e-14);
  EXPECT_NEAR(found.points[0].depth, 0.05, 1e-14);
  EXPECT_EQ(overlap(ball, outline(rectangle, 2.5, 0, 1, 1)).count, 0);
}

}  // namespace
}  // namespace sazare::geometry
