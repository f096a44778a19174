#include <gtest/gtest.h>

#include "case_folder.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {
namespace {

TEST(Overrides, ReplaceNumbersTextsAndLists) {
  const CaseFolder folder;
  const BlocksCase blocks =
      folder
          .read(full_case(), {"time.end=1e-3", "joints.0.cohesion=5e6", "time.limiter=stability", "case.title=\"Other\"",
                              "gauges.0.point=[1, 2, 3]", "materials.0.regions=[\"a\", \"b\"]", "time.strict=false"})
          .as<BlocksCase>();
  EXPECT_EQ(blocks.time.end, 1e-3);
  EXPECT_EQ(blocks.joints[0].cohesion, 5e6);
  EXPECT_EQ(blocks.time.limiter, Limiter::stability);
  EXPECT_EQ(blocks.title, "Other");
  EXPECT_EQ(blocks.gauges[0].point, Vector3(1, 2, 3));
  EXPECT_EQ(blocks.materials[0].regions, (std::vector<std::string>{"a", "b"}));
  EXPECT_FALSE(blocks.time.strict);
}

TEST(Overrides, ReachInsideListsAndInlineTables) {
  const CaseFolder folder;
  const BlocksCase blocks = folder.read(full_case(), {"gauges.0.point.2=0.5", "mesh.parameters.depth=0.2"}).as<cases::BlocksCase>();
  EXPECT_EQ(blocks.gauges[0].point, Vector3(0.3, 0.6, 0.5));
  EXPECT_EQ(blocks.mesh.parameters[0].second, 0.2);
}

TEST(Overrides, AddKeysAndTables) {
  const CaseFolder folder;
  const BlocksCase blocks =
      folder.read(smallest_case(), {"gravity.acceleration=[0,0,-9.81]", "contact.edge_division=7"}).as<cases::BlocksCase>();
  EXPECT_EQ(blocks.gravity.acceleration.z(), -9.81);
  EXPECT_EQ(blocks.contact.edge_division, 7);
}

TEST(Overrides, TheLastOneWins) {
  const CaseFolder folder;
  EXPECT_EQ(folder.read(smallest_case(), {"time.end=1e-3", "time.end=2e-3"}).as<cases::BlocksCase>().time.end, 2e-3);
}

TEST(Overrides, AWordIsTakenAsText) {
  const CaseFolder folder;
  EXPECT_EQ(folder.read(smallest_case(), {"case.title=Free face, 3 m"}).as<cases::BlocksCase>().title, "Free face, 3 m");
}

TEST(Overrides, CannotSmuggleInOtherKeys) {
  const CaseFolder folder;
  const std::string message = folder.refusal(smallest_case(), {"case.title=1\nx = 2"});
  EXPECT_NE(message.find("title contains a control character"), std::string::npos) << message;
}

TEST(Overrides, AreRefusedWithTheirOwnPlace) {
  const CaseFolder folder;
  const std::string message = folder.refusal(smallest_case(), {"time.end=-1"});
  EXPECT_TRUE(message.starts_with("--set time.end: error: end must be greater than 0")) << message;
}

}  // namespace
}  // namespace sazare::cases
