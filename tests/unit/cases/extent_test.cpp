#include "sazare/cases/extent.hpp"

#include <gtest/gtest.h>

#include <array>

#include "case_folder.hpp"

namespace sazare::cases {
namespace {

const std::array<Vector3, 3> corners{Vector3(1, 2, 0), Vector3(-1, 5, 0), Vector3(0.5, 3, 0)};

TEST(extent, is_the_box_around_all_points) {
  const Extent extent = extent_of(corners);
  EXPECT_EQ(extent.low, Vector3(-1, 2, 0));
  EXPECT_EQ(extent.high, Vector3(1, 5, 0));
  EXPECT_EQ(explain_size(extent), "  size        2 x 3 m, from (-1, 2, 0) to (1, 5, 0) m\n");
  EXPECT_EQ(extent_of({}).size(), Vector3::Zero());
}

TEST(extent, of_a_mesh_in_millimetres_is_warned_of) {
  const CaseFolder folder;
  const CaseFile source = folder.read(smallest_case());
  Extent extent = extent_of(corners);
  EXPECT_EQ(warn_of_size(source, extent), "");
  extent.high *= 1000;
  const std::string words = warn_of_size(source, extent);
  EXPECT_NE(words.find("the mesh is 4998 m long"), std::string::npos) << words;
  EXPECT_NE(words.find("set scale = 0.001 in [mesh]: it is then 4.998 m long"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::cases
