#include <string>

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"

namespace sazare {
namespace {

template <typename Error>
std::string message_of(const char* words) {
  try {
    throw Error(words);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(Error, KeepsItsWords) {
  EXPECT_EQ(message_of<UserError>("no such key"), "no such key");
  EXPECT_EQ(message_of<PhysicsError>("not a number"), "not a number");
  EXPECT_EQ(message_of<MachineError>("disk full"), "disk full");
}

TEST(Error, ExitCodesAreTheDocumentedOnes) {
  EXPECT_EQ(UserError::exit_code, 2);
  EXPECT_EQ(PhysicsError::exit_code, 3);
  EXPECT_EQ(MachineError::exit_code, 4);
}

}  // namespace
}  // namespace sazare
