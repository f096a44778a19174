/// Rigid bodies from two files: what they are, how they move, and their spheres.

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "sazare/methods/spheres/run/placing/bodies_file.hpp"
#include "sazare/methods/spheres/run/placing/placement.hpp"
#include "tests/unit/runs/sphere_cases.hpp"

namespace sazare::runs {
namespace {

using namespace sphere_cases;
using test::TemporaryFolder;

const std::string titles = "body,volume [m3],x [m],y,z,vx,vy,vz,wx,wy,wz,ixx,iyy,izz,ixy,iyz,izx\n";
/// A dumb-bell along (1, 1, 0) and a ball; the first has moments 1, 4, 4 in 1e-11 m5.
const std::string two = titles +
                        "7,2e-6,0.02,0.02,0.05,0.1,0,0,0,0,3,2.5e-11,2.5e-11,4e-11,-1.5e-11,0,0\n"
                        "3,1e-6,0.06,0.06,0.05,0,0,-0.2,0,0,0,1e-11,1e-11,1e-11,0,0,0\n";
const std::string spheres = "body radius x y z\n3 0.006 0.06 0.06 0.05\n7 0.005 0.015 0.015 0.05\n7 0.005 0.025 0.025 0.05\n";

cases::CaseFile bodies_case(const TemporaryFolder& folder, const std::string& bodies = two) {
  return case_of(folder,
                 "[[spheres]]\nname = \"fragments\"\nmaterial = \"glass\"\nsource = \"bodies\"\nbodies_file = \"" +
                     folder.write("bodies.csv", bodies).string() + "\"\nfile = \"" +
                     folder.write("spheres.csv", spheres).string() + "\"\n",
                 {"time.end=0.02", "time.snapshot_interval=0.02"});
}

TEST(sphere_bodies, have_what_their_file_says) {
  const TemporaryFolder folder;
  const Placement placement = place_spheres(bodies_case(folder));
  ASSERT_EQ(placement.clumps.clumps.size(), 2);
  const state::Clump& bell = placement.clumps.clumps[0];
  EXPECT_NEAR(bell.mass, 2500 * 2e-6, 1e-15);
  EXPECT_EQ(bell.centre, Vector3(0.02, 0.02, 0.05));
  EXPECT_EQ(bell.velocity, Vector3(0.1, 0, 0));
  EXPECT_NEAR(bell.inertia[0], 2500 * 1e-11, 1e-12 * 2500e-11);
  EXPECT_NEAR(bell.inertia[2], 2500 * 4e-11, 1e-12 * 2500e-11);
  EXPECT_NEAR(bell.angular_momentum.z(), 3 * 2500 * 4e-11, 1e-20);
  EXPECT_EQ(placement.clumps.members_of(0).size(), 2);
  EXPECT_EQ(placement.clumps.members_of(1).size(), 1);
  // Spheres stand where the file has them, along the long axis of the body.
  EXPECT_LT((placement.spheres.place[0].centre() - Vector3(0.015, 0.015, 0.05)).norm(), 1e-15);
  EXPECT_NEAR(std::abs(bell.out({1, 0, 0}).dot(Vector3(1, 1, 0).normalized())), 1, 1e-12);
}

TEST(sphere_bodies, fly_and_turn_as_rigid_bodies) {
  const TemporaryFolder folder;
  const auto file = bodies_case(folder);
  carry_out(file, folder / "run");
  EXPECT_EQ(test::read_manifest(folder / "run")["status"], "done");
  const auto energy = test::read_manifest(folder / "run")["results"];
  // They fall by g t^2/2 without touching anything: kinetic energy is that at the start and the work of gravity.
  const Real t = 0.02, g = 9.81, m = 2500 * 1e-6;
  const Real start = 0.5 * 2 * m * 0.01 + 0.5 * m * 0.04 + 0.5 * 2500 * 4e-11 * 9;
  const Real work = 2 * m * g * (g * t * t / 2) + m * g * (0.2 * t + g * t * t / 2);
  EXPECT_NEAR(energy["energy_kinetic"].get<Real>(), start + work, 1e-9 * start);
}

/// The message of a case that cannot be placed.
std::string refusal(const std::string& bodies, const std::string& members = spheres) {
  const TemporaryFolder folder;
  const auto bodies_file = folder.write("bodies.csv", bodies), members_file = folder.write("spheres.csv", members);
  try {
    read_bodies(bodies_file, members_file);
  } catch (const UserError& error) {
    const std::string text = error.what();
    return text.substr(text.find(".csv:") + 5);
  }
  return "";
}

TEST(sphere_bodies, are_refused_at_their_line) {
  EXPECT_EQ(refusal(two), "");
  const std::string ball = "3,1e-6,0.06,0.06,0.05,0,0,0,0,0,0,";
  EXPECT_EQ(refusal(two + ball + "1,1,1,0,0,0\n"), "4: the body 3 stands twice");
  EXPECT_EQ(refusal(titles + "3,0,0.06,0.06,0.05,0,0,0,0,0,0,1,1,1,0,0,0\n"), "2: the volume of a body must be greater than 0");
  EXPECT_EQ(refusal(titles + ball + "1,1,3,0,0,0\n").substr(0, 28), "2: no body has this inertia:");
  EXPECT_EQ(refusal(titles + ball + "1,1,1,0,0,0\n"), "3: a sphere of the body 7, which is not in bodies.csv");
  EXPECT_EQ(refusal(two, "3 0.006 0 0 0\n"), "2: this body has no sphere in spheres.csv");
  EXPECT_EQ(refusal(two, spheres + "3 0 0 0 0\n"), "5: a radius greater than 0 and a finite centre were expected");
  EXPECT_EQ(refusal(titles), " the file has no body");
  EXPECT_EQ(refusal(titles + "3.5" + ball.substr(1) + "1,1,1,0,0,0\n"), "2: the number of a body is a whole number, found 3.5");
  EXPECT_EQ(refusal(two, spheres + "7.5 0.006 0 0 0\n"), "5: the number of a body is a whole number, found 7.5");
  EXPECT_EQ(refusal(titles + "3,1e-6,0.06,0.06,0.05,0,nan,0,0,0,0,1,1,1,0,0,0\n").substr(0, 17), "2:25: vy must be ");
  EXPECT_NE(refusal(titles + "3,1e-12,0.06,0.06,0.05,0,0,0,0,0,0,1e-18,1e-18,1e-18,0,0,0\n", "3 0.006 0.06 0.06 0.05\n")
                .find("its largest sphere"),
            std::string::npos);
  EXPECT_NE(refusal(titles + "3,1e-6,75,0.06,0.05,0,0,0,0,0,0,1e-11,1e-11,1e-11,0,0,0\n", "3 0.006 0.06 0.06 0.05\n")
                .find("the centre of mass of this body is 74.9 m away"),
            std::string::npos);
  EXPECT_NE(refusal(titles + ball + "1,1,1,0,0,0\n", "3 0.006 0.06 0.06 0.05\n").find("the inertia of this body"),
            std::string::npos);
  EXPECT_NE(refusal(titles + "3,1\n").find("seventeen numbers were expected"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
