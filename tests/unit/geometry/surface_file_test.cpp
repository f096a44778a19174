#include "sazare/geometry/surface_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "msh_writer.hpp"
#include "sazare/core/error.hpp"

namespace sazare::geometry {
namespace {

using test::TemporaryFolder;

const char* two_triangles = R"(solid floor
 facet normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1 0 0
   vertex 0 1 0
  endloop
 endfacet
 facet normal 0 0 1
  outer loop
   vertex 1 0 0
   vertex 1 1 0
   vertex 0 1 5e-1
  endloop
 endfacet
endsolid floor
)";

/// Triangles as a binary STL file has them.
std::string as_binary(const std::vector<Triangle>& triangles) {
  std::string bytes(84, ' ');
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::memcpy(bytes.data() + 80, &count, sizeof count);
  for (const Triangle& triangle : triangles) {
    float numbers[12] = {};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        numbers[3 + 3 * corner + axis] = static_cast<float>(triangle[static_cast<std::size_t>(corner)][axis]);
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string words(const std::filesystem::path& file, const std::string& group = "") {
  try {
    read_surface(file, group, 1);
  } catch (const UserError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(surface_file, reads_text_and_binary_stl_alike) {
  const TemporaryFolder folder;
  const auto text = read_surface(folder.write("a.stl", two_triangles), "", 2);
  ASSERT_EQ(text.size(), 2);
  EXPECT_EQ(text[1][2], Vector3(0, 2, 1));
  EXPECT_EQ(read_surface(folder.write("b.stl", as_binary(text)), "", 1), text);
}

TEST(surface_file, reads_a_surface_group_of_a_mesh) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.msh", test::two_tetrahedra().text());
  EXPECT_EQ(read_surface(file, "floor", 1).size(), 2);
  EXPECT_EQ(read_surface(file, "", 1).size(), 2);
  EXPECT_NE(words(file, "flor").find("the mesh has no surface group \"flor\"; its groups: floor"), std::string::npos)
      << words(file, "flor");
}

TEST(surface_file, a_group_without_a_name_goes_by_its_number) {
  const TemporaryFolder folder;
  test::MshWriter mesh = test::two_tetrahedra();
  const auto floor = std::ranges::find(mesh.names, "floor", &test::MshWriter::Group::name);
  ASSERT_NE(floor, mesh.names.end());
  const std::string number = std::to_string(floor->number);
  mesh.names.erase(floor);
  const auto file = folder.write("a.msh", mesh.text());
  EXPECT_EQ(read_surface(file, number, 1).size(), 2);
  EXPECT_NE(words(file, "floor").find("its groups: " + number), std::string::npos) << words(file, "floor");
}

TEST(surface_file, text_of_any_system_is_read_alike) {
  const TemporaryFolder folder;
  const std::string mark = "\xef\xbb\xbf", text = two_triangles;
  std::string returns = text;
  std::ranges::replace(returns, '\n', '\r');
  EXPECT_EQ(read_surface(folder.write("mark.stl", mark + text), "", 1).size(), 2);
  EXPECT_EQ(read_surface(folder.write("returns.stl", returns), "", 1).size(), 2);
  EXPECT_EQ(read_surface(folder.write("mark.msh", mark + test::two_tetrahedra().text()), "floor", 1).size(), 2);
  const std::string cut = words(folder.write("cut.stl", mark + text.substr(0, text.rfind(" facet"))));
  EXPECT_NE(cut.find("it is cut short"), std::string::npos) << cut;
}

TEST(surface_file, a_corner_has_three_numbers_and_nothing_else) {
  const TemporaryFolder folder;
  for (const char* corner : {"0,5 0 0", "0 0 0 1", "0 0 0 mm", "0 0"})
    EXPECT_NE(
        words(folder.write("a.stl", std::string("solid\nvertex ") + corner + "\n")).find("a.stl:2: three numbers were expected"),
        std::string::npos)
        << corner;
}

TEST(surface_file, says_what_is_wrong) {
  const TemporaryFolder folder;
  EXPECT_NE(words(folder / "none.stl").find("cannot be read"), std::string::npos);
  EXPECT_NE(words(folder.write("empty.stl", "solid\nendsolid\n")).find("has no triangles"), std::string::npos);
  EXPECT_NE(words(folder.write("cut.stl", "solid\nvertex 0 0 0\nvertex 1 0 0\n")).find("cut short"), std::string::npos);
  EXPECT_NE(words(folder.write("word.stl", "solid\nvertex 0 zero 0\n")).find("word.stl:2: three numbers were expected"),
            std::string::npos);
  const std::string flat = words(folder.write("flat.stl", as_binary({{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)},
                                                                     {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(2, 0, 0)}})));
  EXPECT_NE(flat.find("1 of 2 triangles have no area, counted from 1: 2;"), std::string::npos) << flat;
}

TEST(surface_file, facets_of_four_corners_are_no_triangles) {
  const TemporaryFolder folder;
  const std::string head = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
                    tail = "endloop\nendfacet\nendsolid s\n";
  const std::string four = words(folder.write("four.stl", head + "vertex 1 1 0\nvertex 0 1 0\n" + tail));
  EXPECT_NE(four.find("four.stl:7: a facet has four or more corners, but those of an STL file have three"), std::string::npos)
      << four;
  const std::string two = words(folder.write("two.stl", head + tail));
  EXPECT_NE(two.find("two.stl:6: a facet has 2 corners"), std::string::npos) << two;
  const std::string ends = words(folder.write("ends.stl", head + "vertex 1 1 0\n"));
  EXPECT_NE(ends.find("ends.stl: the file ends within its facet 1: it is cut short"), std::string::npos) << ends;
}

TEST(surface_file, a_text_that_ends_between_two_facets_is_cut_short) {
  const TemporaryFolder folder;
  const std::string whole = two_triangles;
  const std::string cut = words(folder.write("cut.stl", whole.substr(0, whole.rfind(" facet"))));
  EXPECT_NE(
      cut.find("cut.stl: the file ends after 1 facets without \"endsolid\": it is cut short; add that line if these are all"),
      std::string::npos)
      << cut;
}

TEST(surface_file, keywords_may_be_capitals) {
  const TemporaryFolder folder;
  std::string capitals = two_triangles;
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  EXPECT_EQ(read_surface(folder.write("a.stl", capitals), "", 1).size(), 2);
}

TEST(surface_file, says_how_much_of_a_binary_file_is_there) {
  const TemporaryFolder folder;
  const Triangle one = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  const std::string whole = as_binary({one, one, one});
  const std::string cut = words(folder.write("cut.stl", whole.substr(0, whole.size() - 70)));
  EXPECT_NE(cut.find("its header states 3 triangles, 234 bytes, but it ends after 1 of them, 164 bytes"), std::string::npos)
      << cut;
  const std::string head = words(folder.write("head.stl", std::string(20, '\0')));
  EXPECT_NE(head.find("begins with 84 bytes before its triangles, found 20"), std::string::npos) << head;
  const std::string more = words(folder.write("more.stl", whole + "more"));
  EXPECT_NE(more.find("a binary STL of 3 triangles, as its header states, has 234 bytes, found 238"), std::string::npos) << more;
}

}  // namespace
}  // namespace sazare::geometry
