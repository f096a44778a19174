#include <gtest/gtest.h>

#include "sazare/cases/format/units.hpp"

namespace sazare::cases {
namespace {

struct Conversion {
  const char* text;
  const char* unit;
  double expected;
};

class Converted : public testing::TestWithParam<Conversion> {};

TEST_P(Converted, ToSi) {
  const auto quantity = parse_quantity(GetParam().text);
  ASSERT_TRUE(quantity);
  const auto value = converted(*quantity, GetParam().unit);
  ASSERT_TRUE(value) << GetParam().text;
  EXPECT_NEAR(*value, GetParam().expected, 1e-12 * GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Units, Converted,
                         testing::Values(Conversion{"450 GPa", "Pa", 450e9}, Conversion{"450GPa/m", "Pa/m", 450e9},
                                         Conversion{"450 GN/m3", "Pa/m", 450e9}, Conversion{"22.6 MN·s/m³", "Pa s/m", 22.6e6},
                                         Conversion{"2.39 g/cm3", "kg/m3", 2390}, Conversion{"2.39 t/m^3", "kg/m3", 2390},
                                         Conversion{"20 mm", "m", 0.02}, Conversion{"500 µs", "s", 5e-4},
                                         Conversion{"0.5 ms", "s", 5e-4}, Conversion{"2 min", "s", 120},
                                         Conversion{"99.67 J/m2", "N/m", 99.67}, Conversion{"66.6 bar", "Pa", 6.66e6},
                                         Conversion{"30 deg", "deg", 30}, Conversion{"30°", "deg", 30},
                                         Conversion{"3.141592653589793 rad", "deg", 180}, Conversion{"12", "Pa", 12},
                                         Conversion{"5000 cm4", "m4", 5e-5}, Conversion{"9.81 m/s²", "m/s2", 9.81},
                                         Conversion{"36 m/h", "m/s", 0.01}));

TEST(Quantity, NeedsANumberFirst) {
  EXPECT_FALSE(parse_quantity("strong"));
  EXPECT_FALSE(parse_quantity(""));
  EXPECT_TRUE(parse_quantity(" +3 m "));
}

TEST(Quantity, OfAnotherKindIsNotConverted) {
  EXPECT_FALSE(converted({450, "GPa"}, "Pa/m"));
  EXPECT_FALSE(converted({1, "furlong"}, "m"));
  EXPECT_FALSE(converted({1, "m"}, ""));
}

TEST(Unit, IsKnownByItsParts) {
  EXPECT_TRUE(is_unit("kN/mm2"));
  EXPECT_TRUE(is_unit("1/s"));
  EXPECT_FALSE(is_unit("1"));
  EXPECT_DOUBLE_EQ(converted({2, "1/ms"}, "1/s").value(), 2000);
  EXPECT_FALSE(is_unit(""));
  EXPECT_FALSE(is_unit("concrete"));
  EXPECT_FALSE(is_unit("/"));
}

}  // namespace
}  // namespace sazare::cases
