#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

/// Pore water and tied sides of a case of method fem.
namespace sazare::runs {
namespace {

using test::read_manifest, test::read_text, test::run_quietly, test::TemporaryFolder, test::without_last_column, test::words_of;

constexpr const char* geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 4, 0}; Point(4) = {0, 4, 0}; Point(5) = {1, 6, 0}; Point(6) = {0, 6, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Transfinite Curve{1, 3, 6} = 2; Transfinite Curve{2, 4, 5, 7} = 5;
Transfinite Surface{1, 2}; Recombine Surface{1, 2};
Physical Surface("sand") = {1};
Physical Surface("cover") = {2};
Physical Curve("base") = {1};
Physical Curve("left") = {4, 7};
Physical Curve("right") = {2, 5};
Physical Curve("lower_right") = {2};
Physical Curve("top") = {6};
)";

constexpr const char* body = R"([case]
title = "Sand"
method = "fem"

[mesh]
file = "column.geo"

[[materials]]
name = "sand"
regions = ["sand"]
density = 1600
water_table = 4.0
saturated_density = 2000
drainage = "flow"
porosity = 0.4
hydraulic_conductivity = 1e-3
youngs_modulus = 5e7
poisson_ratio = 0.25

[[materials]]
name = "cover"
regions = ["cover"]
density = 1600
youngs_modulus = 5e7
poisson_ratio = 0.25

[[ties]]
group = "left"
opposite = "right"

[[boundaries]]
group = "base"
kind = "fixed"

[[loads]]
name = "load"
group = "top"
traction = [0, -1e5, 0]

[gravity]
acceleration = [0, -9.81, 0]
settle = true

[[gauges]]
name = "table"
point = [0, 4, 0]

[[gauges]]
name = "base"
point = [0, 0, 0]

[[gauges]]
name = "top"
point = [0, 6, 0]

[time]
end = 1.0
step = 0.05
analysis = "static"
history_interval = 0.05
snapshot_interval = 0.5
)";

class SandCase {
public:
  explicit SandCase(const std::string& more = "") {
    std::ofstream(folder_ / "column.geo") << geometry;
    std::ofstream(folder_ / "case.toml") << body << more;
  }

