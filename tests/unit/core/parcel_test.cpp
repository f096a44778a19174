#include "sazare/core/parcel.hpp"

#include <gtest/gtest.h>

namespace sazare {
namespace {

TEST(parcel, comes_out_as_it_went_in) {
  double number = 0.1;
  std::vector<int> list = {3, 1, 4};
  Parcel packed;
  packed(number);
  packed(list);
  packed(number);
  Parcel arrived(packed.packed());
  double first = 0, last = 0;
  std::vector<int> got = {7};
  arrived(first);
  arrived(got);
  arrived(last);
  EXPECT_EQ(first, number);
  EXPECT_EQ(got, list);
  EXPECT_EQ(last, number);
}

TEST(parcel, that_is_too_short_is_an_error_of_the_program) {
  Parcel packed;
  int number = 1;
  packed(number);
  Parcel arrived(packed.packed());
  double larger = 0;
  EXPECT_THROW(arrived(larger), std::logic_error);
}

}  // namespace
}  // namespace sazare
