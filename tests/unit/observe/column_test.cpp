#include "sazare/observe/column.hpp"

#include <gtest/gtest.h>

namespace sazare::observe {
namespace {

using Titles = std::vector<std::string>;
constexpr std::array columns = {Column{"time", "s", ""}, Column{"part", "", "words"}, Column{"joint.NAME.slip", "m", "", 3}};

TEST(Column, TitlesHaveUnitsOwnersAndAxes) {
  Titles titles = {"first"};
  add_titles(titles, columns, "base");
  EXPECT_EQ(titles,
            (Titles{"first", "time [s]", "part", "joint.base.slip_x [m]", "joint.base.slip_y [m]", "joint.base.slip_z [m]"}));
}

TEST(Column, AVectorInThePlaneHasTwoColumns) {
  Titles titles;
  add_titles(titles, std::span(columns).last(1), "base", 2);
  EXPECT_EQ(titles, (Titles{"joint.base.slip_x [m]", "joint.base.slip_y [m]"}));
}

TEST(Column, FieldsTakeTheirNamesInOrder) {
  const std::vector<Real> numbers = {1, 2};
  const std::vector<std::int32_t> integers = {3, 4};
  const std::vector<Vector3> vectors = {{1, 2, 3}, {4, 5, 6}};
  const auto data = cell_data(columns, numbers, integers, vectors);
  ASSERT_EQ(data.size(), 3U);
  EXPECT_EQ(data[0].name, "time");
  EXPECT_EQ(std::get<std::span<const std::int32_t>>(data[1].values)[1], 4);
  EXPECT_EQ(data[2].components, 3U);
  EXPECT_EQ(std::get<std::span<const Real>>(data[2].values)[5], 6);
}

}  // namespace
}  // namespace sazare::observe
