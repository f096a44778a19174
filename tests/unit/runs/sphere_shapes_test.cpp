#include <gtest/gtest.h>

#include "sazare/methods/spheres/run/placing/placement.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

using namespace sphere_cases;
using test::read_manifest, test::TemporaryFolder;

/// A case of one body from the surface of a cube of 0.02 m.
cases::CaseFile cube_case(const TemporaryFolder& folder, const std::string& of_shape = "", const std::string& rest = "") {
  std::string facets = "solid cube\n";
  const auto add = [&](const std::string& a, const std::string& b, const std::string& c) {
    facets += "facet normal 0 0 0\nouter loop\n";
    for (const std::string& corner : {a, b, c}) facets += "vertex " + corner + "\n";
    facets += "endloop\nendfacet\n";
  };
  const auto side = [&](const std::string& a, const std::string& b, const std::string& c, const std::string& d) {
    add(a, b, c);
    add(a, c, d);
  };
  side("0 0 0", "0 1 0", "1 1 0", "1 0 0");
  side("0 0 1", "1 0 1", "1 1 1", "0 1 1");
  side("0 0 0", "1 0 0", "1 0 1", "0 0 1");
  side("0 1 0", "0 1 1", "1 1 1", "1 1 0");
  side("0 0 0", "0 0 1", "0 1 1", "0 1 0");
  side("1 0 0", "1 1 0", "1 1 1", "1 0 1");
  return case_of(folder,
                 "[[shapes]]\nname = \"cube\"\nsource = \"mesh\"\nscale = 0.02\nfile = \"" +
                     folder.write("cube.stl", facets + "endsolid cube\n").string() + "\"\n" + of_shape +
                     "[[spheres]]\nname = \"a\"\nmaterial = \"glass\"\nshape = \"cube\"\ncentre = [0.04, 0.04, 0.02]\n" + rest,
                 {"time.end=0.01", "time.snapshot_interval=0.01"});
}

constexpr Real mass = 2500 * 8e-6, inertia = mass * 4e-4 / 6;

TEST(sphere_shapes, a_body_from_a_surface_has_mass_and_inertia_of_the_solid) {
  const TemporaryFolder folder;
  const auto file = cube_case(folder);
  const Placement placement = place_spheres(file);
  ASSERT_EQ(placement.clumps.clumps.size(), 1);
  const state::Clump& clump = placement.clumps.clumps.front();
  EXPECT_NEAR(clump.mass, mass, 1e-12 * mass);
  EXPECT_NEAR(clump.volume, 8e-6, 1e-17);
  for (const Real own : clump.inertia) EXPECT_NEAR(own, inertia, 1e-9 * inertia);
  // The first sphere fills the middle of the cube, which is its centre of mass.
  EXPECT_LT((placement.spheres.place.front().centre() - Vector3(0.04, 0.04, 0.02)).norm(), 5e-4);
}

TEST(sphere_shapes, how_much_of_its_surface_a_body_fills_is_told) {
  const TemporaryFolder folder;
  const auto file = cube_case(folder);
  const std::string words = registry::check_case(file);
  EXPECT_NE(words.find("\"cube\": its spheres fill 81 % of its surface, whose mass and inertia it has"), std::string::npos)
      << words;
  carry_out(file, folder / "run");
  EXPECT_NEAR(read_manifest(folder / "run")["results"]["shape_fill_cube"].get<double>(), 0.81, 0.005);
}

TEST(sphere_shapes, bonded_spheres_share_out_the_mass_of_the_solid) {
  const TemporaryFolder folder;
  const auto file = cube_case(folder, "bonds = \"stone\"\n",
                              "[[bonds]]\nname = \"stone\"\nyoungs_modulus = 1e7\npoisson_ratio = 0.2\nreach = 0.2\n");
  const Placement placement = place_spheres(file);
  Real sum = 0;
  Vector3 centre = Vector3::Zero();
  for (const auto& place : placement.spheres.place) {
    sum += place.mass;
    centre += place.mass * place.centre();
  }
  EXPECT_NEAR(sum, mass, 1e-9 * mass);
  EXPECT_LT((centre / sum - Vector3(0.04, 0.04, 0.02)).norm(), 1e-9);
}

}  // namespace
}  // namespace sazare::runs
