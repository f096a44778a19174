#include "sazare/laws/pressure_table.hpp"

#include <gtest/gtest.h>

namespace sazare::laws {
namespace {

const PressureTable table{{1e-4, 2e-4, 5e-4}, {0, 4e6, 1e6}};

TEST(pressure_table, has_its_points) {
  EXPECT_EQ(table_pressure(table, 1e-4), 0);
  EXPECT_EQ(table_pressure(table, 2e-4), 4e6);
  EXPECT_EQ(table_pressure(table, 5e-4), 1e6);
}

TEST(pressure_table, is_straight_between_them) {
  EXPECT_NEAR(table_pressure(table, 1.25e-4), 1e6, 1e-6);
  EXPECT_NEAR(table_pressure(table, 3e-4), 3e6, 1e-6);
}

TEST(pressure_table, is_nothing_outside) {
  EXPECT_EQ(table_pressure(table, 0), 0);
  EXPECT_EQ(table_pressure(table, 5.001e-4), 0);
  EXPECT_EQ(table_pressure(PressureTable{}, 0), 0);
}

}  // namespace
}  // namespace sazare::laws
