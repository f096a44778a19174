#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/mesh_fit.hpp"
#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::runs {
namespace {

/// Two tetrahedra of two regions on either side of a face, which belongs to a surface group with one that lies outside.
geometry::TetraMesh two_elements() {
  geometry::TetraMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {4, 1, 3, 2}};
  mesh.region = {0, 1};
  mesh.region_names = {"lower", "upper"};
  mesh.surfaces = {{"hole", {{1, 2, 3}, {0, 1, 2}}}, {"top", {{4, 1, 3}}}};
  return mesh;
}

std::string joint(const std::string& name, const std::string& first, const std::string& second) {
  return "[[joints]]\nname = \"" + name + "\"\nbetween = [\"" + first + "\", \"" + second +
         "\"]\njoint_normal_stiffness = 450e9\njoint_shear_stiffness = 90e9\ncohesion = 6e6\nfriction_coefficient = 0.58\n"
         "tensile_strength = 6e6\nfracture_energy = 100.0\n";
}

cases::CaseFile case_with(const std::string& joints, const std::string& moduli = "") {
  return registry::read_case_text(
      "[case]\ntitle = \"Two\"\nmethod = \"blocks\"\n[mesh]\nfile = \"tests/regression/block/block.msh\"\n"
      "[[materials]]\nname = \"soft\"\nregions = [\"lower\"]\ndensity = 2390.0\n" +
          moduli + "[[materials]]\nname = \"hard\"\nregions = [\"upper\"]\ndensity = 2390.0\n" + moduli + joints +
          "[contact]\ncontact_stiffness = 1.5e9\nfriction_coefficient = 0.58\n"
          "[[blasts]]\nsurface = \"hole\"\npeak_pressure = 5e8\nrise_time = 1e-4\ndecay_ratio = 2.0\n"
          "[[boundaries]]\nsurface = \"hole\"\nkind = \"fixed\"\n"
          "[time]\nend = 5e-4\nhistory_interval = 1e-6\nsnapshot_interval = 1e-5\n",
      "case.toml");
}