  cases::CaseFile read(const std::vector<std::string>& settings = {}) const {
    return registry::read_case(folder_ / "case.toml", settings);
  }
  nlohmann::json run(const std::vector<std::string>& settings = {}, const std::string& name = "run") const {
    run_quietly(read(settings), folder_ / name);
    return read_manifest(folder_ / name);
  }
  std::string refused(const std::vector<std::string>& settings = {}) const {
    return words_of<UserError>([&] { registry::check_case(read(settings)); });
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

private:
  TemporaryFolder folder_;
};

/// Numbers of a column of a table.
std::vector<Real> column_of(const std::string& table, const std::string& name) {
  std::istringstream lines(table);
  std::string line, word;
  std::getline(lines, line);
  std::size_t place = 0, number = 0;
  for (std::istringstream titles(line); std::getline(titles, word, ','); ++number)
    if (word == name) place = number + 1;
  EXPECT_GT(place, 0U) << name;
  std::vector<Real> found;
  while (std::getline(lines, line)) {
    std::istringstream values(line);
    for (std::size_t i = 0; i < place; ++i) std::getline(values, word, ',');
    found.push_back(std::stod(word));
  }
  return found;
}

TEST(pore_water, carries_a_load_at_first_and_drains_through_the_table) {
  const SandCase sand;
  const auto figures = sand.run()["results"];
  const auto base = column_of(read_text(sand / "run/gauges.csv"), "base.excess_pore_pressure [Pa]");
  const auto table = column_of(read_text(sand / "run/gauges.csv"), "table.excess_pore_pressure [Pa]");
  EXPECT_EQ(base.front(), 0);
  EXPECT_NEAR(base[1], 1e5, 2e3);
  for (std::size_t i = 2; i < base.size(); ++i) EXPECT_LT(base[i], base[i - 1]);
  EXPECT_LT(base.back(), 9e4);
  for (const Real pressure : table) EXPECT_EQ(pressure, 0);
  EXPECT_EQ(read_text(sand / "run/gauges.csv").find("top.excess_pore_pressure"), std::string::npos);
  EXPECT_NEAR(figures["peak_excess_pore_pressure"].get<Real>(), base[1], 1e-6 * base[1]);
  EXPECT_LT(std::abs(figures["energy_residual"].get<Real>()), 1e-9 * figures["energy_work"].get<Real>());
  EXPECT_GT(figures["energy_seepage"].get<Real>(), 0);
}

TEST(pore_water, goes_on_from_a_checkpoint_bit_for_bit) {
  for (const std::string analysis : {"static", "dynamic"}) {
    const SandCase sand;
    const std::vector<std::string> settings = {"time.analysis=" + analysis, "time.step=5e-4"};
    const auto file = sand.read(settings);
    test::run_in_parts(file, sand / "parts", test::run_whole(file, sand / "whole"));
    SCOPED_TRACE(analysis);
    test::expect_same_runs(sand / "whole", sand / "parts");
  }
}

TEST(pore_water, resolves_to_a_case_that_gives_the_same) {
  const SandCase sand("\n[[drains]]\ngroup = \"lower_right\"\n");
  const auto first = sand.run();
  run_quietly(registry::read_case(sand / "run/case.toml", {}), sand / "again");
  EXPECT_EQ(read_manifest(sand / "again")["state_hash"], first["state_hash"]);
  EXPECT_LT(first["results"]["peak_excess_pore_pressure"].get<Real>(), 9e4);  // through the side as well
}

TEST(pore_water, is_told_of_a_drain_without_ground) {
  const SandCase sand("\n[[drains]]\ngroup = \"top\"\n");
  EXPECT_NE(sand.refused().find("the group \"top\" has no node of ground through which water flows"), std::string::npos)
      << sand.refused();
}

/// What check says of a case.
std::string told(const SandCase& sand, const std::vector<std::string>& settings) {
  return registry::check_case(sand.read(settings));
}

TEST(pore_water, drains_nothing_above_the_table) {
  const SandCase sand("\n[[drains]]\ngroup = \"top\"\n");
  const std::vector<std::string> above = {"materials.1.water_table=4", "materials.1.saturated_density=2000",
                                          "materials.1.porosity=0.4", "materials.1.drainage=flow",
                                          "materials.1.hydraulic_conductivity=1e-3"};
  EXPECT_NE(sand.refused(above).find("has no node of ground through which water flows"), std::string::npos)
      << sand.refused(above);
}

TEST(pore_water, is_told_of_a_table_that_no_ground_has_or_that_cuts_elements) {
  const SandCase sand;
  EXPECT_EQ(told(sand, {}).find("warning"), std::string::npos) << told(sand, {});
  EXPECT_NE(told(sand, {"materials.0.water_table=-1"}).find("the water table at -1 m lies below all ground of \"sand\""),
            std::string::npos);
  EXPECT_NE(told(sand, {"materials.0.water_table=2.5"}).find("the water table cuts 1 element of \"sand\""), std::string::npos)
      << told(sand, {"materials.0.water_table=2.5"});
  EXPECT_EQ(told(sand, {"materials.0.water_table=3"}).find("warning"), std::string::npos);
  EXPECT_NE(sand.refused({"materials.0.water_table=-1", "time.strict=true"}).find("lies below all ground"), std::string::npos);
}

TEST(pore_water, is_told_of_ground_too_tight_for_its_elements) {
  const SandCase sand;
  // sqrt(c t) with c = k/(w (1/M + n/K)): 5.65e-3 m2/s for 1e-6 m/s, 0.075 m in 1 s; elements are 1 m high.
  EXPECT_NE(told(sand, {"materials.0.hydraulic_conductivity=1e-6"}).find("within the run water flows over 0.078 m of \"sand\""),
            std::string::npos)
      << told(sand, {"materials.0.hydraulic_conductivity=1e-6"});
  EXPECT_NE(told(sand, {"materials.0.hydraulic_conductivity=1e-6"}).find("set drainage = \"undrained\""), std::string::npos);
}

TEST(pore_water, is_told_of_open_water_with_another_level_or_a_ramp) {
  const SandCase sand("\n[[water_pressures]]\nname = \"sea\"\ngroup = \"top\"\nlevel = 8\n");
  const std::vector<std::string> both = {
      "materials.1.water_table=8", "materials.1.saturated_density=2000",      "materials.1.porosity=0.4",
      "materials.1.drainage=flow", "materials.1.hydraulic_conductivity=1e-3", "materials.0.water_table=8"};
  EXPECT_EQ(told(sand, both).find("warning"), std::string::npos) << told(sand, both);
  auto lower = both, ramp = both;
  lower.push_back("water_pressures.0.level=7.5");
  ramp.push_back("water_pressures.0.ramp=1");
  EXPECT_NE(told(sand, lower).find("the water \"sea\" stands at 7.5 m, and the water table of \"cover\" under it at 8 m"),
            std::string::npos);
  EXPECT_NE(told(sand, ramp).find("the water \"sea\" comes with a ramp"), std::string::npos);
}

TEST(pore_water, tells_its_smallest_pressure) {
  // The load pulls: the water takes it as suction, on top of what stands above the base at rest.
  const SandCase sand;
  const auto figures = sand.run({"loads.0.traction=[0, 1e5, 0]"})["results"];
  const auto history = read_text(sand / "run/history.csv");
  const auto excess = column_of(history, "excess_pore_pressure_min [Pa]"), least = column_of(history, "pore_pressure_min [Pa]");
  const auto base = column_of(read_text(sand / "run/gauges.csv"), "base.excess_pore_pressure [Pa]");
  EXPECT_EQ(excess.front(), 0);
  EXPECT_NEAR(excess[1], base[1], 2e3);
  EXPECT_LT(base[1], -9.8e4);
  EXPECT_GT(least[1], excess[1] + 4e3);  // the largest suction lies at depth
  EXPECT_LT(least[1], 0);
  EXPECT_EQ(figures["least_pore_pressure"].get<Real>(), *std::ranges::min_element(least));
}

TEST(ties, are_told_of_loads_on_them) {
  const SandCase sand;
  EXPECT_NE(told(sand, {"loads.0.group=right"}).find("the load \"load\" acts on a side that is tied"), std::string::npos);
}

TEST(settling, is_told_of_ground_that_hangs_on_a_footing) {
  const SandCase sand(
      "\n[[motions]]\nname = \"press\"\ntype = \"sine\"\nquantity = \"displacement\"\namplitude = 0.1\nfrequency = 1\n"
      "\n[[boundaries]]\ngroup = \"top\"\nkind = \"prescribed\"\nmotion_y = \"press\"\n");
  EXPECT_NE(told(sand, {}).find("the group \"top\" stands still, and the ground below hangs on it"), std::string::npos)
      << told(sand, {});
  EXPECT_EQ(told(sand, {"gravity.settle=false"}).find("hangs"), std::string::npos);
  const std::vector<std::string> weak = {"materials.1.cohesion=0", "materials.1.friction_angle=30", "materials.0.cohesion=0",
                                         "materials.0.friction_angle=30", "ties=[]"};
  EXPECT_NE(words_of<PhysicsError>([&] { sand.run(weak); }).find("stand still while the body settles"), std::string::npos);
}

TEST(pore_water, does_not_flow_without_gravity) {
  const SandCase sand("\n[[drains]]\ngroup = \"lower_right\"\n[[drains]]\ngroup = \"lower_right\"\n");
  const std::vector<std::string> weightless = {"gravity.settle=false", "gravity.acceleration=[0, 0, 0]"};
  EXPECT_EQ(sand.run(weightless)["results"]["energy_seepage"].get<Real>(), 0);
}

/// Sand that liquefies between sides that are tied moves as between free-field sides, whose columns liquefy alike.
TEST(pore_water, liquefies_in_columns_beside_free_field_sides_as_between_tied_ones) {
  const std::filesystem::path original = "cases/liquefaction-column";
  const TemporaryFolder folder;
  for (const std::string file : {"column.geo", "el-centro-at-rest.csv"})
    std::filesystem::copy_file(original / file, folder / file);
  std::string text = read_text(original / "case.toml");
  const std::string ties = "[[ties]]\ngroup = \"left\"\nopposite = \"right\"\n";
  ASSERT_NE(text.find(ties), std::string::npos);
  text.replace(text.find(ties), ties.size(),
               "[[boundaries]]\ngroup = \"left\"\nkind = \"free_field\"\n[[boundaries]]\ngroup = \"right\"\nkind = "
               "\"free_field\"\n");
  std::ofstream(folder / "free.toml") << text;
  const std::vector<std::string> settings = {"time.end=2.5", "time.step=0.01", "time.snapshot_interval=0.5",
                                             "mesh.parameters={cells=10}"};
  run_quietly(registry::read_case(original / "case.toml", settings), folder / "tied");
  run_quietly(registry::read_case(folder / "free.toml", settings), folder / "free");
  const std::string tied = read_text(folder / "tied/gauges.csv"), free = read_text(folder / "free/gauges.csv");
  for (const auto& [name, scale] : {std::pair("depth-6.excess_pore_pressure [Pa]", 5e4), {"surface.displacement_x [m]", 0.05}}) {
    const auto one = column_of(tied, name), other = column_of(free, name);
    EXPECT_GT(one.back() * one.back(), 0.01 * scale * scale) << name;
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-6 * scale) << name;
  }
}

TEST(ties, need_a_node_opposite_and_equal_supports) {
  const SandCase sand("\n[[boundaries]]\ngroup = \"lower_right\"\nkind = \"roller\"\naxes = [\"x\"]\n");
  EXPECT_NE(sand.refused().find("are tied, but boundaries hold them differently along x"), std::string::npos) << sand.refused();
  const SandCase plain;
  EXPECT_NE(plain.refused({"ties.0.opposite=lower_right"}).find("has no node of \"lower_right\" opposite"), std::string::npos)
      << plain.refused({"ties.0.opposite=lower_right"});
  EXPECT_NE(plain.refused({"ties.0.opposite=left"}).find("has no node of \"left\" opposite"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
