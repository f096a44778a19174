#include "sazare/observe/manifest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "support.hpp"

namespace sazare::observe {
namespace {

using test::TemporaryFolder;

Manifest example() {
  Manifest manifest;
  manifest.version = "0.1.0";
  manifest.commit = "abc123";
  manifest.case_title = "Free-face \"blast\"";
  manifest.method = "blocks";
  manifest.status = "done";
  manifest.started = "2026-01-31T12:00:00Z";
  manifest.finished = "2026-01-31T12:00:03Z";
  manifest.machine = {"A processor", 2, 1};
  manifest.state_hash = 0xabcULL;
  manifest.results = {{"broken_joints", std::int64_t{418}}, {"energy_work", 0.1}, {"p50", std::nan("")}};
  manifest.peak_particle_velocity = {{"G1", 1.5}, {"G2", 2.5}};
  return manifest;
}

TEST(manifest, has_the_names_that_scripts_read) {
  const TemporaryFolder folder;
  write_manifest(folder.path() / "manifest.json", example());
  const auto json = nlohmann::json::parse(test::read_text(folder.path() / "manifest.json"));
  EXPECT_EQ(json.at("sazare"), "0.1.0");
  EXPECT_EQ(json.at("commit"), "abc123");
  EXPECT_EQ(json.at("case"), "Free-face \"blast\"");
  EXPECT_EQ(json.at("method"), "blocks");
  EXPECT_EQ(json.at("status"), "done");
  EXPECT_EQ(json.at("started"), "2026-01-31T12:00:00Z");
  EXPECT_EQ(json.at("finished"), "2026-01-31T12:00:03Z");
  EXPECT_EQ(json.at("machine"), (nlohmann::json{{"cpu", "A processor"}, {"cores", 2}, {"threads", 1}, {"ranks", 1}}));
  EXPECT_EQ(json.at("state_hash"), "0000000000000abc");
  EXPECT_EQ(json.at("results").at("broken_joints"), 418);
  EXPECT_TRUE(json.at("results").at("broken_joints").is_number_integer());
  EXPECT_EQ(json.at("results").at("energy_work").get<Real>(), 0.1);
  EXPECT_EQ(json.at("results").at("ppv"), (nlohmann::json{{"G1", 1.5}, {"G2", 2.5}}));
  EXPECT_EQ(json.size(), 10u);
}

TEST(manifest, results_keep_their_order) {
  const TemporaryFolder folder;
  Manifest manifest = example();
  manifest.results = {{"z", 1.0}, {"a", 2.0}};
  write_manifest(folder.path() / "manifest.json", manifest);
  const std::string text = test::read_text(folder.path() / "manifest.json");
  EXPECT_LT(text.find("\"z\""), text.find("\"a\""));
  EXPECT_LT(text.find("\"a\""), text.find("\"ppv\""));
}

TEST(manifest, number_that_is_not_finite_is_null) {
  const TemporaryFolder folder;
  write_manifest(folder.path() / "manifest.json", example());
  const auto json = nlohmann::json::parse(test::read_text(folder.path() / "manifest.json"));
  EXPECT_TRUE(json.at("results").at("p50").is_null());
}

TEST(manifest, title_that_is_no_utf8_is_no_obstacle) {
  const TemporaryFolder folder;
  Manifest manifest = example();
  manifest.case_title = "bl\xff st";
  write_manifest(folder.path() / "manifest.json", manifest);
  EXPECT_TRUE(nlohmann::json::accept(test::read_text(folder.path() / "manifest.json")));
}

TEST(manifest, machine_is_this_one) {
  parallel::set_threads(3);
  const Machine machine = this_machine();
  parallel::set_threads(0);
  EXPECT_FALSE(machine.cpu.empty());
  EXPECT_GE(machine.cores, 1);
  EXPECT_EQ(machine.threads, 3);
}

TEST(manifest, time_of_day_is_in_iso_form) {
  EXPECT_TRUE(std::regex_match(time_of_day(), std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)"))) << time_of_day();
}

TEST(manifest, folder_that_is_not_there) { EXPECT_THROW(write_manifest("no/such/manifest.json", example()), MachineError); }

}  // namespace
}  // namespace sazare::observe