std::string warnings_of(const std::string& joints) {
  const cases::CaseFile file = case_with(joints);
  const geometry::TetraMesh mesh = two_elements();
  const auto map = geometry::build_face_map(mesh);
  const MeshFaces faces{mesh, map, geometry::find_surface_faces(mesh, map)};
  const std::vector<Index> material = materials_by_element(file.as<cases::BlocksCase>(), mesh);
  return warn_of_mesh_fit(file, find_mesh_fit(file.as<cases::BlocksCase>(), faces, material,
                                              joint_by_face(file.as<cases::BlocksCase>(), faces, material)));
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(MeshFit, FacesThatNoJointHoldsForAreWarnedOf) {
  const std::string words = warnings_of(joint("soft", "soft", "soft"));
  EXPECT_TRUE(has(words, "1 faces between \"soft\" and \"hard\" have no joint: these elements are only in contact")) << words;
  EXPECT_TRUE(has(words, "add [[joints]] with between = [\"soft\", \"hard\"]")) << words;
  EXPECT_FALSE(has(warnings_of(joint("both", "hard", "soft")), "have no joint"));
}

TEST(MeshFit, AJointThatHoldsForNoFaceIsWarnedOf) {
  const std::string words = warnings_of(joint("soft", "soft", "soft") + joint("both", "hard", "soft"));
  EXPECT_TRUE(has(words, "the joint \"soft\" applies to no face of the mesh")) << words;
  EXPECT_FALSE(has(words, "the joint \"both\"")) << words;
}

TEST(MeshFit, FacesBetweenElementsInTheSurfaceOfABlastOrABoundaryAreWarnedOf) {
  const std::string words = warnings_of(joint("both", "hard", "soft"));
  EXPECT_TRUE(has(words, "1 faces of this surface lie between two elements: no pressure acts on them")) << words;
  EXPECT_TRUE(has(words, "1 faces of this surface lie between two elements: the boundary does not apply to them")) << words;
}

/// What is said of the two elements, whose centres are 0.433 m apart, as rock of so many Pa; nothing where it is fine.
std::string refusal(const std::string& young, const std::string& law) {
  const auto entry = [&](const std::string& name, const std::string& first, const std::string& second) {
    return "[[joints]]\nname = \"" + name + "\"\nbetween = [\"" + first + "\", \"" + second +
           "\"]\nfriction_coefficient = 0.58\n" + law;
  };
  const auto file = case_with(entry("soft", "soft", "soft") + entry("both", "soft", "hard"),
                              "youngs_modulus = " + young + "\npoisson_ratio = 0.0\n");
  const auto model = build_blocks(file.as<cases::BlocksCase>(), two_elements());
  try {
    warn_of_mesh_fit(file, model.fit);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshFit, ElementsThatAreTooLargeForTheStrengthAreRefused) {
  const std::string law = "cohesion = 6e6\ntensile_strength = 6e6\nfracture_energy = 100.0\n";
  // 2 G K_n/s_t^2 with K_n = E/1.0519.
  EXPECT_EQ(refusal("84e9", law), "");
  const std::string words = refusal("80e9", law);
  EXPECT_TRUE(has(words,
                  "elements are too large for this tensile_strength and fracture_energy: centres on both sides of a face are "
                  "0.433 m apart"))
      << words;
  EXPECT_TRUE(has(words, "the largest distance of centres that does is 0.423 m, edges of some 1.04 m")) << words;
}

TEST(MeshFit, ElementsThatAreTooLargeForTheShearStrengthAreRefused) {
  const auto law = [](const std::string& energy) {
    return "law = \"mixed_mode\"\ncohesion = 12e6\ntensile_strength = 2e6\nfracture_energy = 100.0\nshear_fracture_energy = " +
           energy + "\n";
  };
  EXPECT_EQ(refusal("80e9", law("420.0")), "");
  const std::string words = refusal("80e9", law("400.0"));
  EXPECT_TRUE(has(words, "elements are too large for this cohesion and shear_fracture_energy")) << words;
  EXPECT_TRUE(has(words, "with this mesh shear_fracture_energy must be at least 410 N/m")) << words;
}

/// A charge along z in a hole of which the mesh has the one outer face at z = 0.
std::string charge(const std::string& bottom, const std::string& diameter) {
  return "[[charges]]\nname = \"shot\"\nsurface = \"hole\"\ncollar = [0.0, 0.0, -1.0]\ntoe = [0.0, 0.0, 1.0]\nexplosive = "
         "\"ANFO\"\nbottom = " +
         bottom + "\ndiameter = " + diameter + "\n";
}

TEST(MeshFit, AChargeThatStandsAtNoFaceIsRefused) {
  try {
    warnings_of(joint("both", "hard", "soft") + charge("0.5", "1.3"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_TRUE(has(error.what(), "no face of \"hole\" stands beside the explosive, 0 to 0.5 m below the collar"))
        << error.what();
  }
}

TEST(MeshFit, AHoleWhoseAxisIsElsewhereThanItsWallIsRefused) {
  try {
    warnings_of(joint("both", "hard", "soft") + charge("1.5", "0.3"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_TRUE(
        has(error.what(), "the hole meets no wall: the corners of \"hole\" are 0.6667 m from its axis, and it is 0.3 m across"))
        << error.what();
  }
}

TEST(MeshFit, AHoleOfAnotherDiameterThanThatOfTheMeshIsWarnedOf) {
  const std::string words = warnings_of(joint("both", "hard", "soft") + charge("1.5", "0.5"));
  EXPECT_TRUE(has(words, "the corners of the wall are 0.6667 m from the axis of the hole, whose radius is 0.25 m")) << words;
  EXPECT_TRUE(has(words, "1 faces of this surface lie between two elements: no gas presses on them")) << words;
  EXPECT_FALSE(has(warnings_of(joint("both", "hard", "soft") + charge("1.5", "1.33")), "from the axis of the hole"));
}

}  // namespace
}  // namespace sazare::runs
