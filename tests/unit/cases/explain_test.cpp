#include <gtest/gtest.h>

#include "case_folder.hpp"
#include "sazare/methods/blocks/case/format.hpp"

namespace sazare::cases {
namespace {

TEST(Explain, SaysWhatFollowsFromTheNumbers) {
  const CaseFolder folder;
  const std::string text = explain(folder.read(full_case()).as<cases::BlocksCase>());
  for (const char* words : {
           "mesh        block.geo, coordinates times 0.001, meshed by gmsh",
           "rock: 2700 kg/m3, regions rock, roof",
           "elastic to 6.66e6 Pa (6.66 MPa) at an opening of 14.8e-6 m, broken at 29.93e-6 m",
           "friction angle 30 deg",
           "slit: on surface slit, never bonded",
           "true faces\n",
           "contact_stiffness and contact_damping are of spheres behind the faces, which touch the surface of a coupled run "
           "alone",
           "stress xx yy zz (-3e6, -1e6, -2e6) Pa, xy yz zx (0, 200000, 0) Pa",
           "hole 1: on surface hole_1 from 100e-6 s: 575e6 Pa (575 MPa) after 133e-6 s, zero again after 498.8e-6 s",
           "ends on a face once its displacement is 0.005 m",
           "hole_2: on surface hole_2 from 0 s: 3 rows of pressure.csv, to 500e-6 s",
           "rock: translation x z, rotation y",
           "to 500e-6 s, 500 history rows, 20 snapshots",
           "travel of at most 20e-9 m in a step; largest 10e-9 s",
       })
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

}  // namespace
}  // namespace sazare::cases
