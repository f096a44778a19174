#include <gtest/gtest.h>

#include <fstream>

#include "sazare/core/error.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/mps/run/filling.hpp"
#include "sazare/methods/mps/run/model.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::TemporaryFolder, test::words_of;

/// A case whose [particles] and [[regions]] are given; all regions are made of one soil.
cases::CaseFile case_with(const TemporaryFolder& folder, const std::string& text, const std::string& names) {
  std::ofstream(folder / "case.toml") << "[case]\ntitle = \"t\"\nmethod = \"mps\"\n"
                                      << text << "\n[[materials]]\nname = \"soil\"\nregions = [" << names
                                      << "]\ndensity = 1500.0\ns_wave_velocity = 100.0\npoisson_ratio = 0.25\n[time]\nend = 1.0\n";
  return registry::read_case(folder / "case.toml");
}

TEST(particle_filling, rectangle_takes_whole_particles_along_its_longest_side) {
  const TemporaryFolder folder;
  const auto file = case_with(folder, R"([particles]
spacing = 0.5
[[regions]]
name = "a"
lower = [1.0, 0.0, 0.0]
upper = [2.0, 3.0, 0.0])",
                              "\"a\"");
  const Filling<2> filling = fill_regions<2>(file);
  ASSERT_EQ(filling.sites.size(), 12);
  EXPECT_EQ(filling.sites[1], (methods::mps::Site<2>{0, 1}));  // y first
  EXPECT_DOUBLE_EQ(filling.place(1).x(), 1.25);
  EXPECT_DOUBLE_EQ(filling.place(1).y(), 0.75);
}

TEST(particle_filling, fit_inside_leaves_out_what_does_not_fit) {
  const TemporaryFolder folder;
  const auto file = case_with(folder, R"([particles]
spacing = 3.2
fit = "inside"
[[regions]]
name = "a"
lower = [0.0, 0.0, 0.0]
upper = [10.0, 100.0, 0.0])",
                              "\"a\"");
  EXPECT_EQ(fill_regions<2>(file).sites.size(), 3 * 31);
}

TEST(particle_filling, polygon_holds_the_centres_inside_and_the_last_region_counts) {
  const TemporaryFolder folder;
  const auto file = case_with(folder, R"([particles]
spacing = 1.0
[[regions]]
name = "slope"
shape = "polygon"
points = [[0, 0], [10, 0], [10, 4], [6, 4], [0, 1], [0, 0]]
[[regions]]
name = "block"
lower = [8.0, 2.0, 0.0]
upper = [10.0, 4.0, 0.0])",
                              "\"slope\", \"block\"");
  const Filling<2> filling = fill_regions<2>(file);
  // Rows at 0.5, 1.5, 2.5, 3.5: from x = 0, 1, 3 and 5 on (centres right of the line from (0, 1) to (6, 4)).
  EXPECT_EQ(filling.sites.size(), 10 + 9 + 7 + 5);
  EXPECT_EQ(std::ranges::count(filling.region, 1), 4);
}

TEST(particle_filling, mesh_group_in_3d) {
  const TemporaryFolder folder;
  const auto file =
      case_with(folder,
                "[particles]\nspacing = 0.05\ndimension = 3\n[[regions]]\nname = \"a\"\nshape = \"mesh\"\nfile = \"" +
                    std::filesystem::absolute("tests/regression/block/block.msh").string() + "\"\ngroup = \"rock\"\n",
                "\"a\"");
  Real mesh_volume = 0;
  const BlocksModel model = test::block_model(test::block_case());
  for (Index element = 0; element < static_cast<Index>(model.mesh.tetrahedra.size()); ++element)
    mesh_volume += geometry::volume(geometry::corners_of(model.mesh, element));
  const Real filled = static_cast<Real>(fill_regions<3>(file).sites.size()) * 0.05 * 0.05 * 0.05;
  EXPECT_NEAR(filled, mesh_volume, 0.15 * mesh_volume);
}

TEST(particle_filling, says_what_does_not_fit) {
  const TemporaryFolder folder;
  const auto words = [&](const std::string& regions, const std::string& names) {
    return words_of<UserError>([&] { fill_regions<2>(case_with(folder, "[particles]\nspacing = 1.0\n" + regions, names)); });
  };
  const std::string covered = words(R"([[regions]]
name = "a"
lower = [0.0, 0.0, 0.0]
upper = [2.0, 2.0, 0.0]
[[regions]]
name = "b"
lower = [0.0, 0.0, 0.0]
upper = [2.0, 2.0, 0.0])",
                                    "\"a\", \"b\"");
  EXPECT_NE(covered.find("error: the region \"a\" contains no particle"), std::string::npos) << covered;
  const std::string shifted = words(R"([[regions]]
name = "a"
lower = [0.0, 0.0, 0.0]
upper = [2.0, 2.0, 0.0]
[[regions]]
name = "b"
lower = [2.3, 0.0, 0.0]
upper = [4.3, 2.0, 0.0])",
                                    "\"a\", \"b\"");
  EXPECT_NE(
      shifted.find("the spacing does not fit the region: it begins 2.3 spacings from the beginning of the body on the axis x"),
      std::string::npos)
      << shifted;
}

}  // namespace
}  // namespace sazare::runs
