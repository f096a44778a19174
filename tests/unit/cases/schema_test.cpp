#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "case_folder.hpp"
#include "sazare/cases/format/schema.hpp"
#include "sazare/cases/format/units.hpp"
#include "sazare/cases/study_file.hpp"
#include "sazare/methods/blocks/case/fields.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/fem/case/fields.hpp"
#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/mps/case/fields.hpp"
#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/rectangles/case/fields.hpp"
#include "sazare/methods/rectangles/case/format.hpp"
#include "sazare/methods/spheres/case/fields.hpp"
#include "sazare/methods/spheres/case/format.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

/// Tables of all methods and of studies.
std::vector<Table> all_tables() {
  std::vector<Table> tables;
  for (const auto schema : {blocks_schema(), mps_schema(), rectangles_schema(), spheres_schema(), fem_schema(), study_schema()})
    tables.insert(tables.end(), schema.begin(), schema.end());
  return tables;
}

TEST(Schema, DescribesEveryKey) {
  for (const Table& table : all_tables()) {
    EXPECT_FALSE(table.sentence.empty()) << table.name;
    std::set<std::string_view> names;
    for (const Key& key : table.keys) {
      SCOPED_TRACE(std::string(table.name) + "." + std::string(key.name));
      EXPECT_TRUE(names.insert(key.name).second) << "given twice";
      EXPECT_TRUE(key.sentence.ends_with(".")) << key.sentence;
      EXPECT_EQ(key.type == Type::choice, !key.choices.empty());
      if (!key.unit.empty()) {
        EXPECT_TRUE(is_unit(key.unit)) << key.unit;
      }
      if (key.need == Need::required) {
        EXPECT_TRUE(key.default_text.empty());
      }
      const bool says_when = key.need == Need::required || !key.default_text.empty() || !key.note.empty();
      EXPECT_TRUE(says_when) << "neither required, nor with a default, nor with a note";
    }
  }
}

template <class Enum>
void expect_same_words(std::string_view table, std::string_view key, std::span<const Table> schema = blocks_schema()) {
  const Key* found = find_key(*find_table(schema, table), key);
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(std::ranges::equal(found->choices, EnumWords<Enum>::words)) << table << "." << key;
}

TEST(Schema, ChoicesAreInTheOrderOfTheEnums) {
  expect_same_words<DampingCap>("contact", "damping_cap");
  expect_same_words<Levels>("time", "levels");
  expect_same_words<Limiter>("time", "limiter");
  expect_same_words<BoundaryKind>("boundaries", "kind");
  expect_same_words<ParticleFit>("particles", "fit", mps_schema());
  expect_same_words<RotationRemoval>("particles", "rotation", mps_schema());
  expect_same_words<RotationTorque>("particles", "rotation_torque", mps_schema());
  expect_same_words<EulerDamping>("time", "euler_damping", mps_schema());
  expect_same_words<RegionShape>("regions", "shape", mps_schema());
  expect_same_words<MotionShape>("motions", "type", mps_schema());
  expect_same_words<laws::MotionQuantity>("motions", "quantity", mps_schema());
  expect_same_words<Baseline>("motions", "baseline", mps_schema());
  expect_same_words<Side>("boundaries", "side", mps_schema());
  expect_same_words<SideKind>("boundaries", "kind", mps_schema());
  expect_same_words<Integrator>("time", "integrator", mps_schema());
  expect_same_words<BlockShape>("blocks", "shape", rectangles_schema());
  expect_same_words<ElementShape>("blocks", "elements", rectangles_schema());
  expect_same_words<SpringLayout>("materials", "layout", rectangles_schema());
  expect_same_words<IncrementFormula>("materials", "increments", rectangles_schema());
  expect_same_words<MotionShape>("motions", "type", rectangles_schema());
  expect_same_words<ContactModel>("contact", "model", spheres_schema());
  expect_same_words<SphereSource>("spheres", "source", spheres_schema());
  expect_same_words<WallShape>("walls", "shape", spheres_schema());
  expect_same_words<MassKind>("elements", "mass", fem_schema());
  expect_same_words<IntegrationKind>("elements", "integration", fem_schema());
  expect_same_words<GroupKind>("boundaries", "kind", fem_schema());
  expect_same_words<Analysis>("time", "analysis", fem_schema());
  expect_same_words<BackboneKind>("materials", "backbone", fem_schema());
  expect_same_words<BackboneKind>("materials", "backbone", mps_schema());
  expect_same_words<Drainage>("materials", "drainage", fem_schema());
}

TEST(Schema, JsonIsValidAndClosed) {
  const auto all = nlohmann::json::parse(registry::schema_json());
  ASSERT_EQ(all["oneOf"].size(), 6);
  EXPECT_EQ(all["oneOf"][1]["properties"]["case"]["properties"]["method"]["const"], "mps");
  EXPECT_EQ(all["oneOf"][1]["properties"].size(), mps_schema().size());
  EXPECT_EQ(all["oneOf"][2]["properties"]["case"]["properties"]["method"]["const"], "rectangles");
  EXPECT_EQ(all["oneOf"][3]["properties"]["case"]["properties"]["method"]["const"], "spheres");
  EXPECT_EQ(all["oneOf"][4]["properties"]["case"]["properties"]["method"]["const"], "fem");
  EXPECT_EQ(all["oneOf"][5]["properties"]["case"]["properties"]["method"]["const"], "hybrid");
  const auto& json = all["oneOf"][0];
  EXPECT_EQ(json["additionalProperties"], false);
  EXPECT_EQ(json["properties"].size(), blocks_schema().size());
  const auto& joints = json["properties"]["joints"];
  EXPECT_EQ(joints["type"], "array");
  EXPECT_EQ(joints["minItems"], 1);
  EXPECT_EQ(joints["items"]["properties"]["joint_normal_stiffness"]["exclusiveMinimum"], 0);
  EXPECT_EQ(json["properties"]["contact"]["properties"]["edge_division"]["maximum"], 20);
  EXPECT_EQ(json["properties"]["time"]["required"], nlohmann::json::array({"end"}));
  EXPECT_EQ(json["properties"]["time"]["properties"]["limiter"]["enum"], nlohmann::json::array({"stability", "travel", "none"}));
}

TEST(Schema, MarkdownHasARowForEveryKey) {
  const std::string text = registry::schema_markdown();
  for (const Table& table : all_tables())
    for (const Key& key : table.keys)
      EXPECT_NE(text.find("| `" + std::string(key.name) + "` |"), std::string::npos) << table.name << "." << key.name;
}

/// SAZARE_WRITE_REFERENCE=1 in the environment writes the page anew.
TEST(Schema, ReferencePageIsUpToDate) {
  const char* const page = "docs/reference/case.md";
  if (std::getenv("SAZARE_WRITE_REFERENCE") != nullptr) std::ofstream(page) << registry::schema_markdown();
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_EQ(text.str(), registry::schema_markdown());
}

}  // namespace
}  // namespace sazare::cases
